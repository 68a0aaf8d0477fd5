// SPDX-License-Identifier: Apache-2.0
// The ways to a picture that `make bench` holds against one another. Each is checked to draw what it should
// every time that it is timed.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "common/result.hpp"
#include "sim/bench/workload.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway {

enum class Way {
  lanes_compared,
  lanes,
  verilator_compared,
  verilator,
  verilator_as_it_comes,
  cxxrtl,
  ghdl_llvm,
  ghdl_mcode,
  golden,
  reference,
  mesa,
};
inline constexpr auto c_ways = [] {
  std::array<Way, static_cast<std::size_t>(Way::mesa) + 1> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Way>(i);
  return all;
}();
/// As the tables call it.
std::string to_string(Way way);
/// As a benchmark's name.
std::string short_name(Way way);

/// What a way needs that this machine has not: a program's or a package's name; empty: nothing.
std::string lacking(Way way, const SimulatorFolders& folders);

struct WayInput {
  const Scene* scene;  ///< a built-in one for Way::mesa
  FrameSize size;
  const InitBatches* batches;  ///< of that scene and size
  SimulatorFolders folders;
  std::filesystem::path scratch;  ///< a folder that is there
  bool fast = true;  ///< else what is compiled here is compiled quickly: to check, not to measure
};

/// Processor seconds of the picture once; an error where it is not the right one.
using Go = std::function<Result<double>()>;
/// Builds what is to be built. The input must outlive the result.
Result<Go> make_way(Way way, const WayInput& input);

/// Of Way::mesa beside the reference, within outlines: floats, and vertices on another grid of subpixels. Of
/// all pixels so many may be off by more than 2/255 on outlines, where the grids cover other pixels.
inline constexpr double c_mesa_least_psnr_db = 50.0, c_mesa_most_off = 0.01;
struct MesaPicture {
  double seconds = 0.0;
  double psnr_db = 0.0;      ///< within outlines
  unsigned max_lsb = 0;      ///< there, the largest difference
  double outline_off = 0.0;  ///< part of the covered pixels that is off on outlines
  std::string renderer;      ///< as it names itself
};
Result<MesaPicture> draw_by_mesa(const WayInput& input, int repetitions);

/// The program that `ghdl-mcode` is: installed, or unpacked in build/tools by scripts/unpack.sh; may be
/// missing.
std::string ghdl_mcode(const SimulatorFolders& folders);

}  // namespace halfway
