// SPDX-License-Identifier: Apache-2.0
// Table 4 of the processors paper: clocks of the folded shading processor, as the RTL has them.
#pragma once

#include <array>
#include <optional>

#include "golden/shading_processor.hpp"
#include "plan/hardware_key.hpp"
#include "shading/effects.hpp"

namespace halfway {

/// A row of the table: clocks from one token taken to the next one taken while nothing behind the processor
/// waits, measured in the RTL by tb/illumination/table4_tb.vhd. Of an object that the light reaches; where it
/// takes fewer in preset exact, the highlight is below the horizon.
struct ProcessorClocks {
  const char* what;
  std::optional<golden::Term> term;  ///< none: what no processor works on
  std::optional<LightKind> light;    ///< none: the ambient one
  bool normalize, view;              ///< the ambient processor normalizes N, makes the view vector
  std::optional<unsigned> paper;     ///< as printed
  unsigned exact;
  std::optional<unsigned> published;  ///< none: this preset has no such work

  std::optional<unsigned> clocks(Preset preset) const { return preset == Preset::exact ? exact : published; }
};

inline constexpr std::array<ProcessorClocks, 11> c_processor_clocks = {{
    {"load, shadow polygon, unlit", std::nullopt, std::nullopt, false, false, 2, 2, 2},
    {"ambient", golden::Term::ambient, std::nullopt, false, false, 4, 4, 4},
    {"ambient, N normalized", golden::Term::ambient, std::nullopt, true, false, 6, 9, 6},
    {"ambient, view vector", golden::Term::ambient, std::nullopt, false, true, std::nullopt, 10,
     std::nullopt},
    {"ambient, N normalized, view vector", golden::Term::ambient, std::nullopt, true, true, std::nullopt, 15,
     std::nullopt},
    {"directional diffuse", golden::Term::diffuse, LightKind::directional, false, false, 6, 6, 6},
    {"directional specular", golden::Term::specular, LightKind::directional, false, false, 7, 20, 7},
    {"positional diffuse", golden::Term::diffuse, LightKind::positional, false, false, 12, 16, 12},
    {"positional specular", golden::Term::specular, LightKind::positional, false, false, 13, 30, 13},
    {"spot diffuse", golden::Term::diffuse, LightKind::spot, false, false, std::nullopt, 22, 18},
    {"spot specular", golden::Term::specular, LightKind::spot, false, false, std::nullopt, 32, 24},
}};

/// The work that takes longest in the pipeline of a processors shader's key: it sets the pace of all.
const ProcessorClocks& slowest_processor(const HardwareKey& key);

}  // namespace halfway
