// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "sim/figures/check.hpp"
#include "sim/figures/pictures.hpp"
#include "sim/figures/plot.hpp"
#include "sim/figures/six_point_fit.hpp"
#include "sim/figures/timing_diagram.hpp"
#include "sim/system/file.hpp"

namespace halfway::figures {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path c_folder = std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim" / "figures";

TEST(Figures, ACriterionHoldsUpToItsLimit) {
  EXPECT_TRUE(within(1.45, 0.005).holds(1.4502));
  EXPECT_FALSE(within(1.46, 0.005).holds(1.4502));
  EXPECT_TRUE(within(60, 0).holds(60));
  EXPECT_FALSE(within(60, 0).holds(59));
  EXPECT_TRUE(at_most(2).holds(2));
  EXPECT_FALSE(at_most(2).holds(2.5));
  EXPECT_TRUE(at_least(8).holds(8));
  EXPECT_FALSE(at_least(8).holds(7));
  for (const Criterion& c : {within(0, 1e9), at_most(1e9), at_least(-1e9), the_same()})
    EXPECT_FALSE(c.holds(NAN));
  EXPECT_EQ(within(1.45, 0.00005).text(), "± 0.00005");
  EXPECT_EQ(within(60, 0, " ns").text(), "exactly");
  EXPECT_EQ(at_most(2, "/255").text(), "at most 2/255");
  EXPECT_EQ(at_least(1e-9).text(), "at least 1e-09");
}

TEST(Figures, AVerdictNeedsAReasonWhereItDiffersAndNoneWhereItAgrees) {
  const Claim plain{"a", "60", within(60, 0)}, excused{"a", "60", within(60, 0), "rounded"};
  const Measured same{"60", 60}, other{"59", 59};
  EXPECT_THAT(faults(plain, judged(plain, same)), IsEmpty());
  EXPECT_THAT(faults(plain, judged(plain, other)), Contains(HasSubstr("differs, and no reason is known")));
  EXPECT_THAT(faults(excused, judged(excused, other)), IsEmpty());
  EXPECT_EQ(judged(excused, other).reason, "rounded");
  EXPECT_THAT(faults(excused, judged(excused, same)), Contains(HasSubstr("agrees, though")));
  Claim timed = excused;
  timed.timed = true;  // and so of another machine
  EXPECT_THAT(faults(timed, judged(timed, same)), IsEmpty());
  const Claim words{"a", "06AF", the_same()};
  EXPECT_TRUE(judged(words, {"06AF"}).agrees);
  EXPECT_FALSE(judged(words, {"06AE"}).agrees);
}

TEST(Figures, ARowThatDoesNotFollowOrIsEmptyIsFound) {
  const Claim claim{"a", "60", within(60, 0)};
  Row row = judged(claim, {"60", 60});
  row.value = 59;
  EXPECT_THAT(faults(claim, row), Contains(HasSubstr("does not follow")));
  row = judged(claim, {"60", 60});
  row.published = "61";
  EXPECT_THAT(faults(claim, row), Contains(HasSubstr("does not follow")));
  EXPECT_THAT(faults(claim, judged(claim, {"", 60})), Contains(HasSubstr("'measured' is empty")));
}

// What the papers print and the project draws again.
TEST(Figures, EveryFigureIsThereWithItsClaims) {
  std::set<std::string> ids;
  for (const Figure& f : all_figures()) {
    EXPECT_TRUE(ids.insert(f.id).second) << f.id;
    EXPECT_TRUE(f.id.starts_with(f.paper + "-")) << f.id;
    EXPECT_FALSE(f.claims.empty()) << f.id;
    std::set<std::string> names;
    for (const Claim& c : f.claims) {
      EXPECT_TRUE(names.insert(c.what).second) << f.id << ": " << c.what;
      EXPECT_FALSE(c.published.empty()) << f.id << ": " << c.what;
    }
  }
  for (const char* id : {"spherical-05", "spherical-09", "spherical-10", "spherical-table-1", "spherical-11",
                         "spherical-14", "spherical-15", "spherical-16", "spherical-17", "quadratic-07",
                         "quadratic-08", "quadratic-09", "quadratic-10", "quadratic-11", "quadratic-times",
                         "processors-table-3", "processors-table-4", "processors-table-5"})
    EXPECT_TRUE(ids.contains(id)) << id;
}

std::vector<Entry> committed() {
  const auto json = read_file(c_folder / "figures.json");
  EXPECT_TRUE(json) << json.error().message;
  const auto entries = entries_of(*json, "figures.json");
  EXPECT_TRUE(entries) << entries.error().message;
  return *entries;
}

// The published number of each row, changed: no verdict stays what it is.
TEST(Figures, EveryVerdictCanGoTheOtherWay) {
  const std::vector<Figure> all = all_figures();
  int rows = 0;
  for (const Entry& entry : committed())
    for (const Row& row : entry.rows) {
      SCOPED_TRACE(entry.id + ": " + row.what);
      const auto figure = std::ranges::find(all, entry.id, &Figure::id);
      ASSERT_NE(figure, all.end());
      const auto claim = std::ranges::find(figure->claims, row.what, &Claim::what);
      ASSERT_NE(claim, figure->claims.end());
      const Measured measured{row.measured, row.value};
      ASSERT_EQ(judged(*claim, measured).agrees, row.agrees);
      Claim other = *claim;
      Criterion& c = other.criterion;
      switch (c.kind) {
        case Criterion::Kind::same:
          other.published = row.agrees ? row.measured + "0" : row.measured;
          break;
        case Criterion::Kind::within:
          c.value = row.agrees ? row.value + 2 * c.tolerance + 1 : row.value;
          break;
        case Criterion::Kind::at_most:
          c.value = row.agrees ? row.value - 1 : row.value;
          break;
        case Criterion::Kind::at_least:
          c.value = row.agrees ? row.value + 1 : row.value;
          break;
      }
      EXPECT_NE(judged(other, measured).agrees, row.agrees);
      if (other.timed && !row.agrees)
        EXPECT_THAT(faults(other, judged(other, measured)), IsEmpty());
      else
        EXPECT_THAT(faults(other, judged(other, measured)),
                    Contains(HasSubstr(row.agrees ? "differs, and no reason" : "agrees, though")));
      ++rows;
    }
  EXPECT_GT(rows, 80);
}

TEST(Figures, TheTableHasNoEmptyCell) {
  const std::string page = to_page(committed());
  const std::string table = page.substr(0, page.find("\n## The figures"));
  EXPECT_THAT(table, testing::Not(HasSubstr("|  |")));
  EXPECT_THAT(table, testing::Not(HasSubstr(": |")));
  EXPECT_THAT(table, testing::Not(HasSubstr("nan")));
}

TEST(Figures, JsonComesBack) {
  const Entry entry{"x-1",
                    "x",
                    "figure 1",
                    "of \"x\"",
                    "x",
                    {{"x-1.png", "a picture"}},
                    {{"a", "1", "1.1", 1.1, "± 0.2", true, "", false},
                     {"b", "1", "two", NAN, "the same", false, "why", true}}};
  const std::string json = to_json(std::array{entry});
  const auto back = entries_of(json, "x.json");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(to_json(*back), json);
  EXPECT_EQ(to_page(*back), to_page(std::array{entry}));
  const auto bad = entries_of("[{\"id\": 1}]", "x.json");
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().message, HasSubstr("x.json: "));
}

TEST(Figures, TimesStayOnAPageUntilTheirVerdictChanges) {
  const Claim time{
      .what = "time", .published = "1", .criterion = within(1, 0.1), .why_not = "slow", .timed = true};
  const Claim count{.what = "count", .published = "2", .criterion = within(2, 1)};
  const std::vector<Figure> figures = {{.id = "x-1", .claims = {time, count}}};
  const auto entry = [&](const Measured& of_time) {
    return Entry{.id = "x-1", .rows = {judged(time, of_time), judged(count, {"2.5", 2.5})}};
  };
  Entry before = entry({"1.01", 1.01});
  before.rows[1] = judged(count, {"2", 2});
  const auto page = [&](const Measured& of_time) {
    return to_json(with_times_of(std::array{before}, figures, {entry(of_time)}));
  };
  EXPECT_EQ(page({"1.05", 1.05}), to_json(std::array{entry({"1.01", 1.01})}));
  EXPECT_EQ(page({"1.2", 1.2}), to_json(std::array{entry({"1.2", 1.2})}));
  before.id = "x-2";
  EXPECT_EQ(page({"1.05", 1.05}), to_json(std::array{entry({"1.05", 1.05})}));
}

// A folder with one figure, and what is drawn again beside it.
class Stale : public testing::Test {
 protected:
  void SetUp() override {
    auto made = TemporaryFolder::make(std::filesystem::path(testing::TempDir()) / "figures");
    ASSERT_TRUE(made) << made.error().message;
    scratch_.emplace(std::move(*made));
    there_ = scratch_->path() / "there", here_ = scratch_->path() / "here";
    ASSERT_TRUE(make_folders(there_));
    ASSERT_TRUE(make_folders(here_));
    figures_ = {{"x-1",
                 "spherical",
                 "figure 1",
                 "a caption",
                 "a drawing",
                 {{"quick", "60", within(60, 0)},
                  {.what = "slow", .published = "1", .criterion = within(1, 0.1), .slow = true}},
                 [](const Context& context, Drawing& out) -> Status {
                   out.measured["quick"] = {"60", 60};
                   if (!context.quick) out.measured["slow"] = {"1.05", 1.05};
                   return save_picture(context, "x-1", Frame({4, 4}), "black", out);
                 }}};
    const auto whole = drawn(figures_[0], {.out = there_}),
               quick = drawn(figures_[0], {.out = here_, .quick = true});
    ASSERT_TRUE(whole) << whole.error().message;
    ASSERT_TRUE(quick) << quick.error().message;
    whole_ = {*whole}, quick_ = {*quick};
    write(whole_);
  }
  void write(const std::vector<Entry>& entries) {
    ASSERT_TRUE(write_file(there_ / "figures.json", to_json(entries)));
    ASSERT_TRUE(write_file(there_ / "README.md", to_page(entries)));
  }
  std::vector<std::string> found() {
    std::vector<std::string> notes;
    const auto wrong = stale(figures_, there_, quick_, here_, notes);
    EXPECT_TRUE(wrong) << wrong.error().message;
    return wrong ? *wrong : std::vector<std::string>{};
  }

  std::optional<TemporaryFolder> scratch_;
  std::filesystem::path there_, here_;
  std::vector<Figure> figures_;
  std::vector<Entry> whole_, quick_;
};

TEST_F(Stale, NothingIsWrongWithWhatWasJustWritten) {
  EXPECT_THAT(found(), IsEmpty());
}

TEST_F(Stale, AnotherPageIsFound) {
  ASSERT_TRUE(write_file(there_ / "README.md", to_page(whole_) + "\nand more\n"));
  EXPECT_THAT(found(), Contains(HasSubstr("README.md is not the page")));
}

TEST_F(Stale, AnotherMeasurementIsFound) {
  whole_[0].rows[0].measured = "60.0";
  write(whole_);
  EXPECT_THAT(found(), Contains(HasSubstr("'quick' is 60.0 there, measured 60")));
}

TEST_F(Stale, ASlowRowsVerdictMustFollow) {
  whole_[0].rows[1].value = 1.2;
  write(whole_);
  EXPECT_THAT(found(), Contains(HasSubstr("'slow': its verdict does not follow")));
}

TEST_F(Stale, AMissingRowIsFound) {
  whole_[0].rows.pop_back();
  write(whole_);
  EXPECT_THAT(found(), Contains(HasSubstr("'slow' has no row")));
}

TEST_F(Stale, AnotherPictureIsFound) {
  Frame frame({4, 4});
  frame.rgb[5] = 1;
  Drawing ignored;
  ASSERT_TRUE(save_picture({.out = there_}, "x-1", frame, "", ignored));
  EXPECT_THAT(found(), Contains(HasSubstr("x-1.png is not what is drawn")));
}

TEST_F(Stale, AnotherCaptionIsFound) {
  whole_[0].caption = "another";
  write(whole_);
  EXPECT_THAT(found(), Contains(HasSubstr("its caption is another")));
}

TEST_F(Stale, AFigureThatIsMissingIsFound) {
  write({});
  EXPECT_THAT(found(), Contains(HasSubstr("x-1: it is missing")));
}

TEST_F(Stale, AClaimThatNothingWasMeasuredForIsAnError) {
  figures_[0].claims.push_back({"forgotten", "1", within(1, 0)});
  const auto entry = drawn(figures_[0], {.out = here_, .quick = true});
  ASSERT_FALSE(entry);
  EXPECT_THAT(entry.error().message, HasSubstr("nothing was measured for 'forgotten'"));
  figures_[0].claims = {{"other", "60", within(60, 0)}};
  EXPECT_FALSE(drawn(figures_[0], {.out = here_, .quick = true}));
}

TEST(SixPointFit, GoesThroughTheSixPointsByOneDivision) {
  constexpr double c_x2 = 7.0, c_y2 = 0.0, c_x3 = 2.0,
                   c_y3 = 6.0;  // where the published form divides by zero
  constexpr std::array c_values{0.1, 0.4, 0.3, 0.9, 0.5, 0.7};
  const auto fit = fit_six_points(c_x2, c_y2, c_x3, c_y3, c_values);
  EXPECT_NEAR(fit.at(0.0, 0.0), c_values[0], 1e-14);
  EXPECT_NEAR(fit.at(c_x2, c_y2), c_values[1], 1e-14);
  EXPECT_NEAR(fit.at(c_x3, c_y3), c_values[2], 1e-14);
  EXPECT_NEAR(fit.at(c_x2 / 2, c_y2 / 2), c_values[3], 1e-14);
  EXPECT_NEAR(fit.at(c_x3 / 2, c_y3 / 2), c_values[4], 1e-14);
  EXPECT_NEAR(fit.at((c_x2 + c_x3) / 2, (c_y2 + c_y3) / 2), c_values[5], 1e-14);

  OperationCounts counts;
  const auto counted = [&](double v) { return CountedNumber(v, counts); };
  EXPECT_EQ((2.0 * counted(3.0) - counted(1.0) * (counted(1.0) + counted(4.0))).value(), 1.0);
  EXPECT_EQ((1.0 / counted(4.0)).value(), 0.25);
  EXPECT_EQ(counts.additions, 2);
  EXPECT_EQ(counts.multiplications, 2);
  EXPECT_EQ(counts.divisions, 1);
}

TEST(TimingTrace, TakesTheTimesBetweenAnInputsMoveAndItsOwn) {
  constexpr std::string_view c_vcd =
      "$timescale 1 fs $end\n$scope module interpolator_timing_tb $end\n$var reg 1 ! step $end\n$var reg 12 "
      "# "
      "angle[11:0] $end\n$scope module inner $end\n$var reg 1 % step $end\n$upscope $end\n$upscope "
      "$end\n#0\n0!\nb"
      "XXXXXXXXXXXX #\n"
      "#60000000\n1!\n1%\n#65000000\nb000000001111 "
      "#\n#90000000\n0!\n#120000000\n1!\n#125000000\nb000000010000 #\n#130000000\n";
  const auto trace = timing_trace(c_vcd);
  ASSERT_TRUE(trace) << trace.error().message;
  ASSERT_EQ(trace->steps.size(), 1u);
  EXPECT_EQ(trace->steps[0].from, 60.0);
  EXPECT_EQ(trace->steps[0].until, 120.0);
  EXPECT_EQ(trace->end, 130.0);
  ASSERT_EQ(trace->work.size(), 2u);
  EXPECT_EQ(trace->work[1].signal, "angle");
  EXPECT_EQ(trace->work[1].until - trace->work[1].from, 5.0);
  EXPECT_EQ(trace->work[1].pixel, 1);
  EXPECT_EQ(trace->values.back().text, "010");
  EXPECT_FALSE(timing_trace("$scope module other $end\n"));
}

TEST(Plot, ADataBlockIsGnuplots) {
  const std::vector<std::vector<double>> rows{{1, 0.5}, {2, 1.0 / 3.0}};
  EXPECT_EQ(data_block("a", rows), "$a << EOD\n1 0.5\n2 0.333333\nEOD\n");
  EXPECT_EQ(drawn_by("<svg>\n<!-- Produced by GNUPLOT 5.4 patchlevel 4 -->\n"),
            "Produced by GNUPLOT 5.4 patchlevel 4");
}

TEST(Sheet, PicturesStandBesideOneAnotherOnWhite) {
  Frame a({2, 1}), b({2, 1});
  a.rgb = {1, 2, 3, 4, 5, 6};
  b.rgb = {7, 8, 9, 10, 11, 12};
  const Frame whole = sheet(std::array{a, b, a}, 2);
  EXPECT_EQ(whole.size.width, 8u);
  EXPECT_EQ(whole.size.height, 6u);
  const auto at = [&](std::uint32_t x, std::uint32_t y) { return int{whole.rgb[whole.offset(x, y)]}; };
  EXPECT_EQ(at(0, 0), 1);
  EXPECT_EQ(at(1, 0), 4);
  EXPECT_EQ(at(2, 0), 255);
  EXPECT_EQ(at(6, 0), 7);
  EXPECT_EQ(at(7, 0), 10);
  EXPECT_EQ(at(0, 5), 1);
  EXPECT_EQ(at(7, 5), 255);
}

}  // namespace
}  // namespace halfway::figures
