// SPDX-License-Identifier: Apache-2.0
// Pareto front of a set of points.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace halfway::study {

/// A point's costs; lower is better. All points of a front have the same number of costs. Infinity is the
/// worst value. NaN is not allowed.
using Costs = std::vector<double>;

/// True if `a` is at least as good in every cost and better in one.
bool beats(const Costs& a, const Costs& b);

/// Indices of the points that no other point beats, in ascending order. Points with equal costs are either
/// all on the front or all off it.
std::vector<std::size_t> front_of(std::span<const Costs> points);
/// The same, ordered by the first cost, then by the next ones.
std::vector<std::size_t> ordered_front_of(std::span<const Costs> points);

}  // namespace halfway::study
