// SPDX-License-Identifier: Apache-2.0
// Timing diagrams: two triangles of a few pixels go through a shader in GHDL.
#pragma once

#include <string>
#include <vector>

#include "common/result.hpp"
#include "plan/hardware_key.hpp"
#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::report {

struct TimingDiagram {
  std::string key;                ///< of the hardware
  std::vector<std::string> svgs;  ///< the clocks in order, as many in each as a page is wide
  /// What the picture shows, in words: the clocks of the first fragments, with place and colour.
  std::string words;
};

/// Its first clocks. Exit code tool_failed where GHDL or gnuplot is missing.
Result<TimingDiagram> draw_shader_timing(Shader shader, const SimulatorFolders& folders);

}  // namespace halfway::report
