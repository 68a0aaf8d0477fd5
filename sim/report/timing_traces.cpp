// SPDX-License-Identifier: Apache-2.0
#include "sim/report/timing_traces.hpp"

#include <fmt/format.h>

#include <string_view>

#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/ghdl/vcd.hpp"
#include "sim/files/gnuplot.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/files/timing_diagram.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::report {
namespace {

constexpr FrameSize c_size{16, 12};
constexpr std::size_t c_fragments = 24;  // number of fragments after which the diagram ends
constexpr std::size_t c_row = 50;        // number of clocks that fit the page's width
constexpr double c_clock = 23;           // pixels
constexpr std::size_t c_read = 200;      // clocks read to find the first vector

struct ShownSignal {
  const char* label;
  std::string path;     // in the testbench
  std::string valid{};  // of a decimal value: name of the wire that is 1 while it is valid; empty: a wire
};

// In the order of the data flow: inputs at the top, outputs at the bottom.
std::vector<ShownSignal> signals_of(Shader shader) {
  const bool stalls =
      // stages of the rasterizer stall, too; in the other shaders only the walker stalls
      shader == Shader::processors;
  const std::string front = stalls ? "dut/in_front/rasterizer/" : "dut/";
  const std::string walking = stalls ? front + "drawing" : "dut/walking";
  const std::string walked = stalls ? front + "drawn_valid" : "dut/span_step";
  std::vector<ShownSignal> signals = {{"init_valid", "init_valid"},
                                      {"init_ready", "init_ready"},
                                      {"line_load", front + "line_load"},
                                      {"line_step", front + "line_step"},
                                      {"line_y", front + "walker/line_y", walking},
                                      {"line_start", front + "walker/line_start", walking},
                                      {"line_stop", front + "walker/line_stop", walking},
                                      {"span_load", front + "span_load"},
                                      {"span_step", front + "span_step"},
                                      {"y", front + "y", walked},
                                      {"x", front + "x", walked}};
  if (!stalls) signals.push_back({"pixel_valid", "dut/pixel_valid"});  // input of the queue
  if (shader == Shader::processors) {
    signals.push_back({"token_valid", "dut/token_valid"});
    signals.push_back({"shaded_valid", "dut/shaded_valid"});
  }
  signals.push_back({"fragment_valid", "fragment_valid"});
  for (const char* field : {"fragment_y", "fragment_x", "fragment_red"})
    signals.push_back({field, field, "fragment_valid"});
  return signals;
}

std::string in_testbench(const std::string& path) {
  return "frame_tb/" + path;
}

// At most 32 bits. A value with metavalues is '?'.
std::string decimal(const std::string& bits) {
  std::uint64_t word = 0;
  for (const char bit : bits) {
    if (bit != '0' && bit != '1') return "?";
    word = word << 1 | (bit == '1' ? 1U : 0U);
  }
  return std::to_string(word);
}

// Write the scene's init vectors for the hardware.
void write_vectors(const Scene& scene, const HardwareKey& key, const std::filesystem::path& path) {
  // No subdivision: two triangles with the same number of fragments in each shader.
  SetupOptions options;
  options.quadratic.test = HighlightTest::none;
  FrameStream stream = must(whole_stream(scene, c_size, key, {.setup = options}));
  must(write_init_file(path, key.name(), {stream.init_bits, std::move(stream.words)}));
}

}  // namespace

ShaderTiming draw_shader_timing(Shader shader, const SimulatorFolders& folders) {
  const auto scene = must(load_scene((folders.source / "sim/report/timing.toml").string(), {}));
  const auto plan = must(plan_scene(scene, {.shader = shader}));
  const HardwareKey& key = plan.key;
  const auto scratch = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path init = scratch.path() / "init.txt";
  write_vectors(scene, key, init);
  const auto runner = must(GhdlRunner::open(key, folders));
  const std::filesystem::path trace = scratch.path() / "trace.vcd";
  must(runner.run(init, scratch.path() / "trace", {.wave_file = trace}));

  const auto signals = signals_of(shader);
  std::vector<std::string> paths;
  for (const ShownSignal& signal : signals) {
    paths.push_back(in_testbench(signal.path));
    if (!signal.valid.empty()) paths.push_back(in_testbench(signal.valid));
  }
  std::ranges::sort(paths);
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  const auto sampled = must(sample_vcd(trace, "frame_tb/clk", paths, c_read));
  // Cycle 0 is the edge that takes the first vector.
  const auto& offered = sampled.values.at("frame_tb/init_valid");
  const auto& ready = sampled.values.at("frame_tb/init_ready");
  std::size_t first = 0;
  while (first < sampled.edges && !(offered[first] == "1" && ready[first] == "1")) ++first;
  if (first == sampled.edges) throw_tool_failed("{}: no vector is taken", trace.string());
  const auto& drawn = sampled.values.at("frame_tb/fragment_valid");
  std::size_t last = first;
  for (std::size_t fragments = 0; last < sampled.edges && fragments < c_fragments; ++last)
    fragments += drawn[last] == "1" ? 1 : 0;

  const auto bits_at = [&](const std::string& path, std::size_t edge) {
    return sampled.values.at(in_testbench(path))[edge];
  };
  // The value at an edge; std::nullopt: it is invalid.
  const auto value_at = [&](const ShownSignal& signal, std::size_t edge) -> std::optional<std::string> {
    if (signal.valid.empty()) return bits_at(signal.path, edge) == "1" ? "1" : "0";
    if (bits_at(signal.valid, edge) != "1") return std::nullopt;
    return decimal(bits_at(signal.path, edge));
  };
  ShaderTiming timing{.key = key.name()};
  const std::size_t clocks = last - first, rows = (clocks + c_row - 1) / c_row;
  // even, because every second clock has a tick
  const std::size_t in_row = ((clocks + rows - 1) / rows + 1) / 2 * 2;
  for (std::size_t begin = first; begin < last; begin += in_row) {
    const std::size_t end = std::min(last, begin + in_row);
    const auto at = [&](std::size_t edge) { return static_cast<double>(edge - begin); };
    TimingDiagram diagram{.end = at(end), .width = c_clock * at(end), .axis = "clock"};
    for (std::size_t edge = begin; edge < end; ++edge) {
      diagram.lines.push_back(at(edge) + 1.0);
      if ((edge - begin) % 2 == 0) diagram.ticks.emplace_back(at(edge) + 0.5, std::to_string(edge - first));
    }
    for (const ShownSignal& signal : signals) {
      TimingLane& lane = diagram.lanes.emplace_back(TimingLane{signal.label});
      for (std::size_t from = begin, until = begin; from < end; from = until) {
        const auto value = value_at(signal, from);
        while (until < end && value_at(signal, until) == value) ++until;
        if (signal.valid.empty())
          lane.levels.push_back({at(from), at(until), value == "1"});
        else if (value)
          lane.boxes.push_back({at(from), at(until), *value});
      }
    }
    timing.svgs.push_back(run_gnuplot(timing_script(diagram), scratch.path(), "timing"));
  }

  const auto named = [&](const char* label, std::size_t edge) {
    return value_at(*std::ranges::find(signals, std::string_view(label), &ShownSignal::label), edge)
        .value_or("");
  };
  std::string& words = timing.words;
  for (std::size_t edge = first, count = 0; edge < last && count < 4; ++edge)
    if (drawn[edge] == "1")
      words += fmt::format("{}clock {}: fragment x {}, y {}, red {}", count++ == 0 ? "" : "; ", edge - first,
                           named("fragment_x", edge), named("fragment_y", edge), named("fragment_red", edge));
  return timing;
}

}  // namespace halfway::report
