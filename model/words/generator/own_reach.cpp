// SPDX-License-Identifier: Apache-2.0
// Apart from the other tables, because a browser runs it.
#include <cmath>

#include "words/generator/cosine.hpp"

namespace halfway::tables {

double own_reach(double exponent) {
  // cos x = c_own_end^(1/exponent), by 1 - cos x = 2 sin^2(x/2) without cancellation.
  return 2.0 * std::asin(std::sqrt(-std::expm1(std::log(c_own_end) / exponent) / 2.0));
}

}  // namespace halfway::tables
