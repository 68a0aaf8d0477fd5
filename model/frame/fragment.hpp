// SPDX-License-Identifier: Apache-2.0
// A fragment: the hardware's output for one covered pixel of one triangle.
#pragma once

#include <cstdint>

namespace halfway {

struct Fragment {
  std::uint32_t triangle;  ///< number of the triangle in the scene
  std::uint32_t z;         ///< depth, 24 bits, increases with distance
  std::uint16_t y, x;      ///< pixel, (0, 0) at the frame's top left
  std::uint8_t red, green, blue;
  std::uint8_t reserved = 0;

  friend bool operator==(const Fragment&, const Fragment&) = default;
};
static_assert(sizeof(Fragment) == 16);

}  // namespace halfway
