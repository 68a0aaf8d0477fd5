// SPDX-License-Identifier: Apache-2.0
// What of two frames' difference an eye sees.
#pragma once

#include <cstdint>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Pixels whose difference in brightness is seen: Yee's perceptual metric as OpenImageIO has it, on a display
/// of 100 cd/m2 that fills 45 degrees of the view. Brightness is the mean of the channels: given three
/// channels OpenImageIO 2.4 finds no difference whatever they hold. Sizes must agree.
Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b);

}  // namespace halfway
