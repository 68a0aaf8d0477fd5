// SPDX-License-Identifier: Apache-2.0
// Tests of the parts that hard cases and searches use: the verdict on figures, the specification's spans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "setup/test/random_triangles.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {
namespace {

Worst worst_of(std::initializer_list<double> figures) {
  Worst worst;
  for (const double figure : figures) worst.add(figure, 1.0, [] { return "x"; });
  return worst;
}

TEST(Refutation, ComesFromOurFiguresAlone) {
  EXPECT_EQ(refutation(true, worst_of({0.5, 1.0}), {}), "");
  EXPECT_EQ(refutation(true, {}, {}), "has no figure");
  EXPECT_EQ(refutation(true, worst_of({0.5, 1.5, 1.0}), {}), "1.5 of 1 at x");
  EXPECT_EQ(refutation(true, worst_of({NAN, 0.5}), {}), "nan of 1 at x");
  EXPECT_EQ(refutation(false, worst_of({2.0}), worst_of({2.0})), "2 of 1 at x");
}

TEST(Refutation, ComesFromPublishedFiguresThatAreNotAsExpected) {
  const Worst ours = worst_of({1.0}), within = worst_of({1.0}), beyond = worst_of({0.0, INFINITY});
  EXPECT_EQ(refutation(false, ours, beyond), "");
  EXPECT_EQ(refutation(false, ours, within), "the published form does not break: 1 of 1 at x");
  EXPECT_EQ(refutation(false, ours, {}), "has no figure of the published form");
  EXPECT_EQ(refutation(true, ours, within), "has a figure of the published form, but is listed without one");
}

TEST(Trial, KeepsWellConditionedFiguresApart) {
  Simulators simulators;
  Trial trial(SimulatorFolders{}, simulators, true, 1.0);
  const auto where = [] { return "x"; };
  trial.ours(0.5, 1.0, where);
  trial.ours(9.0, 10.0, where);
  trial.published(0.7, 0.8, where);
  EXPECT_EQ(trial.ours().count, 2U);
  EXPECT_EQ(trial.ours().figure, 9.0);
  EXPECT_EQ(trial.well_conditioned().count, 1U);
  EXPECT_EQ(trial.well_conditioned().figure, 0.5);
}

// The spans are equal to the definition, pixel by pixel.
TEST(Specification, SpansHoldThePixelsThatAreCovered) {
  std::size_t pixels = 0;
  for (const TriangleKind kind : c_triangle_kinds) {
    RandomTriangles random(static_cast<unsigned>(kind) + 40);
    for (int i = 0; i < 300; ++i) {
      const FrameSize frame{static_cast<std::uint32_t>(random.within(1, 24)),
                            static_cast<std::uint32_t>(random.within(1, 24))};
      const int level = random.within(0, 5);
      const Points p = random.next(kind, 4 + level, frame, level);
      std::set<std::tuple<std::int64_t, std::int64_t>> expected, spanned;
      for (std::int64_t y = 0; y < frame.height; ++y)
        for (std::int64_t x = 0; x < frame.width; ++x)
          if (covers(p, 4 + level, x, y)) expected.emplace(x, y);
      for_each_covered(p, 4 + level, frame,
                       [&](std::int64_t x, std::int64_t y) { EXPECT_TRUE(spanned.emplace(x, y).second); });
      ASSERT_EQ(spanned, expected);
      pixels += expected.size();
    }
  }
  EXPECT_GT(pixels, 20'000u);
}

}  // namespace
}  // namespace halfway::stability
