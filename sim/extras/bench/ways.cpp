// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/bench/ways.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <memory>

#include "frame/metrics.hpp"
#include "golden_run/golden_run.hpp"
#include "projection/project.hpp"
#include "reference/renderer.hpp"
#include "sim/driver/stream_comparator.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/mesa/mesa_picture.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"
#include "sim/run/open_engine.hpp"

namespace halfway {
namespace {

struct Facts {
  const char *short_name, *title;
  bool compared = false, in_lanes = false;
  LaneVectors vectors = LaneVectors::avx512;
};
const Facts& facts_of(Way way) {
  static constexpr std::array<Facts, c_ways.size()> c_facts = {
      {{"lanes_compared", "RTL in lanes, every field compared with the golden model drawn on the same core",
        true, true},
       {"lanes", "RTL in lanes alone", false, true},
       {"lanes_without_avx512_compared", "RTL in lanes, compiled without AVX-512, compared likewise", true,
        true, LaneVectors::avx2},
       {"lanes_without_avx512", "RTL in lanes, compiled without AVX-512, alone", false, true,
        LaneVectors::avx2},
       {"verilator_compared", "RTL in Verilator, compared likewise", true},
       {"verilator", "RTL in Verilator alone"},
       {"ghdl", "RTL in GHDL"},
       {"golden", "golden model alone"},
       {"reference", "Phong shading per pixel in double, the reference renderer"},
       {"mesa", "Phong shading per pixel by OpenGL on Mesa's llvmpipe"}}};
  return c_facts.at(static_cast<std::size_t>(way));
}

void check(bool right, Way way, const GoldenStream& s) {
  if (!right)
    throw Failure{{ExitCode::differs,
                   fmt::format("{}, {}: not the golden model's fragments", to_string(way), s.key.name())}};
}

/// RTL in this process, alone, or with the golden model and a comparison of every field on the same thread.
Go in_process(Way way, const WayInput& input) {
  const HardwareKey& key = input.stream->key;
  const std::shared_ptr<Engine> engine =
      in_lanes(way) ? must(shared_engine(LaneSimulator::open(
                          key, input.folders, {.fast = input.fast, .vectors = facts_of(way).vectors})))
                    : must(open_engine(EngineKind::verilator, key, input.folders));
  const std::shared_ptr<GoldenModel> golden = make_golden_model(key);
  return [=, compared = is_compared(way), &s = *input.stream] {
    const auto draw = [&](const Engine::OnDrawn& on_drawn) {
      must(engine->draw(s.words, SIZE_MAX, on_drawn));
      must(engine->drain(SIZE_MAX, on_drawn));
    };
    StreamComparator comparator;
    std::span<const std::uint32_t> words = s.words;  // not yet drawn by the golden model
    std::size_t count = 0;
    const double start = process_seconds();
    draw([&](std::span<const Fragment> drawn) {
      count += drawn.size();
      if (compared) comparator.add(golden->draw_next(words, drawn.size()), drawn);
    });
    const double seconds = process_seconds() - start;
    comparator.finish();
    check(comparator.mismatches() == 0 && count == s.golden.size(), way, s);
    if (compared) return seconds;
    // Draw once more, not timed, and check the picture.
    std::vector<Fragment> again;
    draw([&](std::span<const Fragment> drawn) { again.insert(again.end(), drawn.begin(), drawn.end()); });
    check(again == s.golden, way, s);
    return seconds;
  };
}

Go in_ghdl(Way way, const WayInput& input) {
  const auto runner =
      std::make_shared<const GhdlRunner>(must(GhdlRunner::open(input.stream->key, input.folders)));
  const std::filesystem::path init = input.scratch / (short_name(way) + ".init"),
                              trace = input.scratch / (short_name(way) + ".trace");
  return [=, &s = *input.stream] {
    must(write_init_file(init, s.key.name(), {s.init_bits, s.words}));
    const double before = children_seconds();
    must(runner->run(init, trace));
    const double seconds = children_seconds() - before;
    check(must(read_trace(trace, s.key.name())).fragments == s.golden, way, s);
    return seconds;
  };
}

Go golden_alone(Way way, const WayInput& input) {
  constexpr std::size_t c_at_a_time = 4096;  // fragments
  const std::shared_ptr<GoldenModel> golden = make_golden_model(input.stream->key);
  return [=, &s = *input.stream] {
    std::size_t count = 0;
    std::span<const std::uint32_t> words = s.words;
    const double start = process_seconds();
    while (!words.empty()) count += golden->draw_next(words, c_at_a_time).size();
    const double seconds = process_seconds() - start;
    check(count == s.golden.size(), way, s);
    return seconds;
  };
}

ReferenceImage reference_of(const WayInput& input, const std::vector<ScreenTriangle>& triangles) {
  return render_reference(*input.scene, triangles, {.frame = input.size});
}

/// The pixels of which all neighbours are covered too.
std::vector<std::uint8_t> inside(const std::vector<std::uint8_t>& mask, FrameSize size) {
  std::vector<std::uint8_t> inner(mask.size());
  for (std::size_t y = 1; y + 1 < size.height; ++y)
    for (std::size_t x = 1; x + 1 < size.width; ++x) {
      std::uint8_t all = 1;
      for (std::size_t v = y - 1; v <= y + 1; ++v)
        for (std::size_t u = x - 1; u <= x + 1; ++u) all &= mask[v * size.width + u];
      inner[y * size.width + x] = all;
    }
  return inner;
}

}  // namespace

std::string to_string(Way way) {
  return facts_of(way).title;
}

std::string short_name(Way way) {
  return facts_of(way).short_name;
}

bool in_lanes(Way way) {
  return facts_of(way).in_lanes;
}

bool is_compared(Way way) {
  return facts_of(way).compared;
}

std::string lacking(Way way, const SimulatorFolders& folders) {
  return way == Way::mesa ? mesa_lacks(folders.source) : "";
}

MesaRun run_mesa(const WayInput& input, int repetitions) {
  const MesaPicture drawn = draw_by_mesa(
      {.scene = input.scene->name, .size = input.size, .repetitions = repetitions}, input.folders.source);
  const ReferenceImage reference = reference_of(input, Projector(*input.scene, input.size, {}).project_all());
  const FrameDistance whole = must(frame_distance(drawn.frame, reference.frame, reference.mask)),
                      inner = must(
                          frame_distance(drawn.frame, reference.frame, inside(reference.mask, input.size)));
  const MesaRun run{
      .seconds = drawn.seconds,
      .elapsed_seconds = drawn.elapsed_seconds / repetitions,
      .psnr_db = inner.psnr_db,
      .max_lsb = inner.max_lsb,
      .outline_off = static_cast<double>(whole.off - inner.off) / static_cast<double>(whole.pixels),
      .renderer = drawn.renderer};
  if (inner.pixels == 0 || !(run.psnr_db >= c_mesa_least_psnr_db) || run.outline_off > c_mesa_most_off)
    throw Failure{
        {ExitCode::differs,
         fmt::format("Mesa draws another picture: {:.1f} dB and {}/255 against the reference, {:.2g} of the "
                     "pixels off on outlines",
                     run.psnr_db, run.max_lsb, run.outline_off)}};
  return run;
}

Go make_way(Way way, const WayInput& input) {
  if (const std::string program = lacking(way, input.folders); !program.empty())
    throw_tool_failed("{} is not here", program);
  switch (way) {
    case Way::ghdl:
      return in_ghdl(way, input);
    case Way::golden:
      return golden_alone(way, input);
    case Way::reference:
      return [input, triangles = Projector(*input.scene, input.size, {}).project_all()] {
        const double start = process_seconds();
        reference_of(input, triangles);
        return process_seconds() - start;
      };
    case Way::mesa:
      return [input] { return run_mesa(input, 3).seconds; };
    case Way::lanes_compared:
    case Way::lanes:
    case Way::lanes_without_avx512_compared:
    case Way::lanes_without_avx512:
    case Way::verilator_compared:
    case Way::verilator:
      break;
  }
  return in_process(way, input);
}

}  // namespace halfway
