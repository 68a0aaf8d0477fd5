// SPDX-License-Identifier: Apache-2.0
// Random words that are equal on all machines.
#pragma once

#include <cstdint>
#include <random>
#include <span>

#include "words/word.hpp"

namespace halfway::vectors {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits(int count) { return words::low_bits(engine_(), count); }
  /// low <= result <= high
  std::int64_t between(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool one_in(int count) { return between(1, count) == 1; }
  /// A word that is likely to find faults: extreme, small, of any magnitude and sign, or uniform.
  std::uint64_t word(int count) {
    const std::uint64_t top = std::uint64_t{1} << (count - 1);
    switch (between(0, 9)) {
      case 0: {
        const std::uint64_t extremes[] = {0, 1, ~std::uint64_t{0}, top, top - 1, top + 1};
        return words::low_bits(extremes[between(0, 5)], count);
      }
      case 1:
      case 2:
      case 3:
      case 4: {
        const std::uint64_t magnitude = engine_() >> between(64 - count, 63);
        return words::low_bits(one_in(2) ? ~magnitude : magnitude, count);
      }
      default:
        return bits(count);
    }
  }
  template <int W>
  words::Word<W> word() {
    return words::Word<W>::from_bits(word(W));
  }
  void fill(std::span<std::uint32_t> words) {
    for (std::uint32_t& w : words) w = static_cast<std::uint32_t>(engine_());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace halfway::vectors
