// SPDX-License-Identifier: Apache-2.0
// Divides a stream of init vectors into the parts that lanes draw independently.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "golden_run/golden_run.hpp"

namespace halfway::live {

/// Vectors [first, first + vectors) of a stream: one unit (GoldenModel::unit).
struct StreamPart {
  std::uint32_t first, vectors;
};

struct StreamParts {
  std::vector<StreamPart> parts;
  std::vector<std::uint32_t> loads;  ///< vectors that change the state of the hardware (GoldenModel::is_load)
};

/// The parts and loads of whole triangles, in their order.
StreamParts parts_of(const GoldenModel& golden, std::span<const std::uint32_t> init_words);

}  // namespace halfway::live
