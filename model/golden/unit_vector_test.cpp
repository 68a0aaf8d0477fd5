// SPDX-License-Identifier: Apache-2.0
// The ends of 1/sqrt and the shift of a vector. tb/specification/bounds bounds the errors of 1/sqrt and of
// unit vectors.
#include "golden/unit_vector.hpp"

#include <gtest/gtest.h>

namespace halfway::golden {
namespace {

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

}  // namespace
}  // namespace halfway::golden
