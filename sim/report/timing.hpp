// SPDX-License-Identifier: Apache-2.0
// Timing diagrams of two small triangles in a shader, simulated in GHDL.
#pragma once

#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::report {

struct TimingDiagram {
  std::string key;                ///< name of the hardware key
  std::vector<std::string> svgs;  ///< consecutive clocks, divided to fit the page's width
  /// Description of the picture: the clocks of the first fragments, with position and colour.
  std::string words;
};

/// Draw the first clocks. Exit code tool_failed if GHDL or gnuplot is missing.
Result<TimingDiagram> draw_shader_timing(Shader shader, const SimulatorFolders& folders);

}  // namespace halfway::report
