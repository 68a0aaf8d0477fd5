// SPDX-License-Identifier: Apache-2.0
// Tests of the parts that hard cases and searches use: the shrinker, its files, the verdict on figures, the
// specification's spans.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "setup/test/random_triangles.hpp"
#include "stability/shrink.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {
namespace {

constexpr Parameter c_abcd[] = {
    {"a", 0, -1000, 1000}, {"b", 0, -1000, 1000}, {"c", 1, 1, 4096}, {"d", 0, 0, 9}};

TEST(Shrink, FindsTheSmallestInputThatFails) {
  // The least failing input: a = 37, b = -5, c = 12, d at its simplest.
  const auto fails = [](const Input& i) { return i[0] >= 37 && i[1] <= -5 && i[2] * 3 > 33 + i[3]; };
  for (const Input& from : {Input{999, -1000, 4096, 9}, Input{37, -1000, 13, 0}, Input{512, -5, 100, 7}}) {
    ASSERT_TRUE(fails(from));
    EXPECT_EQ(shrink(c_abcd, from, fails, {}), (Input{37, -5, 12, 0}));
  }
}

TEST(Shrink, PrefersWholeGrains) {
  constexpr Parameter c_grained[] = {{"a", 0, -1000, 1000, 16}, {"b", 3, 0, 1000, 10}, {"c", 0, 0, 1000, 16}};
  // The nearest grain if it fails; the least failing value if no grain fails.
  const auto fails = [](const Input& i) { return i[0] <= -37 && i[1] > 25 && i[2] % 16 == 5; };
  EXPECT_EQ(shrink(c_grained,
                   {
                       -999,
                       888,
                       501,
                   },
                   fails, {}),
            (Input{-48, 33, 5}));
}

TEST(Shrink, PrefersFewAndShortParameters) {
  // Either parameter may be reduced; rounding is tried before small steps.
  const auto fails = [](const Input& i) { return i[0] + i[1] >= 100; };
  const Input shrunk = shrink(c_abcd, {90, 80, 50, 3}, fails, {});
  EXPECT_EQ(shrunk, (Input{20, 80, 1, 0}));
}

TEST(Shrink, TakesStepsOfSeveralParametersWhereTheyAreOffered) {
  // No single parameter can change: a and b differ by 10.
  const auto fails = [](const Input& i) { return i[0] - i[1] == 10; };
  EXPECT_EQ(shrink(c_abcd, {510, 500, 1, 0}, fails, {}), (Input{510, 500, 1, 0}));
  const auto together = [](const Input& i) {
    return std::vector<Input>{{i[0] - i[1], 0, i[2], i[3]}, {i[0] / 2, i[1] / 2, i[2], i[3]}};
  };
  EXPECT_EQ(shrink(c_abcd, {510, 500, 1, 0}, fails, together), (Input{10, 0, 1, 0}));
}

TEST(Shrink, NeverLeavesTheRangesAndNeverPasses) {
  const auto fails = [](const Input& i) {
    for (std::size_t n = 0; n < i.size(); ++n)
      if (i[n] < c_abcd[n].least || i[n] > c_abcd[n].greatest) ADD_FAILURE() << "out of range";
    return i[2] % 7 == 3;
  };
  const auto wild = [](const Input& i) {
    return std::vector<Input>{{i[0] - 2000, i[1], i[2], i[3]}, {i[0], i[1], 0, i[3]}};
  };
  const Input shrunk = shrink(c_abcd, {-700, 3, 3503, 2}, fails, wild);
  EXPECT_EQ(shrunk[2] % 7, 3);
  EXPECT_EQ(shrunk[0], 0);
}

TEST(Shrink, StopsWhenItMayTryNoMore) {
  int tries = 0;
  const auto fails = [&](const Input& i) { return ++tries, i[0] >= 37; };
  shrink(c_abcd, {1000, -1000, 4096, 9}, fails, {}, {.most_tries = 3});
  EXPECT_EQ(tries, 3);
}

Result<Regression> read(std::string_view text) {
  return read_regression("f.txt", text, [](std::string_view name) {
    return name == "things" ? std::span<const Parameter>(c_abcd) : std::span<const Parameter>();
  });
}

TEST(Regression, ComesBackAsItWasWritten) {
  const Input input = {-1000, 0, 77, 9};
  const std::string text = write_regression("things", c_abcd, input, "why\nand how");
  EXPECT_EQ(text, "# why\n# and how\nsearch things\na -1000\nc 77\nd 9\n");
  const auto back = read(text);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->search, "things");
  EXPECT_EQ(back->input, input);
}

TEST(Regression, SaysWhatIsWrongAndWhere) {
  for (const auto& [text, message] : std::initializer_list<std::pair<std::string_view, std::string_view>>{
           {"", "f.txt: names no search"},
           {"# only this\n", "f.txt: names no search"},
           {"a 1\n", "f.txt:1: a 1: the file must start with `search` and its name"},
           {"search others\n", "f.txt:1: search others: there is no such search"},
           {"search things\n\nx 1\n", "f.txt:3: x 1: there is no such parameter"},
           {"search things\na 1x\n", "f.txt:2: a 1x: not an integer"},
           {"search things\na", "f.txt:2: a: not an integer"},
           {"search things\nc 0\n", "f.txt:2: c 0: not from 1 to 4096"}}) {
    const auto result = read(text);
    ASSERT_FALSE(result) << text;
    EXPECT_EQ(result.error().message, message);
  }
}

Worst worst_of(std::initializer_list<double> figures) {
  Worst worst;
  for (const double figure : figures) worst.add(figure, 1.0, [] { return "x"; });
  return worst;
}

TEST(Refutation, ComesFromOurFiguresAlone) {
  EXPECT_EQ(refutation(PublishedForm::silent, worst_of({0.5, 1.0}), {}), "");
  EXPECT_EQ(refutation(PublishedForm::silent, {}, {}), "has no figure");
  EXPECT_EQ(refutation(PublishedForm::silent, worst_of({0.5, 1.5, 1.0}), {}), "1.5 of 1 at x");
  EXPECT_EQ(refutation(PublishedForm::silent, worst_of({NAN, 0.5}), {}), "nan of 1 at x");
  EXPECT_EQ(refutation(PublishedForm::breaks, worst_of({2.0}), worst_of({2.0})), "2 of 1 at x");
}

TEST(Refutation, ComesFromPublishedFiguresThatAreNotAsExpected) {
  const Worst ours = worst_of({1.0}), within = worst_of({1.0}), beyond = worst_of({0.0, INFINITY});
  EXPECT_EQ(refutation(PublishedForm::breaks, ours, beyond), "");
  EXPECT_EQ(refutation(PublishedForm::breaks, ours, within),
            "the published form does not break: 1 of 1 at x");
  EXPECT_EQ(refutation(PublishedForm::holds, ours, within), "");
  EXPECT_EQ(refutation(PublishedForm::holds, ours, beyond), "the published form breaks: inf of 1 at x");
  for (const PublishedForm expected : {PublishedForm::breaks, PublishedForm::holds})
    EXPECT_EQ(refutation(expected, ours, {}), "has no figure of the published form");
  EXPECT_EQ(refutation(PublishedForm::silent, ours, within),
            "has a figure of the published form, but is listed without one");
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
