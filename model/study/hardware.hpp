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
#include "sim/ghdl/ghdl_library.hpp"
#include "study/design_point.hpp"
#include "study/record.hpp"
#include "tables/made_tables.hpp"

namespace halfway::study {

/// The hardware that draws a point.
struct PointHardware {
  HardwareKey key;
  std::shared_ptr<const tables::MadeTables> tables;  ///< the key's, where the program was not built with them
};
/// The point must be hardware's; bad input where it cannot draw the scene.
Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene);

/// What the point's RTL is made from: `folders`, or where it has tables that the program was not built with,
/// a copy in the cache.
Result<SimulatorFolders> rtl_of(const DesignPoint& point, const SimulatorFolders& folders);

struct HardwareFigures {
  std::optional<Cells> cells;  ///< of no FPGA family; none without Yosys
};
/// By the key's name.
using HardwareTable = std::map<std::string, HardwareFigures>;

/// LUTs, flip-flops and bits of the products of multipliers that are counted apart: fewer than those would
/// take as LUTs.
double cell_count(const Cells& cells);

/// Counts the cells of all hardware that the records name, on all threads. Without Yosys there is a table
/// without cells.
Result<HardwareTable> hardware_figures(const std::string& scene, std::span<const Record> records,
                                       const SimulatorFolders& folders, unsigned threads,
                                       const std::function<void(const std::string&)>& on_progress);

}  // namespace halfway::study
