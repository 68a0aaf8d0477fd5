// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace halfway {

/// In pixels.
struct FrameSize {
  std::uint32_t width = 0, height = 0;
};

}  // namespace halfway
