// SPDX-License-Identifier: Apache-2.0
// What of two frames' difference an eye sees.
#pragma once

#include <cstdint>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Pixels whose difference is seen: Yee's perceptual metric as OpenImageIO has it, on a display of 100 cd/m2
/// that fills 45 degrees of the view. Sizes must agree.
Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b);

}  // namespace halfway
