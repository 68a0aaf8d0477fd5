// SPDX-License-Identifier: Apache-2.0
// Which points are worth building: those that no other beats.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace halfway::study {

/// A point's figures, the less the better; all points of one front have as many. Infinity is worse than any
/// number, and NaN is none of them.
using Costs = std::vector<double>;

/// As good in every figure, and better in one.
bool beats(const Costs& a, const Costs& b);

/// Numbers of the points that no other beats, in the points' order. Points with equal costs stand together,
/// on the front or off it.
std::vector<std::size_t> front_of(std::span<const Costs> points);

}  // namespace halfway::study
