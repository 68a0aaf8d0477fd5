// SPDX-License-Identifier: Apache-2.0
// The clocks of docs/performance.md.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/cost/clock_store.hpp"

namespace halfway::synth {

/// The papers' time in ns for a design on an XCV300: per pixel of the quadratic and the spherical shader, per
/// clock of a shading processor.
std::optional<int> published_ns(std::string_view design);

/// Cells and clocks of the shaders. Throws Failure if one of its designs has no clock.
std::string performance_table(const ClockStore& clocks);

}  // namespace halfway::synth
