// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/word_trace.hpp"

#include <utility>

namespace halfway {

WordTrace::WordTrace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words)
    : words_(std::move(words)) {
  for (const TracedPart& part : parts) {
    places_[part.path].push_back({part.low, part.bits, words_per_edge_});
    words_per_edge_ += static_cast<std::size_t>(part.bits + 31) / 32;
  }
}

std::optional<std::uint64_t> WordTrace::part(const std::string& path, std::size_t edge, int low,
                                             int bits) const {
  const auto places = places_.find(path);
  if (places == places_.end() || edge >= edges()) return std::nullopt;
  for (const Place& place : places->second) {
    if (low < place.low || low + bits > place.low + place.bits) continue;
    const std::uint32_t* const words = &words_[edge * words_per_edge_ + place.word];
    std::uint64_t word = 0;
    for (int i = low - place.low + bits - 1; i >= low - place.low; --i)
      word = word << 1 | (words[i / 32] >> (i % 32) & 1);
    return word;
  }
  return std::nullopt;
}

}  // namespace halfway
