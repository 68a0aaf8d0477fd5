// SPDX-License-Identifier: Apache-2.0
#include "sim/pictures/perception.hpp"

#include "sim/pictures/flip.hpp"

namespace halfway {

Result<std::uint64_t> perceived_pixels(const Frame& a, const Frame& b) {
  const auto errors = flip_errors(a, b);
  if (!errors) return errors.error();
  const double threshold = flip_error_of_distance(1.0);
  std::uint64_t seen = 0;
  for (const double error : *errors) seen += error > threshold ? 1 : 0;
  return seen;
}

}  // namespace halfway
