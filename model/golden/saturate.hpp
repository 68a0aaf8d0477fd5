// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/arithmetic/saturate.vhd.
#pragma once

#include "golden/words.hpp"

namespace halfway::golden {

template <int W, int FractionBits, int ResultBits>
constexpr std::uint32_t saturate(Word<W> value) {
  static_assert(W >= FractionBits + ResultBits + 2 && ResultBits < 32);
  constexpr std::int64_t c_largest = (std::int64_t{1} << ResultBits) - 1;
  const std::int64_t whole = value.value() >> FractionBits;
  return static_cast<std::uint32_t>(whole < 0 ? 0 : whole > c_largest ? c_largest : whole);
}

}  // namespace halfway::golden
