// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/ways.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "frame/metrics.hpp"
#include "golden_run/golden_run.hpp"
#include "reference/renderer.hpp"
#include "setup/project.hpp"
#include "sim/bench/outside_model.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/ghdl/ghdl_runner.hpp"
#include "sim/mesa/mesa_picture.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/stream_files/init_file.hpp"
#include "sim/stream_files/trace.hpp"
#include "sim/system/file.hpp"
#include "sim/system/seconds.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway {
namespace {

struct Name {
  const char *short_name, *title;
};
const Name& name_of(Way way) {
  static constexpr std::array<Name, c_ways.size()> c_names = {
      {{"lanes_compared", "RTL in lanes, every field compared with the golden model drawn on the same core"},
       {"lanes", "RTL in lanes alone"},
       {"lanes_without_avx512_compared", "RTL in lanes, compiled without AVX-512, compared likewise"},
       {"lanes_without_avx512", "RTL in lanes, compiled without AVX-512, alone"},
       {"verilator_compared", "RTL in Verilator as built here, compared likewise"},
       {"verilator", "RTL in Verilator as built here, alone"},
       {"verilator_as_it_comes", "RTL in Verilator as it comes, alone"},
       {"cxxrtl", "RTL in CXXRTL, alone"},
       {"ghdl_llvm", "RTL in GHDL, llvm"},
       {"ghdl_mcode", "RTL in GHDL, mcode"},
       {"golden", "golden model alone"},
       {"reference", "Phong shading per pixel in double, the reference renderer"},
       {"mesa", "Phong shading per pixel by OpenGL on Mesa's llvmpipe"}}};
  return c_names.at(static_cast<std::size_t>(way));
}

Error wrong(Way way, const HardwareKey& key) {
  return {ExitCode::differs,
          fmt::format("{}, {}: not the golden model's fragments", to_string(way), key.name())};
}

std::string ghdl_program(Way way, const SimulatorFolders& folders) {
  return way == Way::ghdl_llvm ? "ghdl-llvm" : ghdl_mcode(folders);
}

bool without_avx512(Way way) {
  return way == Way::lanes_without_avx512_compared || way == Way::lanes_without_avx512;
}

/// RTL in this process, alone, or with the golden model and a comparison of every field on the same thread.
Result<Go> in_process(Way way, const WayInput& input) {
  const bool compared = is_compared(way);
  auto opened = open_engine(
      in_lanes(way) ? EngineKind::lanes : EngineKind::verilator, input.batches->key, input.folders,
      {.fast = input.fast, .vectors = without_avx512(way) ? LaneVectors::avx2 : LaneVectors::avx512});
  if (!opened) return opened.error();
  const std::shared_ptr<GoldenModel> golden = make_golden_model(input.batches->key);
  return Go([=, engine = *opened, &s = *input.batches]() -> Result<double> {
    StreamComparator comparator;
    std::span<const std::uint32_t> words = s.words;  // not yet drawn by the golden model
    std::size_t count = 0;
    const auto draw = [&](const Engine::OnDrawn& on_drawn) -> Status {
      if (Status ran = engine->draw(s.words, SIZE_MAX, on_drawn); !ran) return ran;
      return engine->drain(SIZE_MAX, on_drawn);
    };
    const double start = process_seconds();
    const Status ran = draw([&](std::span<const Fragment> drawn) {
      count += drawn.size();
      if (compared) comparator.add(golden->draw_next(words, drawn.size()), drawn);
    });
    const double seconds = process_seconds() - start;
    if (!ran) return ran.error();
    comparator.finish();
    if (comparator.mismatches() != 0 || count != s.golden.size()) return wrong(way, s.key);
    if (compared) return seconds;
    // Draw once more, not timed, and check the picture.
    std::size_t known = 0;
    bool same = true;
    if (Status again = draw([&](std::span<const Fragment> drawn) {
          same =
              same && drawn.size() <= s.golden.size() - known &&
              std::equal(drawn.begin(), drawn.end(), s.golden.begin() + static_cast<std::ptrdiff_t>(known));
          known += drawn.size();
        });
        !again)
      return again.error();
    if (!same || known != s.golden.size()) return wrong(way, s.key);
    return seconds;
  });
}

Result<Go> outside(Way way, const WayInput& input) {
  auto model = OutsideModel::open(way == Way::cxxrtl ? OutsideTool::cxxrtl : OutsideTool::verilator,
                                  input.batches->key, input.folders, input.fast);
  if (!model) return model.error();
  return Go([way, model = std::move(*model), &s = *input.batches]() -> Result<double> {
    const auto run = model.run(s.words);
    if (!run) return run.error();
    if (run->fragments != s.golden) return wrong(way, s.key);
    return run->seconds;
  });
}

Result<Go> in_ghdl(Way way, const WayInput& input) {
  auto runner = GhdlRunner::open(input.batches->key, input.folders, ghdl_program(way, input.folders));
  if (!runner) return runner.error();
  const std::filesystem::path init = input.scratch / (short_name(way) + ".init"),
                              trace = input.scratch / (short_name(way) + ".trace");
  return Go([=, runner = std::move(*runner), &s = *input.batches]() -> Result<double> {
    if (const Status wrote = write_init_file(init, s.key.name(), {s.init_bits, s.words}); !wrote)
      return wrote.error();
    const double before = children_seconds();
    if (const auto run = runner.run(init, trace); !run) return run.error();
    const double seconds = children_seconds() - before;
    const auto drawn = read_trace(trace, s.key.name());
    if (!drawn) return drawn.error();
    if (drawn->fragments != s.golden) return wrong(way, s.key);
    return seconds;
  });
}

ReferenceImage reference_of(const WayInput& input, const std::vector<ScreenTriangle>& triangles) {
  return render_reference(*input.scene, triangles, {.frame = input.size, .subpixel_bits = 4});
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
  return name_of(way).title;
}

std::string short_name(Way way) {
  return name_of(way).short_name;
}

bool in_lanes(Way way) {
  return way == Way::lanes_compared || way == Way::lanes || without_avx512(way);
}

bool is_compared(Way way) {
  return way == Way::lanes_compared || way == Way::lanes_without_avx512_compared ||
         way == Way::verilator_compared;
}

std::string lacking(Way way, const SimulatorFolders& folders) {
  const auto program = [](const char* name) { return find_program(name).empty() ? name : ""; };
  switch (way) {
    case Way::cxxrtl:
      return find_program("yosys").empty() ? "yosys" : program("yosys-config");
    case Way::ghdl_llvm:
      return program("ghdl-llvm");
    case Way::ghdl_mcode:
      return std::filesystem::exists(ghdl_mcode(folders)) ? "" : "ghdl-mcode";
    case Way::mesa:
      return mesa_lacks(folders.source);
    default:
      return "";
  }
}

std::string ghdl_mcode(const SimulatorFolders& folders) {
  const std::filesystem::path installed = find_program("ghdl-mcode");
  return installed.empty() ? (folders.source / "build/tools/ghdl-mcode/usr/bin/ghdl-mcode").string()
                           : installed.string();
}

Result<MesaRun> run_mesa(const WayInput& input, int repetitions) {
  const auto drawn = draw_by_mesa(
      {.scene = input.scene->name, .size = input.size, .repetitions = repetitions}, input.folders.source);
  if (!drawn) return drawn.error();
  MesaRun run{.seconds = drawn->seconds,
              .elapsed_seconds = drawn->elapsed_seconds / repetitions,
              .renderer = drawn->renderer};
  const ReferenceImage reference = reference_of(input, Projector(*input.scene, input.size, {}).project_all());
  const auto whole = frame_distance(drawn->frame, reference.frame, reference.mask);
  if (!whole) return whole.error();
  const auto inner = frame_distance(drawn->frame, reference.frame, inside(reference.mask, input.size));
  if (!inner) return inner.error();
  run.outline_off = static_cast<double>(whole->off - inner->off) / static_cast<double>(whole->pixels);
  run.psnr_db = inner->psnr_db;
  run.max_lsb = inner->max_lsb;
  if (inner->pixels == 0 || !(run.psnr_db >= c_mesa_least_psnr_db) || run.outline_off > c_mesa_most_off)
    return Error{
        ExitCode::differs,
        fmt::format("Mesa draws another picture: {:.1f} dB and {}/255 against the reference, {:.2g} of the "
                    "pixels off on outlines",
                    run.psnr_db, run.max_lsb, run.outline_off)};
  return run;
}

Result<Go> make_way(Way way, const WayInput& input) {
  if (const std::string program = lacking(way, input.folders); !program.empty())
    return tool_failed(fmt::format("{} is not here", program));
  switch (way) {
    case Way::lanes_compared:
    case Way::lanes:
    case Way::lanes_without_avx512_compared:
    case Way::lanes_without_avx512:
    case Way::verilator_compared:
    case Way::verilator:
      return in_process(way, input);
    case Way::verilator_as_it_comes:
    case Way::cxxrtl:
      return outside(way, input);
    case Way::ghdl_llvm:
    case Way::ghdl_mcode:
      return in_ghdl(way, input);
    case Way::golden: {
      const std::shared_ptr<GoldenModel> golden = make_golden_model(input.batches->key);
      return Go([way, golden, &s = *input.batches]() -> Result<double> {
        std::size_t count = 0;
        auto rest = std::span<const std::uint32_t>(s.words);
        const double start = process_seconds();
        for (const std::size_t vectors : s.batches) {
          const auto words = rest.first(vectors * s.words_per_vector());
          rest = rest.subspan(words.size());
          count += golden->draw(words).size();
        }
        const double seconds = process_seconds() - start;
        if (count != s.golden.size()) return wrong(way, s.key);
        return seconds;
      });
    }
    case Way::reference: {
      auto triangles = Projector(*input.scene, input.size, {}).project_all();
      return Go([triangles = std::move(triangles), input]() -> Result<double> {
        const double start = process_seconds();
        const ReferenceImage image = reference_of(input, triangles);
        return process_seconds() - start;
      });
    }
    case Way::mesa:
      break;
  }
  return Go([input]() -> Result<double> {
    const auto run = run_mesa(input, 3);
    if (!run) return run.error();
    return run->seconds;
  });
}

}  // namespace halfway
