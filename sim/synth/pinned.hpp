// SPDX-License-Identifier: Apache-2.0
// The figures that are pinned, tb/synth/pinned.txt, and what may differ from them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/synth/synthesis.hpp"

namespace halfway::synth {

// From the project's root.
inline constexpr const char* kPins = "tb/synth/pinned.txt";
inline constexpr const char* kStudyPins = "sim/studies/clocks.txt";  ///< of hardware that studies draw by

/// Luts and carries may differ by this share and this many, whichever is more: another Yosys maps a little
/// differently. Flip-flops and RAMs are what the RTL says, to one.
inline constexpr double c_lut_share = 0.03;
inline constexpr std::uint64_t c_lut_slack = 3;
/// The median seed's clock may be slower by this share; a faster one by as much asks to be pinned.
inline constexpr double c_clock_share = 0.08;

struct Pin {
  Ice40Cells cells;
  double mhz = 0;           ///< of the median seed; 0 where the design is not placed
  std::string netlist{};    ///< what the clock is of: Synthesizer::netlist_hash; empty: not known here
  unsigned seeds = kSeeds;  ///< of how many placements the clock is the median
  std::size_t line = 0;     ///< of the file
};
using Pins = std::map<std::string, Pin>;

/// A line a design: name luts carries flip-flops RAMs MHz netlist seeds; `#` begins a comment. The netlist's
/// hash may be missing, and the seeds, which stand behind it, where they are kSeeds. A line
/// `flow HASH` says what flow_hash was: where it is another now, or there is none, no netlist is known.
Result<Pins> read_pins(const std::filesystem::path& path);
Status write_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions);
/// kStudyPins.
Status write_study_pins(const std::filesystem::path& path, const Pins& pins, const std::string& versions);
/// The tools' versions that the pins were written with, as write_pins was told them; empty where the file
/// does not say.
Result<std::string> pin_versions(const std::filesystem::path& path);

/// The ns that the papers print for a design, by its name, on an XCV300: a pixel of the quadratic and the
/// spherical shader, a clock of a shading processor.
std::optional<int> published_ns(std::string_view design);

/// README's part "clocks": the shaders' cells and clocks. An error where a design of it is not pinned, or not
/// placed.
Result<std::string> readme_clocks(const Pins& pins);

/// What is wrong with a design's figures, a line each with the pin's place; empty where nothing is. `mhz`
/// none: not measured; 0: not placed.
std::string compare(const std::string& name, const Pins& pins, const Ice40Cells& cells,
                    std::optional<double> mhz);

}  // namespace halfway::synth
