// SPDX-License-Identifier: Apache-2.0
// Pareto front of a set of points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace halfway::study {

/// A point's costs; lower is better. All points of a front have the same number of costs. Infinity is the
/// worst value. NaN is not allowed.
using Costs = std::vector<double>;

/// Indices of the points that no other point beats, in ascending order. A point beats another if it is at
/// least as good in every cost and better in one. Points with equal costs are either all on the front or all
/// off it.
inline std::vector<std::size_t> front_of(std::span<const Costs> points) {
  std::vector<std::size_t> front;
  for (std::size_t at = 0; at < points.size(); ++at)
    if (std::ranges::none_of(points, [&](const Costs& other) {
          return other != points[at] && std::ranges::equal(other, points[at], std::less_equal<>());
        }))
      front.push_back(at);
  return front;
}

/// The same, ordered by the first cost, then by the next ones.
inline std::vector<std::size_t> ordered_front_of(std::span<const Costs> points) {
  std::vector<std::size_t> front = front_of(points);
  std::ranges::stable_sort(front, {}, [&](std::size_t at) { return points[at]; });
  return front;
}

}  // namespace halfway::study
