// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/live_core/stream_parts.hpp"

#include <algorithm>
#include <cstddef>

namespace halfway::live {

StreamParts parts_of(const GoldenModel& golden, std::span<const std::uint32_t> init_words) {
  const std::size_t vector_words = (golden.init_bits() + 31) / 32;
  StreamParts found;
  for (std::uint32_t first = 0; !init_words.empty();) {
    const std::size_t vectors =
        std::clamp<std::size_t>(golden.group(init_words), 1, init_words.size() / vector_words);
    const auto count = static_cast<std::uint32_t>(vectors);
    if (golden.is_load(init_words))
      found.loads.push_back(first);
    else
      found.parts.push_back({first, count});
    first += count;
    init_words = init_words.subspan(vectors * vector_words);
  }
  return found;
}

}  // namespace halfway::live
