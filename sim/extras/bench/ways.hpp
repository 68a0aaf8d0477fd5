// SPDX-License-Identifier: Apache-2.0
// The ways to draw a picture that `make bench` compares. Each timed run checks its picture.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/extras/bench/workload.hpp"

namespace halfway {

enum class Way {
  lanes_compared,
  lanes,
  lanes_without_avx512_compared,
  lanes_without_avx512,
  verilator_compared,
  verilator,
  ghdl,
  golden,
  reference,
  mesa,
};
inline constexpr auto c_ways = [] {
  std::array<Way, static_cast<std::size_t>(Way::mesa) + 1> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Way>(i);
  return all;
}();
/// Name in the tables.
std::string to_string(Way way);
/// Name in benchmarks.
std::string short_name(Way way);

bool in_lanes(Way way);
/// True if the golden model draws the same fragments, and every field is compared, within the measured time.
bool is_compared(Way way);

/// The packages that a way needs and this machine lacks; empty if it can run.
std::string lacking(Way way, const SimulatorFolders& folders);

struct WayInput {
  const Scene* scene;  ///< a built-in scene for Way::mesa
  FrameSize size;
  const GoldenStream* stream;  ///< of that scene and size
  SimulatorFolders folders;
  std::filesystem::path scratch;  ///< an existing folder
  bool fast = true;               ///< false: compile without optimization, for checking but not for timing
};

/// Draw the picture once and return the processor seconds. Throws Failure if the picture is wrong.
using Go = std::function<double()>;
/// Build everything that the way needs, or throw Failure. The input must outlive the result.
Go make_way(Way way, const WayInput& input);

/// Limits for Way::mesa against the reference. Pixels inside outlines differ, because Mesa uses floats and
/// another subpixel grid for vertices: limit on PSNR. On outlines the grids cover different pixels: limit on
/// the part of all pixels that differ there by more than 2/255.
inline constexpr double c_mesa_least_psnr_db = 50.0, c_mesa_most_off = 0.01;
struct MesaRun {
  double seconds = 0.0;          ///< processor seconds of the fastest repetition
  double elapsed_seconds = 0.0;  ///< mean of the repetitions
  double psnr_db = 0.0;          ///< inside outlines
  unsigned max_lsb = 0;          ///< inside outlines: the largest difference
  double outline_off = 0.0;      ///< part of the covered pixels that differ on outlines
  std::string renderer;          ///< the renderer's name
};
/// Draw the built-in scene and compare the picture with the reference. Throws Failure if they differ by more.
MesaRun run_mesa(const WayInput& input, int repetitions);

}  // namespace halfway
