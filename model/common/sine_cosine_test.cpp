// SPDX-License-Identifier: Apache-2.0
#include "common/sine_cosine.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <cmath>
#include <numbers>
#include <random>

namespace halfway {
namespace {

// The nearest doubles, by MPFR.
SineCosine by_mpfr(double radians) {
  mpfr_t angle, sine, cosine;
  mpfr_inits2(53, angle, sine, cosine, nullptr);
  mpfr_set_d(angle, radians, MPFR_RNDN);
  mpfr_sin(sine, angle, MPFR_RNDN);
  mpfr_cos(cosine, angle, MPFR_RNDN);
  const SineCosine result{mpfr_get_d(sine, MPFR_RNDN), mpfr_get_d(cosine, MPFR_RNDN)};
  mpfr_clears(angle, sine, cosine, nullptr);
  return result;
}

void expect_nearest(double radians) {
  const SineCosine nearest = by_mpfr(radians), found = sine_cosine(radians);
  EXPECT_EQ(found.sine, nearest.sine) << radians;
  EXPECT_EQ(found.cosine, nearest.cosine) << radians;
}

TEST(SineCosine, AreTheNearestDoubles) {
  for (int parts = 1; parts <= 200; ++parts)
    for (int i = 0; i <= 2 * parts; ++i) expect_nearest(std::numbers::pi * i / parts);
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i)
    expect_nearest(std::uniform_real_distribution<double>(-65536.0, 65536.0)(random));
  for (int exponent = -300; exponent < 16; ++exponent)
    expect_nearest(std::ldexp(std::uniform_real_distribution<double>(-1.0, 1.0)(random), exponent));
  expect_nearest(0.0);
}

}  // namespace
}  // namespace halfway
