// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/saturating_sum.vhd.
#pragma once

#include <algorithm>
#include <cstdint>

namespace halfway::golden {

/// A sum of unsigned terms, added one by one. The sum is exact.
class SaturatingSum {
 public:
  constexpr void add(std::uint64_t term) { sum_ += term; }
  constexpr std::uint64_t sum() const { return sum_; }
  constexpr std::uint32_t result(int fraction_bits, int result_bits) const {
    const std::uint64_t largest = (std::uint64_t{1} << result_bits) - 1;
    return static_cast<std::uint32_t>(std::min(sum_ >> fraction_bits, largest));
  }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace halfway::golden
