// SPDX-License-Identifier: Apache-2.0
// Encloses real functions at rational arguments between two doubles, by MPFR with outward rounding.
#pragma once

#include <mpfr.h>

#include <algorithm>
#include <cmath>

namespace halfway::bounds {

/// A real number that lies in [low, high].
struct Enclosure {
  double low, high;
};

/// The greatest distance of the number from `value`, rounded up.
inline double farthest(double value, Enclosure e) {
  const double away = std::max(std::fabs(value - e.low), std::fabs(value - e.high));
  return std::nextafter(away, HUGE_VAL);
}

class Real {
 public:
  Real() { mpfr_init2(value_, 96); }
  ~Real() { mpfr_clear(value_); }
  Real(const Real&) = delete;
  Real& operator=(const Real&) = delete;
  operator mpfr_ptr() { return value_; }

 private:
  mpfr_t value_;
};

/// number / 2^shift, exact.
struct Dyadic {
  long number;
  int shift;
};

/// cos(pi/2 * x)^power for x in [0, 1]. Decreases with x.
inline Enclosure cosine_power(Dyadic x, int power) {
  const auto one_side = [&](mpfr_rnd_t outward, mpfr_rnd_t inward) {
    Real v;
    mpfr_const_pi(v, inward);  // a larger angle has a smaller cosine
    mpfr_mul_si(v, v, x.number, inward);
    mpfr_div_2si(v, v, x.shift + 1, inward);
    mpfr_cos(v, v, outward);
    if (mpfr_sgn(static_cast<mpfr_ptr>(v)) < 0) mpfr_set_zero(v, 1);
    mpfr_pow_ui(v, v, static_cast<unsigned long>(power), outward);
    return mpfr_get_d(v, outward);
  };
  return {one_side(MPFR_RNDD, MPFR_RNDU), one_side(MPFR_RNDU, MPFR_RNDD)};
}

/// cos(reach * x)^exponent for x in [0, 1], reach < pi/2, exponent >= 1. Decreases with x.
inline Enclosure highlight(Dyadic x, double reach, double exponent) {
  const auto one_side = [&](mpfr_rnd_t outward, mpfr_rnd_t inward) {
    Real v, power;
    mpfr_set_d(v, reach, inward);  // exact; a larger angle has a smaller cosine
    mpfr_mul_si(v, v, x.number, inward);
    mpfr_div_2si(v, v, x.shift, inward);
    mpfr_cos(v, v, outward);
    mpfr_set_d(power, exponent, MPFR_RNDN);  // exact
    mpfr_pow(v, v, power, outward);
    return mpfr_get_d(v, outward);
  };
  return {one_side(MPFR_RNDD, MPFR_RNDU), one_side(MPFR_RNDU, MPFR_RNDD)};
}

/// f(x) by a function of MPFR, which rounds correctly.
template <class Function>
Enclosure enclosed(Dyadic x, Function&& f) {
  const auto one_side = [&](mpfr_rnd_t outward) {
    Real v;
    mpfr_set_si_2exp(v, x.number, -x.shift, outward);  // exact
    f(static_cast<mpfr_ptr>(v), outward);
    return mpfr_get_d(v, outward);
  };
  return {one_side(MPFR_RNDD), one_side(MPFR_RNDU)};
}
inline Enclosure reciprocal_root(Dyadic x) {
  return enclosed(x, [](mpfr_ptr v, mpfr_rnd_t r) { mpfr_rec_sqrt(v, v, r); });
}
inline Enclosure logarithm(Dyadic x) {
  return enclosed(x, [](mpfr_ptr v, mpfr_rnd_t r) { mpfr_log2(v, v, r); });
}
/// 2^-x
inline Enclosure decay(Dyadic x) {
  return enclosed({-x.number, x.shift}, [](mpfr_ptr v, mpfr_rnd_t r) { mpfr_exp2(v, v, r); });
}

}  // namespace halfway::bounds
