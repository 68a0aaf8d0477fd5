// SPDX-License-Identifier: Apache-2.0
// Table 4 of the processors paper: clocks of the folded shading processor, as measured in the RTL.
#pragma once

#include <array>
#include <optional>

#include "plan/hardware_key.hpp"
#include "shading/effects.hpp"
#include "words/processors_layout.hpp"

namespace halfway {

/// A row of the table: clocks from the acceptance of one token to the acceptance of the next while the output
/// is not stalled, measured in the RTL by tb/rtl/illumination/table4_tb.vhd. For an object that the light
/// reaches. In preset exact it takes fewer clocks if the highlight is below the horizon.
struct ProcessorClocks {
  const char* what;
  std::optional<words::Term> term;  ///< empty: no term to compute
  std::optional<LightKind> light;   ///< empty: ambient
  bool normalize, view;             ///< the ambient processor normalizes N; it computes the view vector
  std::optional<unsigned> paper;    ///< as printed
  unsigned exact;
  std::optional<unsigned> published;  ///< empty: this preset has no such operation

  std::optional<unsigned> clocks(Preset preset) const { return preset == Preset::exact ? exact : published; }
};

inline constexpr std::array<ProcessorClocks, 11> c_processor_clocks = {{
    {"load, shadow polygon, unlit", std::nullopt, std::nullopt, false, false, 2, 2, 2},
    {"ambient", words::Term::ambient, std::nullopt, false, false, 4, 5, 4},
    {"ambient, N normalized", words::Term::ambient, std::nullopt, true, false, 6, 15, 6},
    {"ambient, view vector", words::Term::ambient, std::nullopt, false, true, std::nullopt, 16, std::nullopt},
    {"ambient, N normalized, view vector", words::Term::ambient, std::nullopt, true, true, std::nullopt, 26,
     std::nullopt},
    {"directional diffuse", words::Term::diffuse, LightKind::directional, false, false, 6, 9, 6},
    {"directional specular", words::Term::specular, LightKind::directional, false, false, 7, 34, 7},
    {"positional diffuse", words::Term::diffuse, LightKind::positional, false, false, 12, 26, 12},
    {"positional specular", words::Term::specular, LightKind::positional, false, false, 13, 51, 13},
    {"spot diffuse", words::Term::diffuse, LightKind::spot, false, false, std::nullopt, 37, 22},
    {"spot specular", words::Term::specular, LightKind::spot, false, false, std::nullopt, 54, 28},
}};

/// The slowest operation in the pipeline of a processors shader's key. It determines the throughput.
const ProcessorClocks& slowest_processor(const HardwareKey& key);

}  // namespace halfway
