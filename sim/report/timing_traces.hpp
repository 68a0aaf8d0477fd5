// SPDX-License-Identifier: Apache-2.0
// Timing diagrams of two small triangles in a shader, simulated in GHDL.
#pragma once

#include <string>
#include <vector>

#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::report {

struct ShaderTiming {
  std::string key;                ///< name of the hardware key
  std::vector<std::string> svgs;  ///< consecutive clocks, divided to fit the page's width
  /// Description of the picture: the clocks of the first fragments, with position and colour.
  std::string words;
};

/// Draw the first clocks. Throws Failure with exit code tool_failed if GHDL or gnuplot is missing.
ShaderTiming draw_shader_timing(Shader shader, const SimulatorFolders& folders);

}  // namespace halfway::report
