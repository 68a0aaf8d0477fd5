// SPDX-License-Identifier: Apache-2.0
// Pinned results of synthesis, tb/synth/pinned.txt, and their tolerances.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/synth/synthesis.hpp"

namespace halfway::synth {

// Relative to the project's root.
inline constexpr const char* c_pins = "tb/synth/pinned.txt";
inline constexpr const char* c_study_pins = "sim/studies/clocks.txt";  ///< for the hardware of studies

/// LUTs and carries may differ by this share or by this number, whichever is larger, because versions of
/// Yosys map differently. Flip-flops and RAMs are fixed by the RTL and must be equal.
inline constexpr double c_lut_share = 0.03;
inline constexpr std::uint64_t c_lut_slack = 3;
/// Share by which the median clock may be slower. A clock that is faster by this share must be pinned again.
inline constexpr double c_clock_share = 0.08;

struct Pin {
  Ice40Cells cells;
  double mhz = 0;            ///< median of the seeds; 0 if the design is not placed
  std::string netlist{};     ///< Synthesizer::netlist_hash of the clock's netlist; empty: unknown
  unsigned seeds = c_seeds;  ///< number of placements that the clock is the median of
  std::size_t line = 0;      ///< line number in the file
};
using Pins = std::map<std::string, Pin>;

/// One line per design: name luts carries flip-flops RAMs MHz netlist seeds. `#` starts a comment. `netlist`
/// may be missing; `seeds` may be missing if it is c_seeds. A line `flow HASH` contains the flow_hash of the
/// pins. If it is missing or differs from the current one, all netlists count as unknown.
Result<Pins> read_pins(const std::filesystem::path& path);
Status write_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions);
/// Write c_study_pins.
Status write_study_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions);
/// The tools' versions that were given to write_pins; empty if the file has none.
Result<std::string> pin_versions(const std::filesystem::path& path);

/// The papers' time in ns for a design on an XCV300: per pixel of the quadratic and the spherical shader, per
/// clock of a shading processor.
std::optional<int> published_ns(std::string_view design);

/// README's part "clocks": cells and clocks of the shaders. An error if one of its designs is not pinned or
/// not placed.
Result<std::string> readme_clocks(const Pins& pins);

/// Deviations of a design's results, one line each with the position of the pin; empty: none. `mhz`
/// std::nullopt: not measured; 0: not placed.
std::string compare(const std::string& name, const Pins& pins, const Ice40Cells& cells,
                    std::optional<double> mhz);

}  // namespace halfway::synth
