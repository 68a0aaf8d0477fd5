// SPDX-License-Identifier: Apache-2.0
// Figure 7 of the quadratic paper: the trace of the authors' own simulation, compared with our registers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "golden/quadratic_shader.hpp"
#include "plan/hardware_key.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"

namespace halfway::figures {

/// Values of a register in time order.
using TraceWords = std::vector<std::uint32_t>;

/// Contents of tb/specification/paper/figure7.txt, by register names.
struct Figure7 {
  std::map<std::string, std::uint32_t> step;
  std::map<std::string, TraceWords> line, pixel;
  /// Per register, which words are illegible in the scan and restored from their differences.
  std::map<std::string, std::vector<bool>> restored;

  const TraceWords& words(const std::string& name) const {
    return line.contains(name) ? line.at(name) : pixel.at(name);
  }
  /// The published words of a register, restored ones in square brackets.
  std::string published(const std::string& name) const;
};
/// Throws Failure.
Figure7 read_figure7(const std::filesystem::path& file);

/// Line k has k pixels; the printed trace ends within the fourth line.
inline constexpr std::uint32_t c_figure7_lines = 4,
                               c_figure7_pixels = c_figure7_lines * (c_figure7_lines + 1) / 2;
inline constexpr std::uint32_t c_figure7_triangle = 7, c_figure7_x = 20, c_figure7_y = 10;

/// The hardware and its golden model.
const HardwareKey& figure7_key();
using Figure7Shader = golden::QuadraticShader<words::Published, 1>;

/// Edges with slopes of 0 and 1 pixel per line, so that line k has k pixels.
std::array<std::uint32_t, Figure7Shader::c_init_words> figure7_init(const Figure7& figure);

/// Registers of the line stage (per line) and of the span stage (per pixel), with the figure's names, and
/// clocks if known.
struct Figure7Trace {
  std::map<std::string, TraceWords> line, pixel;
  TraceWords pixel_x, pixel_y;
  std::vector<std::uint64_t> line_clock, pixel_clock;
  bool known = true;  ///< no register read had an undefined bit
};

/// Trace of the golden model, without clocks.
Figure7Trace golden_figure7(const Figure7& figure);
/// Trace of the RTL in GHDL. Throws Failure.
Figure7Trace rtl_figure7(const Figure7& figure, const SimulatorFolders& folders);

/// "FFFD1688 FFFD0626"
std::string hexadecimal(std::span<const std::uint32_t> words);

}  // namespace halfway::figures
