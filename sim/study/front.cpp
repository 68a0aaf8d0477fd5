// SPDX-License-Identifier: Apache-2.0
#include "sim/study/front.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace halfway::study {

bool beats(const Costs& a, const Costs& b) {
  return a != b && std::ranges::equal(a, b, std::less_equal<>());
}

std::vector<std::size_t> front_of(std::span<const Costs> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What beats a point comes before it in the dictionary's order, and if that is beaten, so is the point by
  // one on the front: so each is held against the front alone.
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return points[a] < points[b]; });
  std::vector<std::size_t> front;
  for (const std::size_t at : order)
    if (std::ranges::none_of(front, [&](std::size_t other) { return beats(points[other], points[at]); }))
      front.push_back(at);
  std::ranges::sort(front);
  return front;
}

Status check_front(std::span<const Costs> points, std::span<const std::size_t> front) {
  std::vector<bool> on_front(points.size());
  for (const std::size_t at : front) on_front.at(at) = true;
  for (std::size_t at = 0; at < points.size(); ++at) {
    const auto beaten_by = [&](const auto& candidates) {
      const auto found = std::ranges::find_if(
          candidates, [&](std::size_t other) { return beats(points[other], points[at]); });
      return found != candidates.end();
    };
    if (on_front[at]) {
      std::vector<std::size_t> all(points.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      if (beaten_by(all))
        return Error{ExitCode::differs, fmt::format("point {} is on the front and is beaten", at)};
    } else if (!beaten_by(front)) {
      return Error{ExitCode::differs,
                   fmt::format("point {} is off the front, and no point on it beats it", at)};
    }
  }
  return Ok{};
}

}  // namespace halfway::study
