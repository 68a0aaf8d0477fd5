// SPDX-License-Identifier: Apache-2.0
#include "sim/run/waveform.hpp"

#include <utility>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "sim/driver/limits.hpp"
#include "sim/driver/vectors_around.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"
#include "sim/files/init_file.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr std::size_t c_vectors_a_read = 64;

// The simulators write waveforms directly to the given name and do not report a full disk.
std::filesystem::path put_in_place(const std::filesystem::path& written, const std::filesystem::path& path) {
  if (const std::string note = room_note({path.parent_path()}); !note.empty())
    throw_tool_failed("{}: may be cut off{}", path.string(), note);
  std::error_code error;
  std::filesystem::rename(written, path, error);
  if (error) throw_tool_failed("{}: cannot write: {}", path.string(), error.message());
  return path;
}

// Runs the init file until `fragments` fragments are drawn, or to its end.
void run_until(VerilatorSimulator& simulator, const ResultFiles& files, const std::string& key_name,
               std::uint64_t fragments) {
  auto file = must(InitFileReader::open(files.init(), key_name));
  std::vector<Fragment> drawn;
  std::uint64_t count = 0;
  std::vector<std::uint32_t> words;
  while (count < fragments) {
    words.clear();
    const auto vectors = must(file.read(words, c_vectors_a_read));
    const auto limit = static_cast<std::size_t>(fragments - count);
    const Status status = vectors == 0 ? simulator.finish(drawn, limit) : simulator.run(words, drawn, limit);
    if (!status || vectors == 0) break;  // enough fragments, a hang, or the end
    count += drawn.size();
    drawn.clear();
  }
}

// The vectors of the triangles around fragment `index`.
InitStream vectors_around(const HardwareKey& key, const ResultFiles& files, std::uint64_t index) {
  auto file = must(InitFileReader::open(files.init(), key.name()));
  const std::unique_ptr<GoldenModel> golden = make_golden_model(key);
  VectorsAround kept(key);
  std::uint64_t drawn = 0;
  while (!kept.complete()) {
    std::vector<std::uint32_t> words;
    const auto begun = must(file.read(words, 1));
    if (begun == 0) break;
    const std::size_t vectors = golden->group(words);
    if (vectors > 1) must(file.read(words, vectors - 1));
    const std::uint64_t before = std::exchange(drawn, drawn + golden->draw(words).size());
    kept.add(words, vectors, before <= index && index < drawn);
  }
  kept.finish();
  return InitStream{file.bits(), kept.words()};
}

std::filesystem::path write_ghdl_waveform(const HardwareKey& key, const SimulatorFolders& folders,
                                          const ResultFiles& files, std::uint64_t index,
                                          std::uint32_t stall_seed) {
  const auto vectors = vectors_around(key, files, index);
  const std::filesystem::path path = files.folder / "mismatch-ghdl.fst";
  const auto scratch = must(TemporaryFolder::make(files.folder));
  const std::filesystem::path init = scratch.path() / "init.txt";
  must(write_init_file(init, key.name(), vectors));
  const auto runner = must(GhdlRunner::open(key, folders));
  const std::filesystem::path waves = scratch.path() / path.filename();
  const auto run = runner.run(init, scratch.path() / "trace",
                              {.max_fragments = c_idle_limit,
                               .idle_limit = static_cast<std::uint32_t>(c_waveform_before),
                               .stall_seed = stall_seed,
                               .wave_file = waves});
  if (!run && run.error().code != ExitCode::differs) throw Failure{run.error()};
  return put_in_place(waves, path);
}

}  // namespace

std::filesystem::path write_mismatch_waveform(const HardwareKey& key, const SimulatorFolders& folders,
                                              const ResultFiles& files, const std::string& simulator,
                                              std::optional<std::uint64_t> index, std::uint32_t stall_seed) {
  if (simulator == "ghdl") return write_ghdl_waveform(key, folders, files, index.value_or(0), stall_seed);
  const std::filesystem::path path = files.folder / "mismatch-verilator.fst";
  VerilatorOptions options{.stall_seed = stall_seed, .idle_limit = idle_limit(key)};
  const std::uint64_t fragments = index ? *index + 1 : UINT64_MAX;
  std::uint64_t at = 0;
  {
    auto first = must(VerilatorSimulator::open(key, folders, options));
    run_until(first, files, key.name(), fragments);
    at = first.cycles().value_or(0);
  }
  const auto scratch = must(TemporaryFolder::make(files.folder));
  options.wave_file = scratch.path() / path.filename();
  options.waves_from = at > c_waveform_before ? at - c_waveform_before : 0;
  options.waves_to = at + c_waveform_after;
  {
    auto second = must(VerilatorSimulator::open(key, folders, options));
    const std::uint64_t past =
        fragments > UINT64_MAX - c_waveform_after ? fragments : fragments + c_waveform_after;
    run_until(second, files, key.name(), past);
  }
  return put_in_place(options.wave_file, path);
}

}  // namespace halfway
