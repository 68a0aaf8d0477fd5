// SPDX-License-Identifier: Apache-2.0
// Errors of 1/sqrt, unit vectors and cosines compared with long double. The bounds are those stated in the
// headers.
#include "golden/unit_vector.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace halfway::golden {
namespace {

// Smallest and largest relative error.
struct Range {
  long double low = 0, high = 0;
  void add(long double error) {
    low = std::min(low, error);
    high = std::max(high, error);
  }
};

template <class Preset>
long double root_error(std::uint32_t x) {
  const long double root =
      std::ldexp(static_cast<long double>(ReciprocalRoot<Preset>::root(x)), -Preset::c_root_fraction_bits);
  return root * std::sqrt(std::ldexp(static_cast<long double>(x), -Preset::c_square_fraction_bits)) - 1;
}

long double power_of_two(double exponent) {
  return std::exp2(static_cast<long double>(exponent));
}

TEST(ReciprocalRoot, TheErrorOfPresetExactOverTheWholeRange) {
  // x is truncated to 22 fraction bits: the largest error is at one end of each interval with equal truncated
  // x.
  constexpr int c_cut = Exact::c_square_fraction_bits - 22;
  Range range;
  for (std::uint32_t cut = 1U << 22; cut < 4U << 22; ++cut) {
    range.add(root_error<Exact>(cut << c_cut));
    range.add(root_error<Exact>((cut << c_cut) + (1U << c_cut) - 1));
  }
  EXPECT_GT(range.low, -power_of_two(-19.7));
  EXPECT_LT(range.high, power_of_two(-19.7));
  EXPECT_LT(range.low, -power_of_two(-19.9));
  EXPECT_GT(range.high, power_of_two(-19.9));
}

TEST(ReciprocalRoot, TheErrorOfPresetPublishedOverTheWholeRange) {
  Range range;
  constexpr std::uint32_t c_one = 1U << Published::c_square_fraction_bits;
  for (std::uint32_t x = c_one; x < 4 * c_one; ++x) range.add(root_error<Published>(x));
  EXPECT_GT(range.low, -power_of_two(-6.89));
  EXPECT_LT(range.high, power_of_two(-6.89));
  EXPECT_LT(range.low, -power_of_two(-6.95));
}

TEST(ReciprocalRoot, BelowOneItIsTwiceTheRootOfFourTimesTheSquare) {
  EXPECT_EQ(ReciprocalRoot<Exact>::reciprocal(1U << 27), 2 * ReciprocalRoot<Exact>::root(1U << 29));
  EXPECT_EQ(ReciprocalRoot<Exact>::reciprocal(1U << 28), ReciprocalRoot<Exact>::root(1U << 28));
  EXPECT_EQ(ReciprocalRoot<Exact>::reciprocal((1U << 28) - 1),
            2 * ReciprocalRoot<Exact>::root((4U << 28) - 4));
  // The result for a zero vector has no meaning, but it must fit the width.
  EXPECT_LT(ReciprocalRoot<Exact>::reciprocal(0), 1U << ReciprocalRoot<Exact>::c_bits);
  EXPECT_LT(ReciprocalRoot<Published>::reciprocal(0), 1U << ReciprocalRoot<Published>::c_bits);
}

TEST(VectorShift, TheLargestComponentHasOneSignBit) {
  EXPECT_EQ((vector_shift<8, 8>({3, -1, 0})), (Axes{96, -32, 0}));
  EXPECT_EQ((vector_shift<8, 8>({-64, 1, 63})), (Axes{-128, 2, 126}));
  EXPECT_EQ((vector_shift<8, 8>({-65, 1, 63})), (Axes{-65, 1, 63}));
  EXPECT_EQ((vector_shift<8, 8>({-1, 0, 0})), (Axes{-128, 0, 0}));
  EXPECT_EQ((vector_shift<8, 8>({0, 0, 0})), (Axes{0, 0, 0}));
  EXPECT_EQ((vector_shift<8, 5>({3, -1, 0})), (Axes{12, -4, 0}));
  EXPECT_EQ((vector_shift<8, 5>({127, -127, 9})), (Axes{15, -16, 1}));
  EXPECT_EQ((vector_shift<5, 8>({3, -1, 0})), (Axes{96, -32, 0}));
}

struct Deviation {
  long double length_low = 0, length_high = 0, angle = 0;
};

template <class Preset, int VectorBits>
Deviation deviation() {
  std::mt19937_64 random(VectorBits);
  Deviation worst;
  for (int i = 0; i < 400'000; ++i) {
    Axes v;
    const auto smaller = static_cast<int>(random() % (VectorBits - 2));
    for (std::int64_t& component : v)
      component = static_cast<std::int64_t>(random()) >> (64 - VectorBits + smaller);
    if (v == Axes{}) continue;
    const Axes unit = normalized<Preset, VectorBits>(v);
    long double x[3], w[3], length = 0, unit_length = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      x[axis] = static_cast<long double>(v[axis]);
      w[axis] = std::ldexp(static_cast<long double>(unit[axis]), -Preset::c_direction_fraction_bits);
      length += x[axis] * x[axis];
      unit_length += w[axis] * w[axis];
    }
    length = std::sqrt(length);
    worst.length_low = std::min(worst.length_low, std::sqrt(unit_length) - 1);
    worst.length_high = std::max(worst.length_high, std::sqrt(unit_length) - 1);
    const long double cross_x = w[1] * x[2] - w[2] * x[1], cross_y = w[2] * x[0] - w[0] * x[2],
                      cross_z = w[0] * x[1] - w[1] * x[0];
    worst.angle =
        std::max(worst.angle, std::sqrt(cross_x * cross_x + cross_y * cross_y + cross_z * cross_z) / length);
  }
  return worst;
}

template <class Preset, int VectorBits>
void expect_unit(double length_bits, double angle_bits) {
  const Deviation worst = deviation<Preset, VectorBits>();
  EXPECT_GT(worst.length_low, -power_of_two(length_bits)) << VectorBits;
  EXPECT_LT(worst.length_high, power_of_two(length_bits)) << VectorBits;
  EXPECT_LT(worst.angle, power_of_two(angle_bits)) << VectorBits;
  // The errors must exceed half of the bounds: otherwise the bounds are too wide.
  EXPECT_LT(worst.length_low, -power_of_two(length_bits - 1)) << VectorBits;
  EXPECT_GT(worst.angle, power_of_two(angle_bits - 1.5)) << VectorBits;
}

TEST(UnitVector, LengthAndDirection) {
  expect_unit<Exact, Exact::c_vector_bits>(-19.5, -20.7);
  expect_unit<Exact, Exact::c_offset_bits>(-19.5, -20.7);
  expect_unit<Exact, Exact::c_direction_bits + 1>(-19.5, -20.7);
  expect_unit<Published, Published::c_vector_bits>(-6.86, -13.2);
  expect_unit<Published, Published::c_vector_bits + 1>(-6.86, -13.2);
}

}  // namespace
}  // namespace halfway::golden
