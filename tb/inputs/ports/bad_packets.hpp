// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace halfway {

/// The start of a good frame that only ends too early, or in which random bits are inverted, or whose words
/// but for the headers are random, or random words.
inline std::vector<std::uint32_t> bad_packets(const std::vector<std::uint32_t>& good,
                                              std::mt19937_64& engine) {
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  const std::uint32_t kind = random() % 4;
  const std::size_t most = kind < 2 ? 2000 : 200, count = 1 + random() % std::min(most, good.size());
  std::vector<std::uint32_t> words(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::uint32_t flips = kind == 1 ? 1 + random() % 20 : 0; flips > 0; --flips)
    words[random() % words.size()] ^= 1U << random() % 32;
  for (std::size_t at = 0; kind == 2 && at < words.size();) {
    const std::size_t end = std::min(words.size(), at + (words[at] >> 16) / 2 * 2 + 2);
    while (++at < end) words[at] = random();
  }
  for (std::uint32_t& word : words)
    if (kind == 3) word = random();
  return words;
}

}  // namespace halfway
