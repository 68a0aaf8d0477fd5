// SPDX-License-Identifier: Apache-2.0
// The way of a pixel as text for the page.
#pragma once

#include <string>

#include "sim/extras/live_core/live_frame.hpp"

namespace halfway::live {

/// One line for each item, its fields separated by tabs:
///   triangle  number, number of its init vector
///   given     what: "init vector" or "line's record"
///   stage     name, cycle: empty if the RTL has no such event
///   value     name, golden model's, RTL's, "equal" or "differs"; of a given value only the first two
///   first     the first difference, with its stage and entity
///   fault     message
/// A triangle precedes its given values and stages, and these their values.
std::string lines_of(const Way& way);

}  // namespace halfway::live
