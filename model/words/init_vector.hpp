// SPDX-License-Identifier: Apache-2.0
// Builds init vectors: writes words into the fields of a flat vector.
#pragma once

#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>
#include <vector>

#include "common/exact_division.hpp"
#include "common/to_integer.hpp"
#include "words/word.hpp"

namespace halfway {

/// Appends one vector of `bits` bits, all zero, to a list of words.
class InitVector {
 public:
  InitVector(std::vector<std::uint32_t>& words, unsigned bits) {
    const std::size_t begin = words.size(), count = (bits + 31) / 32;
    words.resize(begin + count);
    words_ = std::span(words).subspan(begin, count);
  }
  /// Writes the value modulo 2^bits of a field that is not yet written, in the block that starts at bit
  /// `block_low`. The hardware's sums wrap, so a start word may wrap too.
  void put(const words::Field& field, Int128 value, int block_low = 0) {
    words::invert_bits(words_, field, static_cast<std::uint64_t>(value), block_low);
  }
  std::span<const std::uint32_t> words() const { return words_; }

 private:
  std::span<std::uint32_t> words_;
};

/// The nearest integer; a half rounds away from zero.
inline std::int64_t nearest(double value) {
  // The greatest number below 1/2: 1/2 itself would round up that number too.
  constexpr double c_below_half = 0x1.fffffffffffffp-2;
  return to_integer<std::int64_t>(value + std::copysign(c_below_half, value));
}

/// value * 2^fraction_bits, rounded.
inline std::int64_t fixed(double value, int fraction_bits) {
  return nearest(value * static_cast<double>(std::int64_t{1} << fraction_bits));
}

constexpr std::int64_t half(int fraction_bits) {
  return std::int64_t{1} << (fraction_bits - 1);
}

/// A real number as a word modulo 2^bits. Differences of a sliver may exceed the range of any integer type.
template <std::floating_point Real>
std::int64_t wrapped_word(Real value, int fraction_bits, int bits) {
  const auto modulus = static_cast<Real>(std::int64_t{1} << bits);
  const Real word = std::rint(value * static_cast<Real>(std::int64_t{1} << fraction_bits));
  return to_integer<std::int64_t>(std::abs(word) < modulus ? word : std::fmod(word, modulus));
}

/// The start of a word that adds `slope` at each step. The slope's rounding error accumulates; this start,
/// not yet rounded, makes it zero in the middle of the steps. Both words rounded, the sum is then off by at
/// most (1 + steps / 2) * u / 2.
inline double centred_start(double start, double slope, std::int64_t steps, int fraction_bits) {
  const double words = std::ldexp(slope, fraction_bits);
  return start - 0.5 * static_cast<double>(steps) * std::ldexp(std::rint(words) - words, -fraction_bits);
}

}  // namespace halfway
