// SPDX-License-Identifier: Apache-2.0
// For tests: conversions between this project's integers and GMP's, whose sums and quotients are exact.
#pragma once

#include <gmpxx.h>

#include "common/exact_division.hpp"

namespace halfway {

inline mpz_class to_mpz(Int128 v) {
  const unsigned __int128 magnitude = v < 0 ? -static_cast<unsigned __int128>(v) : v;
  mpz_class z = static_cast<unsigned long>(magnitude >> 64);
  z <<= 64;
  z += static_cast<unsigned long>(magnitude);
  return v < 0 ? mpz_class(-z) : z;
}

/// round(v), halves up: the rounding of all words in setup.
inline mpz_class rounded(const mpq_class& v) {
  const mpz_class doubled = 2 * v.get_num() + v.get_den(), divisor = 2 * v.get_den();
  mpz_class quotient;
  mpz_fdiv_q(quotient.get_mpz_t(), doubled.get_mpz_t(), divisor.get_mpz_t());
  return quotient;
}

}  // namespace halfway
