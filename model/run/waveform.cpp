// SPDX-License-Identifier: Apache-2.0
#include "run/waveform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "frame/init_file.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_vectors_a_read = 64;
constexpr std::uint64_t c_idle_limit = 20'000;

// Runs the init file until `fragments` have come, or to the end. `last_vectors` bounds how far past them the
// hardware is fed.
Status run_until(VerilatorSimulator& simulator, const ResultFiles& files, const std::string& key_name,
                 std::uint64_t fragments) {
  auto file = InitFileReader::open(files.init(), key_name);
  if (!file) return file.error();
  std::vector<Fragment> drawn;
  std::uint64_t count = 0;
  const auto taken = [&](const Status& status) {
    count += drawn.size();
    drawn.clear();
    return static_cast<bool>(status);
  };
  std::vector<std::uint32_t> words;
  while (count < fragments) {
    words.clear();
    const auto vectors = file->read(words, c_vectors_a_read);
    if (!vectors) return vectors.error();
    const auto limit = static_cast<std::size_t>(fragments - count);
    const Status status =
        *vectors == 0 ? simulator.finish(drawn, limit) : simulator.run(words, *vectors, drawn, limit);
    if (!taken(status) || *vectors == 0) break;  // enough fragments, a hang, or the end
  }
  return Ok{};
}

}  // namespace

Result<std::filesystem::path> write_mismatch_waveform(const HardwareKey& key, const SimulatorFolders& folders,
                                                      const ResultFiles& files, const std::string& simulator,
                                                      std::optional<std::uint64_t> index,
                                                      std::uint32_t stall_seed) {
  const std::filesystem::path path = files.folder / fmt::format("mismatch-{}.fst", simulator);
  VerilatorOptions options{.stall_seed = stall_seed, .idle_limit = c_idle_limit};
  const std::uint64_t fragments = index ? *index + 1 : UINT64_MAX;
  std::uint64_t at = 0;
  {
    auto first = VerilatorSimulator::open(key, folders, options);
    if (!first) return first.error();
    if (const Status status = run_until(*first, files, key.name(), fragments); !status) return status.error();
    at = first->cycles();
  }
  options.wave_file = path;
  options.waves_from = at > c_waveform_before ? at - c_waveform_before : 0;
  options.waves_to = at + c_waveform_after;
  auto second = VerilatorSimulator::open(key, folders, options);
  if (!second) return second.error();
  const std::uint64_t past =
      fragments > UINT64_MAX - c_waveform_after ? fragments : fragments + c_waveform_after;
  if (const Status status = run_until(*second, files, key.name(), past); !status) return status.error();
  return path;
}

}  // namespace halfway
