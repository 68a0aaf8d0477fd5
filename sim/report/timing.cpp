// SPDX-License-Identifier: Apache-2.0
#include "sim/report/timing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "plan/plan.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/ghdl/vcd.hpp"
#include "sim/report/plot.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/system/file.hpp"

namespace halfway::report {
namespace {

constexpr FrameSize c_size{16, 12};
constexpr std::size_t c_fragments = 24;  // number of fragments after which the diagram ends
constexpr std::size_t c_row = 50;        // number of clocks that fit the page's width
constexpr std::size_t c_read = 200;      // clocks read to find the first vector

enum class Shown { wire, decimal, hexadecimal };
struct ShownSignal {
  const char* label;
  std::string path;  // in the testbench's hierarchy
  Shown as;
  std::string valid{};  // name of a wire: the value is valid only while it is 1; empty: always
};

// In the order of the data flow: inputs at the top, outputs at the bottom.
std::vector<ShownSignal> signals_of(Shader shader) {
  const bool stalls =
      // stages after the walker stall too; in the other shaders only the walker stalls
      shader == Shader::processors;
  const std::string front = stalls ? "dut/rasterizer/" : "dut/";
  const std::string walking = stalls ? "dut/drawing" : "dut/walking";
  const std::string walked = stalls ? "dut/drawn_valid" : "dut/span_step";
  std::vector<ShownSignal> signals = {
      {"init_valid", "init_valid", Shown::wire},
      {"init_ready", "init_ready", Shown::wire},
      {"line_load", front + "line_load", Shown::wire},
      {"line_step", front + "line_step", Shown::wire},
      {"line_y", front + "walker/line_y", Shown::decimal, walking},
      {"line_start", front + "walker/line_start", Shown::decimal, walking},
      {"line_stop", front + "walker/line_stop", Shown::decimal, walking},
      {"span_load", front + "span_load", Shown::wire},
      {"span_step", front + "span_step", Shown::wire},
      {"y", front + "y", Shown::decimal, walked},
      {"x", front + "x", Shown::decimal, walked},
  };
  if (!stalls) signals.push_back({"pixel_valid", "dut/pixel_valid", Shown::wire});  // input of the queue
  if (shader == Shader::processors) {
    signals.push_back({"token_valid", "dut/token_valid", Shown::wire});
    signals.push_back({"shaded_valid", "dut/shaded_valid", Shown::wire});
  }
  signals.insert(signals.end(), {{"fragment_valid", "fragment_valid", Shown::wire},
                                 {"fragment_y", "fragment_y", Shown::decimal, "fragment_valid"},
                                 {"fragment_x", "fragment_x", Shown::decimal, "fragment_valid"},
                                 {"fragment_red", "fragment_red", Shown::decimal, "fragment_valid"}});
  return signals;
}

std::string in_testbench(const std::string& path) {
  return "frame_tb/" + path;
}

// At most 32 bits. A value with metavalues is '?'.
std::string shown(const std::string& bits, Shown as) {
  std::uint64_t word = 0;
  for (const char bit : bits) {
    if (bit != '0' && bit != '1') return as == Shown::wire ? "0" : "?";
    word = word << 1 | (bit == '1' ? 1U : 0U);
  }
  return as == Shown::hexadecimal ? fmt::format("{:x}", word) : fmt::format("{}", word);
}

// Write the scene's init vectors for the hardware.
Status write_vectors(const Scene& scene, const HardwareKey& key, const std::filesystem::path& path) {
  // No subdivision: two triangles with the same number of fragments in each shader.
  SetupOptions options;
  options.quadratic.test = HighlightTest::none;
  const std::unique_ptr<Setup> setup = make_setup(scene, c_size, key, options);
  auto file = InitFileWriter::open(path, key.name(), setup->init_bits());
  if (!file) return file.error();
  SceneStream stream(*setup, key, 1);
  for (Batch batch; stream.next(batch);) file->write(batch.init_words);
  return file->commit();
}

}  // namespace

Result<TimingDiagram> draw_shader_timing(Shader shader, const SimulatorFolders& folders) {
  const auto scene = load_scene((folders.source / "sim/report/timing.toml").string(), {});
  if (!scene) return scene.error();
  const auto plan = plan_scene(*scene, {.shader = shader});
  if (!plan) return plan.error();
  const HardwareKey& key = plan->key;
  const auto scratch = TemporaryFolder::make(std::filesystem::temp_directory_path());
  if (!scratch) return scratch.error();
  const std::filesystem::path init = scratch->path() / "init.txt";
  if (Status written = write_vectors(*scene, key, init); !written) return written.error();
  const auto runner = GhdlRunner::open(key, folders);
  if (!runner) return runner.error();
  const std::filesystem::path trace = scratch->path() / "trace.vcd";
  if (const auto run = runner->run(init, scratch->path() / "trace", {.wave_file = trace}); !run)
    return run.error();

  const auto signals = signals_of(shader);
  std::vector<std::string> paths;
  for (const ShownSignal& signal : signals) {
    paths.push_back(in_testbench(signal.path));
    if (!signal.valid.empty()) paths.push_back(in_testbench(signal.valid));
  }
  std::ranges::sort(paths);
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  const auto sampled = sample_vcd(trace, "frame_tb/clk", paths, c_read);
  if (!sampled) return sampled.error();
  // Cycle 0 is the edge that takes the first vector.
  const auto& offered = sampled->values.at("frame_tb/init_valid");
  const auto& ready = sampled->values.at("frame_tb/init_ready");
  std::size_t first = 0;
  while (first < sampled->edges && !(offered[first] == "1" && ready[first] == "1")) ++first;
  if (first == sampled->edges) return tool_failed(trace.string() + ": no vector is taken");
  const auto& drawn = sampled->values.at("frame_tb/fragment_valid");
  std::size_t last = first;
  for (std::size_t fragments = 0; last < sampled->edges && fragments < c_fragments; ++last)
    fragments += drawn[last] == "1" ? 1 : 0;

  std::vector<Lane> lanes;
  for (const ShownSignal& signal : signals) {
    Lane lane{signal.label, signal.as == Shown::wire, {}};
    const auto& values = sampled->values.at(in_testbench(signal.path));
    for (std::size_t edge = first; edge < last; ++edge) {
      const bool counts = signal.valid.empty() || sampled->values.at(in_testbench(signal.valid))[edge] == "1";
      lane.values.push_back(counts ? shown(values[edge], signal.as) : "");
    }
    lanes.push_back(std::move(lane));
  }
  TimingDiagram diagram{.key = key.name()};
  const std::size_t clocks = last - first, rows = (clocks + c_row - 1) / c_row;
  // even, because every second clock has a tick
  const std::size_t in_row = ((clocks + rows - 1) / rows + 1) / 2 * 2;
  for (std::size_t begin = 0; begin < clocks; begin += in_row) {
    std::vector<Lane> part = lanes;
    for (Lane& lane : part)
      lane.values = {lane.values.begin() + static_cast<std::ptrdiff_t>(begin),
                     lane.values.begin() + static_cast<std::ptrdiff_t>(std::min(clocks, begin + in_row))};
    auto svg = draw_timing(part, begin, scratch->path());
    if (!svg) return svg.error();
    diagram.svgs.push_back(std::move(*svg));
  }

  const auto lane_of = [&](const char* name) -> const Lane& {
    return *std::ranges::find(lanes, name, &Lane::name);
  };
  std::string& words = diagram.words;
  for (std::size_t edge = 0, named = 0; edge < last - first && named < 4; ++edge)
    if (lane_of("fragment_valid").values[edge] == "1") {
      words += fmt::format("{}clock {}: fragment x {}, y {}, red {}", named == 0 ? "" : "; ", edge,
                           lane_of("fragment_x").values[edge], lane_of("fragment_y").values[edge],
                           lane_of("fragment_red").values[edge]);
      ++named;
    }
  return diagram;
}

}  // namespace halfway::report
