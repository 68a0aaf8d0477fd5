// SPDX-License-Identifier: Apache-2.0
// Visible differences between two frames.
#pragma once

#include <cstdint>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Number of pixels with a visible difference: FLIP (flip.hpp) is above 0.0575, its error for flat patches
/// one unit of CIELAB's lightness apart, two to three steps of 1/255 of a grey. The frames must have the same
/// size.
Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b);

}  // namespace halfway
