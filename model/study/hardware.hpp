// SPDX-License-Identifier: Apache-2.0
// The hardware of a study's points, and what it costs: figures of a hardware key, not of a point.
#pragma once

#include <functional>
#include <map>
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

namespace halfway::study {

/// The point's hardware, and the folders that its RTL is made from: where it has tables of a size that the
/// program was not built with, those of a copy in the cache.
struct PointHardware {
  HardwareKey key;
  SimulatorFolders folders;
};
Result<PointHardware> hardware_of(const DesignPoint& point, const Scene& scene,
                                  const SimulatorFolders& folders);

/// The hardware that draws the point, which must be hardware's; bad input where it cannot draw the scene.
Result<HardwareKey> hardware_of(const DesignPoint& point, const Scene& scene);

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
