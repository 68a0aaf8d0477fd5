// SPDX-License-Identifier: Apache-2.0
#include "sim/bench/yardstick.hpp"

// Compile a function for several processors; the copy is selected at run time.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define HALFWAY_FOR_PROCESSORS \
  __attribute__((flatten, target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define HALFWAY_FOR_PROCESSORS
#endif

namespace halfway {

HALFWAY_FOR_PROCESSORS
std::uint32_t sum_in_registers(std::uint32_t rounds) {
  using Vector = std::uint32_t __attribute__((vector_size(64)));
  Vector a = Vector{} + rounds, b = a + 1, c = a + 2, d = a + 3, e = a + 4, f = a + 5, g = a + 6, h = a + 7;
  // Each sum adds a neighbour. Half of the additions are independent of each other, and the compiler cannot
  // shorten the loop.
  for (std::uint32_t round = 0; round < rounds; ++round) {
    a += b;
    c += d;
    e += f;
    g += h;
    b += c;
    d += e;
    f += g;
    h += a;
  }
  const Vector all = a ^ b ^ c ^ d ^ e ^ f ^ g ^ h;
  return all[0];
}

}  // namespace halfway
