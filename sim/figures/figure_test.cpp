// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <tuple>

#include "common/test/is_error.hpp"
#include "sim/figures/cut_lines.hpp"
#include "sim/figures/figure7.hpp"
#include "sim/figures/figure_pictures.hpp"
#include "sim/figures/six_point_fit.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::figures {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

using Kind = Criterion::Kind;

TEST(Figures, ACriterionHoldsUpToItsLimit) {
  const std::tuple<Criterion, double, double, const char*> cases[] = {
      {{Kind::within, 1.45, 0.005}, 1.4502, 1.4599, "± 0.005"},
      {{Kind::within, 60, 0, " ns"}, 60, 59, "exactly"},
      {{Kind::at_most, 2, 0, "/255"}, 2, 2.5, "at most 2/255"},
      {{Kind::at_least, 8}, 8, 7, "at least 8"}};
  for (const auto& [criterion, right, wrong, text] : cases) {
    EXPECT_TRUE(criterion.holds(right)) << text;
    EXPECT_FALSE(criterion.holds(wrong)) << text;
    EXPECT_FALSE(criterion.holds(NAN)) << text;
    EXPECT_EQ(criterion.text(), text);
  }
  EXPECT_EQ((Criterion{Kind::within, 1.45, 0.00005}.text()), "± 0.00005");
  EXPECT_EQ((Criterion{Kind::at_least, 1e-9}.text()), "at least 1e-09");
}

const Claim c_plain{"a", "60", {Kind::within, 60}};

std::vector<std::string> faults_of(const Claim& claim, const Measured& measured) {
  const Figure figure{"x-1", "figure 1", "a caption", "a drawing", {claim}, {}};
  return faults(std::array{Entry{figure, {}, {{claim, measured}}}});
}

TEST(Figures, AVerdictNeedsAReasonWhereItDiffersAndNoneWhereItAgrees) {
  Claim excused = c_plain;
  excused.why_not = "rounded";
  const Measured same{"60", 60}, other{"59", 59};
  EXPECT_THAT(faults_of(c_plain, same), IsEmpty());
  EXPECT_THAT(faults_of(c_plain, other), Contains(HasSubstr("differs, and no reason is known")));
  EXPECT_THAT(faults_of(excused, other), IsEmpty());
  EXPECT_EQ((Row{excused, other}.reason()), "rounded");
  EXPECT_EQ((Row{excused, same}.reason()), "");
  EXPECT_THAT(faults_of(excused, same), Contains(HasSubstr("agrees, though")));
  const Claim words{"a", "06AF"};
  EXPECT_TRUE((Row{words, {"06AF"}}.holds()));
  EXPECT_FALSE((Row{words, {"06AE"}}.holds()));
  EXPECT_THAT(faults_of(c_plain, {"", 60}), Contains(HasSubstr("a cell is empty")));
}

TEST(Figures, ARowThatHoldsByConstructionDoesNotAgree) {
  Claim made = c_plain;
  made.by_construction = "60 = 6 · 10";
  const Measured same = constructed(60, "{}"), other = constructed(59, "{}");
  EXPECT_EQ((Row{made, same}.verdict()), Verdict::by_construction);
  EXPECT_EQ((Row{made, same}.reason()), "60 = 6 · 10");
  EXPECT_THAT(faults_of(made, same), IsEmpty());
  EXPECT_EQ((Row{made, other}.verdict()), Verdict::differs);
  EXPECT_THAT(faults_of(made, other), Contains(HasSubstr("differs, and no reason is known")));
  Claim both = made;
  both.why_not = "rounded";
  EXPECT_THAT(faults_of(both, other), Contains(HasSubstr("has two of why_not, by_construction and ours")));

  const auto draw = [&](const Claim& claim, const Measured& value) {
    const Figure figure{"x-1",   "figure 1",
                        "c",     "s",
                        {claim}, [&](const Context&, Drawing& out) {
          out.measured[claim.what] = value; }};
    const auto entry = caught([&] { return drawn(figure, {}); });
    return entry ? std::string("drawn") : entry.error().message;
  };
  EXPECT_EQ(draw(made, same), "drawn");
  EXPECT_EQ(draw(c_plain, measured(60, "{}")), "drawn");
  EXPECT_THAT(draw(c_plain, same), HasSubstr("holds by construction: the claim needs the reason"));
  EXPECT_THAT(draw(made, measured(60, "{}")), HasSubstr("was measured: remove by_construction"));
  const std::vector<Entry> entries{{{"spherical-1", "figure 1", "c", "s", {made}, {}}, {}, {{made, same}}}};
  EXPECT_THAT(to_json(entries), HasSubstr("\"verdict\": \"by construction\""));
  EXPECT_THAT(to_page(entries, c_source_folder),
              AllOf(HasSubstr(": 0 agree, 0 differ, 1 hold by construction, 0 are ours."),
                    HasSubstr("| by construction (exactly): 60 = 6 · 10 |")));
}

TEST(Figures, ARowOfOursDoesNotAgreeAndKeepsItsLimit) {
  Claim limited = c_plain;
  limited.ours = "our method";
  const Measured same{"60", 60}, other{"59", 59};
  EXPECT_EQ((Row{limited, same}.verdict()), Verdict::ours);
  EXPECT_EQ((Row{limited, same}.reason()), "our method");
  EXPECT_THAT(faults_of(limited, same), IsEmpty());
  EXPECT_THAT(faults_of(limited, other), Contains(HasSubstr("differs, and no reason is known")));
  const Claim open{.what = "a", .published = "–", .ours = "a time"};
  EXPECT_EQ((Row{open, other}.verdict()), Verdict::ours);
  EXPECT_EQ(open.limit(), "no limit");
  EXPECT_THAT(faults_of(open, other), IsEmpty());
  Claim both = limited;
  both.by_construction = "6 · 10";
  EXPECT_THAT(faults_of(both, same), Contains(HasSubstr("has two of why_not, by_construction and ours")));
  const std::vector<Entry> entries{{{"spherical-1", "figure 1", "c", "s", {open}, {}}, {}, {{open, other}}}};
  EXPECT_THAT(to_page(entries, c_source_folder), HasSubstr("| a | – | 59 | ours (no limit): a time |"));
}

TEST(Figures, AClaimsFileIsReadStrictly) {
  const std::string head =
      "[[figure]]\nid = \"x-1\"\nnumber = \"figure 1\"\ncaption = \"c\"\nshows = \"s\"\n";
  const auto read = [&](const std::string& claim) {
    return caught(
        [&] { return read_figures(head + "claims = [\n" + claim + "]\n", "c.toml", {{"x-1", {}}}); });
  };
  const std::string names = "{ what = \"a\", published = \"b\"";
  const auto good = read(names + ", at_most = 2, unit = \"/255\", slow = true, why_not = \"so\" },\n" +
                         names + ", fails_for = { measured = \"c\", as = \"a slip\" } },\n");
  ASSERT_TRUE(good) << good.error().message;
  const Claim& claim = good->front().claims.front();
  EXPECT_EQ(claim.criterion.text(), "at most 2/255");
  EXPECT_EQ(claim.why_not, "so");
  EXPECT_TRUE(claim.slow);
  EXPECT_EQ(good->front().claims.back().criterion.text(), "the same");
  EXPECT_EQ(good->front().claims.back().fails_for->text, "c");
  EXPECT_EQ(good->front().paper(), "x");
  const std::pair<std::string, const char*> faults[] = {
      {"{ what = \"a\" }", "c.toml:7: 'published' is missing"},
      {"\n" + names + ", atmost = 2 }", "c.toml:8: unknown key 'atmost'"},
      {names + ", slow = \"yes\" }", "c.toml:7: 'slow' has another type"},
      {names + ", value = 1, at_least = 1 }", "c.toml:7: takes one of value, at_most and at_least"},
      {names + ", at_most = 1, fails_for = { measured = \"c\", as = \"a slip\" } }",
       "c.toml:7: 'measured' has another type"},
      {names + ", fails_for = { measured = \"c\" } }", "c.toml:7: 'as' is missing"},
      {names, "c.toml:7: "}};
  for (const auto& [claim_text, message] : faults) EXPECT_TRUE(is_error(read(claim_text), message));
  const std::string text = head + "claims = []\n";
  EXPECT_THROW(read_figures(text, "c.toml", {}), Failure);
  EXPECT_THROW(read_figures(text, "c.toml", {{"x-1", {}}, {"x-2", {}}}), Failure);
}

// All figures and claims that the papers print and the project reproduces. The value of a plausible fault
// turns each row that agrees into one that differs.
TEST(Figures, HaveAllFiguresAndClaims) {
  std::set<std::string> ids;
  for (const Figure& f : all_figures(c_source_folder)) {
    EXPECT_TRUE(ids.insert(f.id).second) << f.id;
    EXPECT_FALSE(f.claims.empty()) << f.id;
    std::set<std::string> names;
    for (const Claim& c : f.claims) {
      SCOPED_TRACE(f.id + ": " + c.what);
      EXPECT_TRUE(names.insert(c.what).second);
      const bool agrees = c.why_not.empty() && c.by_construction.empty() && c.ours.empty();
      ASSERT_EQ(c.fails_for.has_value(), agrees);
      if (agrees) {
        EXPECT_EQ((Row{c, *c.fails_for}.verdict()), Verdict::differs);
      }
    }
  }
  for (const char* id : {"spherical-05", "spherical-09", "spherical-10", "spherical-table-1", "spherical-11",
                         "spherical-14", "spherical-15", "spherical-16", "spherical-17", "quadratic-07",
                         "quadratic-08", "quadratic-09", "quadratic-10", "quadratic-11", "quadratic-times",
                         "processors-table-3", "processors-table-4", "processors-table-5"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

// The claims print the words of the trace, restored ones in brackets.
TEST(Figures, Figure7PublishesTheWordsOfTheTrace) {
  const auto trace = read_figure7(c_source_folder / "tb/specification/paper/figure7.txt");
  int registers = 0;
  for (const Figure& figure : all_figures(c_source_folder))
    for (const Claim& claim : figure.claims) {
      const std::string name = (claim.what.starts_with("Δ") ? "d" : "") +
                               claim.what.substr(claim.what.starts_with("Δ") ? std::string("Δ").size() : 0);
      if (figure.id != "quadratic-07" || !trace.restored.contains(name)) continue;
      EXPECT_EQ(claim.published, trace.published(name));
      ++registers;
    }
  EXPECT_EQ(registers, 5);
}

using FiguresOnPage = FolderTest;

TEST_F(FiguresOnPage, AreDrawnWithTheirPicturesAndWithoutSlowRowsIfQuick) {
  Context context{.out = here()};
  Figure figure{"quadratic-1",
                "figure 1",
                "a caption",
                "a drawing",
                {{"quick", "60", {Kind::within, 60}}, {.what = "slow", .published = "1", .slow = true}},
                [](const Context& with, Drawing& out) {
                  out.measured["quick"] = measured(60, "{}");
                  if (!with.quick) out.measured["slow"] = {"2"};
                  save_picture(with, "x-1", Frame({4, 4}), "black", out);
                }};
  const std::vector<Entry> whole{drawn(figure, context)};
  EXPECT_TRUE(std::filesystem::exists(at("x-1.png")));
  EXPECT_THAT(to_json(whole), HasSubstr("\"value\": null"));
  const std::string page = to_page(whole, c_source_folder);
  EXPECT_THAT(page, HasSubstr("| slow | 1 | 2 | **differs** (the same) |"));
  EXPECT_THAT(page, HasSubstr("![black](x-1.png)"));

  context.quick = true;
  const auto fault = [&] { return caught([&] { return drawn(figure, context); }); };
  ASSERT_TRUE(fault());
  EXPECT_EQ(fault()->rows.size(), 1U);
  figure.claims.push_back({"forgotten", "1", {Kind::within, 1}});
  EXPECT_TRUE(is_error(fault(), "nothing was measured for 'forgotten'"));
  figure.claims = {};
  EXPECT_TRUE(is_error(fault(), "'quick' was measured, which no claim names"));
  figure.draw = [](const Context&, Drawing&) { must(Status(tool_failed("broke"))); };
  EXPECT_TRUE(is_error(fault(), "broke"));
}

TEST(SixPointFit, GoesThroughTheSixPointsByOneDivision) {
  constexpr double c_x2 = 7.0, c_y2 = 0.0, c_x3 = 2.0,
                   c_y3 = 6.0;  // the published formula divides by zero here
  constexpr std::array c_values{0.1, 0.4, 0.3, 0.9, 0.5, 0.7};
  constexpr std::array<std::pair<double, double>, 6> c_points{
      {{0, 0}, {c_x2, c_y2}, {c_x3, c_y3}, {3.5, 0}, {1, 3}, {4.5, 3}}};
  const auto fit = fit_six_points(c_x2, c_y2, c_x3, c_y3, c_values);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_NEAR(fit.at(c_points[i].first, c_points[i].second), c_values[i], 1e-14) << i;

  const auto printed = fit_six_points_as_printed(c_x2, 1.0, c_x3, c_y3, c_values),
             ours = fit_six_points(c_x2, 1.0, c_x3, c_y3, c_values);
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {7.0, 1.0}, {2.0, 6.0}, {3.5, 0.5}, {1.0, 3.0}, {1.3, 2.2}})
    EXPECT_NEAR(printed.at(x, y), ours.at(x, y), 1e-13) << x << ", " << y;

  OperationCounts counts;
  const auto counted = [&](double v) { return CountedNumber(v, counts); };
  EXPECT_EQ((2.0 * counted(3.0) - counted(1.0) * (counted(1.0) + counted(4.0))).value(), 1.0);
  EXPECT_EQ((1.0 / counted(4.0)).value(), 0.25);
  EXPECT_EQ(counts.additions, 2);
  EXPECT_EQ(counts.multiplications, 2);
  EXPECT_EQ(counts.divisions, 1);
}

// The same picture and the same vectors where no highlight leaves its bell; where the register would wrap,
// more records and no ghost highlight.
TEST(CutLines, AreCutOnlyWhereABellEnds) {
  constexpr FrameSize c_size{160, 120};
  const Context golden{.quick = true};
  const PlanRequest plan{.shader = Shader::spherical, .preset = Preset::published};
  Scene scene = sphere_scene(17, 12, 20.0);
  const ReferenceImage phong = draw_in_software(scene, c_size, 1).phong;
  const Hardware wrapping = draw_in_hardware(golden, scene, c_size, plan);
  const CutLines cut = draw_with_cut_lines(scene, c_size);
  EXPECT_GT(cut.vectors, wrapping.counts.vectors);
  EXPECT_GT(cut.records, wrapping.counts.records);
  EXPECT_LT(cut.records, 2 * wrapping.counts.records);
  const double ghosts_db = distance(wrapping.frame, phong.frame, phong.mask).psnr_db;
  EXPECT_GT(distance(cut.frame, phong.frame, phong.mask).psnr_db, ghosts_db + 6.0);

  scene.materials[0].specular = 0.0;
  const Hardware matte = draw_in_hardware(golden, scene, c_size, plan);
  const CutLines same = draw_with_cut_lines(scene, c_size);
  EXPECT_EQ(same.frame.rgb, matte.frame.rgb);
  EXPECT_EQ(same.vectors, matte.counts.vectors);
  EXPECT_EQ(same.records, matte.counts.records);
}

TEST(Sheet, PicturesAreInColumnsOnWhite) {
  Frame a({2, 1}), b({2, 1});
  a.rgb = {1, 2, 3, 4, 5, 6};
  b.rgb = {7, 8, 9, 10, 11, 12};
  const Frame whole = sheet(std::array{a, b, a}, 2);
  EXPECT_EQ(whole.size, (FrameSize{8, 6}));
  for (const auto& [x, y, red] :
       {std::tuple{0U, 0U, 1}, {1U, 0U, 4}, {2U, 0U, 255}, {6U, 0U, 7}, {7U, 0U, 10}, {0U, 5U, 1}})
    EXPECT_EQ(int{whole.rgb[whole.offset(x, y)]}, red) << x << ", " << y;
}

}  // namespace
}  // namespace halfway::figures
