// SPDX-License-Identifier: Apache-2.0
// Four words side by side in one vector, for speed where no register is watched. The compiler has such
// vectors on every processor; with AVX2 or AVX-512 they are registers.
#pragma once

#pragma GCC diagnostic ignored "-Wpsabi"

#include <cstddef>
#include <cstdint>

#include "frame/fragment.hpp"

namespace halfway::golden {

// How a function takes and gives such a vector depends on the processor that it is compiled for, and callers
// may be compiled for a better one: whatever gives one is inlined. So it is with their alignment, which is
// stated.

/// Each kept at the top of 64 bits as Word is, or a whole number.
using FourWords = std::uint64_t __attribute__((vector_size(32), aligned(32)));
using FourSigned = std::int64_t __attribute__((vector_size(32), aligned(32)));

// Fragments are written as two halves: triangle and depth; y, x and colours.
static_assert(sizeof(Fragment) == 16 && offsetof(Fragment, z) == 4 && offsetof(Fragment, y) == 8 &&
              offsetof(Fragment, x) == 10 && offsetof(Fragment, red) == 12 &&
              offsetof(Fragment, green) == 13 && offsetof(Fragment, blue) == 14);

}  // namespace halfway::golden
