// SPDX-License-Identifier: Apache-2.0
// Two's-complement words of a given width, and flat vectors of such words.
#pragma once

#include <cstdint>
#include <span>

#include "words/formats.hpp"

namespace halfway::words {

/// The lowest `bits` bits, 1 to 64.
constexpr std::uint64_t low_bits(std::uint64_t value, int bits) {
  return bits >= 64 ? value : value & ((std::uint64_t{1} << bits) - 1);
}

/// A signed word of W bits. Sums wrap modulo 2^W. It is stored in the upper bits of 64 bits, where the
/// machine's sum wraps in the same way.
template <int W>
class Word {
  static_assert(W >= 1 && W <= 64);

 public:
  constexpr Word() = default;
  static constexpr Word from_bits(std::uint64_t bits) {
    Word word;
    word.aligned_ = bits << (64 - W);
    return word;
  }
  constexpr std::uint64_t bits() const { return aligned_ >> (64 - W); }
  constexpr std::int64_t value() const { return static_cast<std::int64_t>(aligned_) >> (64 - W); }
  constexpr Word& operator+=(Word other) {
    aligned_ += other.aligned_;
    return *this;
  }
  friend constexpr Word operator+(Word a, Word b) { return a += b; }
  friend constexpr bool operator==(Word, Word) = default;

 private:
  std::uint64_t aligned_ = 0;
};

/// Reads field `field` of the block that starts at bit `block_low` of a flat vector, bit 0 of words[0] first.
constexpr std::uint64_t get_bits(std::span<const std::uint32_t> words, const Field& field,
                                 int block_low = 0) {
  const int low = block_low + field.low;
  const std::size_t first = static_cast<std::size_t>(low) / 32;
  const int shift = low % 32;
  std::uint64_t value = words[first] >> shift;
  for (int have = 32 - shift, i = 1; have < field.bits; have += 32, ++i)
    value |= std::uint64_t{words[first + static_cast<std::size_t>(i)]} << have;
  return low_bits(value, field.bits);
}

/// Inverts the bits of a field where `ones` has ones.
constexpr void invert_bits(std::span<std::uint32_t> words, const Field& field, std::uint64_t ones,
                           int block_low = 0) {
  const std::uint64_t bits = low_bits(ones, field.bits);
  const auto low = static_cast<unsigned>(block_low + field.low);
  const int shift = static_cast<int>(low % 32);
  auto word = words.begin() + low / 32;
  *word ^= static_cast<std::uint32_t>(bits << shift);
  for (int done = 32 - shift; done < field.bits; done += 32)
    *++word ^= static_cast<std::uint32_t>(bits >> done);
}

/// Writes a field.
constexpr void set_bits(std::span<std::uint32_t> words, const Field& field, std::uint64_t value,
                        int block_low = 0) {
  invert_bits(words, field, get_bits(words, field, block_low) ^ value, block_low);
}

}  // namespace halfway::words
