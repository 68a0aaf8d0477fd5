// SPDX-License-Identifier: Apache-2.0
#include "sim/study/front.hpp"

#include <algorithm>
#include <functional>

namespace halfway::study {

bool beats(const Costs& a, const Costs& b) {
  return a != b && std::ranges::equal(a, b, std::less_equal<>());
}

std::vector<std::size_t> front_of(std::span<const Costs> points) {
  std::vector<std::size_t> front;
  for (std::size_t at = 0; at < points.size(); ++at)
    if (std::ranges::none_of(points, [&](const Costs& other) { return beats(other, points[at]); }))
      front.push_back(at);
  return front;
}

std::vector<std::size_t> ordered_front_of(std::span<const Costs> points) {
  std::vector<std::size_t> front = front_of(points);
  std::ranges::stable_sort(front, {}, [&](std::size_t at) { return points[at]; });
  return front;
}

}  // namespace halfway::study
