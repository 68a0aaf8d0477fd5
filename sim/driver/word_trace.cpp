// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/word_trace.hpp"

#include <map>
#include <utility>

namespace halfway {
namespace {

struct Place {
  int low, bits;
  std::size_t word;
};

}  // namespace

SignalTrace word_trace(const std::set<TracedPart>& parts, std::vector<std::uint32_t> words) {
  std::map<std::string, std::vector<Place>> places;  // by path
  std::size_t per_edge = 0;
  for (const TracedPart& part : parts) {
    places[part.path].push_back({part.low, part.bits, per_edge});
    per_edge += static_cast<std::size_t>(part.bits + 31) / 32;
  }
  const std::size_t edges = per_edge == 0 ? 0 : words.size() / per_edge;
  return {edges,
          [=, words = std::move(words)](const std::string& path, std::size_t edge, int low,
                                        int bits) -> std::optional<std::uint64_t> {
            const auto found = places.find(path);
            if (found == places.end() || edge >= edges) return std::nullopt;
            for (const Place& place : found->second) {
              if (low < place.low || low + bits > place.low + place.bits) continue;
              const std::uint32_t* const from = &words[edge * per_edge + place.word];
              std::uint64_t word = 0;
              for (int i = low - place.low + bits - 1; i >= low - place.low; --i)
                word = word << 1 | (from[i / 32] >> (i % 32) & 1);
              return word;
            }
            return std::nullopt;
          }};
}

}  // namespace halfway
