// SPDX-License-Identifier: Apache-2.0
// Visible differences between two frames.
#pragma once

#include <cstdint>

#include "common/result.hpp"
#include "frame/frame.hpp"

namespace halfway {

/// Number of pixels with a visible difference in brightness, by OpenImageIO's implementation of Yee's
/// perceptual metric, on a display of 100 cd/m2 with a field of view of 45 degrees. Brightness is the mean of
/// the channels: with three channels OpenImageIO 2.4 always reports no difference. The frames must have the
/// same size.
Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b);

}  // namespace halfway
