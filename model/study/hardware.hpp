// SPDX-License-Identifier: Apache-2.0
// The hardware of a study's points, and what it costs: figures of a hardware key, not of a point.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/result.hpp"
#include "plan/cells.hpp"
#include "plan/hardware_key.hpp"
#include "scene/scene.hpp"
#include "setup/made_formats.hpp"
#include "sim/ghdl/ghdl_library.hpp"
#include "sim/synth/synthesis.hpp"
#include "study/design_point.hpp"
#include "study/record.hpp"
#include "tables/made_tables.hpp"

namespace halfway::study {

/// The hardware that draws a point.
struct PointHardware {
  HardwareKey key;
  std::shared_ptr<const tables::MadeTables> tables;  ///< the key's, where the program was not built with them
  std::shared_ptr<const MadeFormats> formats{};      ///< likewise
};
/// The point must be hardware's; bad input where it cannot draw the scene. With other word lengths than the
/// preset's it can be drawn by `drawing_hardware_of` alone.
Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene);
/// The same with formats that the program was not built with: compiled, where the cache does not have them.
Result<PointHardware> drawing_hardware_of(const DesignPoint& point, const Scene& scene,
                                          const SimulatorFolders& folders);

/// What the point's RTL is made from: `folders`, or where it has tables or word lengths that the program was
/// not built with, a copy in the cache.
Result<SimulatorFolders> rtl_of(const DesignPoint& point, const SimulatorFolders& folders);

inline constexpr const char* c_not_placed = "not placed";

struct HardwareFigures {
  std::optional<Cells> cells;  ///< of no FPGA family; none without Yosys
  /// On an iCE40 HX8K with registered ports, the median of synth::kSeeds placements.
  std::optional<double> mhz;
  /// Where that is from, `pinned` or `placed`; or why there is none.
  std::string clock = c_not_placed;
  /// Of hardware that was placed: by itself, without the registers around it.
  std::optional<synth::Ice40Cells> ice40;
  /// The device has no room for it: it never has a clock there.
  bool fits = true;
};
/// By the key's name.
using HardwareTable = std::map<std::string, HardwareFigures>;

/// LUTs and flip-flops, tables and multipliers as LUTs among them; memory that is written as LUTs of 16 bits.
double cell_count(const Cells& cells);

struct FiguresOptions {
  unsigned threads = 1;
  /// Synthesizes and places what has no pinned clock, minutes each; else such a clock is not known.
  bool place = false;
  std::function<void(const std::string&)> on_progress = [](const std::string&) {};
};

/// The cells and clocks of all hardware that the records name, each from the cache where it is there. Without
/// Yosys there is a table without cells; a clock is pinned in tb/synth/pinned.txt by the hash of the netlist
/// that it is of.
Result<HardwareTable> hardware_figures(const std::string& scene, std::span<const Record> records,
                                       const SimulatorFolders& folders, const FiguresOptions& options);

}  // namespace halfway::study
