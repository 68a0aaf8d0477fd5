// SPDX-License-Identifier: Apache-2.0
#include "sim/run/stage_trace.hpp"

#include <filesystem>
#include <optional>
#include <string_view>

#include "sim/driver/limits.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/ghdl/vcd.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

constexpr const char* c_clock = "frame_tb/clk";

// Path of a shader's signal in the testbench.
std::string in_testbench(const std::string& path) {
  return "frame_tb/dut/" + path;
}

// The part of a value that GHDL writes in full.
std::optional<std::uint64_t> part_of(std::string_view value, int low, int bits) {
  std::uint64_t word = 0;
  for (int i = bits - 1; i >= 0; --i) {
    const std::size_t from_right = static_cast<std::size_t>(low + i) + 1;
    const char bit = from_right > value.size() ? 'U' : value[value.size() - from_right];
    if (bit != '0' && bit != '1') return std::nullopt;
    word = word << 1 | (bit == '1' ? 1U : 0U);
  }
  return word;
}

}  // namespace

StageTrace trace_stages(const HardwareKey& key, const ShaderStages& stages, const SimulatorFolders& folders,
                        const InitStream& vectors, std::uint64_t fragments) {
  const auto scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path init = scratch.path() / "init.txt", vcd = scratch.path() / "trace.vcd";
  must(write_init_file(init, key.name(), vectors));
  const auto runner = must(GhdlRunner::open(key, folders));
  std::vector<std::string> paths;
  for (const TracedPart& part : stages.parts())
    if (const std::string path = in_testbench(part.path); paths.empty() || paths.back() != path)
      paths.push_back(path);
  GhdlRunOptions options;
  options.max_fragments = static_cast<std::uint32_t>(fragments + c_most_surplus);
  options.idle_limit = c_idle_limit;
  options.wave_file = vcd;
  options.wave_signals = paths;
  options.wave_signals.emplace_back(c_clock);
  const auto run = runner.run(init, scratch.path() / "trace", options);
  if (!run && run.error().code != ExitCode::differs) throw Failure{run.error()};
  const SampledSignals sampled = must(sample_vcd(vcd, c_clock, paths, SIZE_MAX));
  const auto part = [&](const std::string& path, std::size_t edge, int low, int bits) {
    return part_of(sampled.values.at(in_testbench(path))[edge], low, bits);
  };
  return {stages.read({sampled.edges, part}), run ? std::string() : run.error().message};
}

}  // namespace halfway
