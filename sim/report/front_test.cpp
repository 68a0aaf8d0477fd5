// SPDX-License-Identifier: Apache-2.0
#include "sim/report/front.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/costs/cells.hpp"
#include "sim/report/table_test.hpp"
#include "sim/system/must.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Two pictures with two and three hardware designs.
constexpr const char* c_front_study =
    R"(point,method,preset,scene_hash,exponent,hardware,cells,cycles,rms,record
p,phong,,7,5,,,0,0,a
q5,quadratic,exact,7,5,q,100,10,4,b
s5,spherical,exact,7,5,s,200,10,2,c
p,phong,,7,20,,,0,0,d
q,quadratic,exact,7,20,q,100,10,8,e
s,spherical,exact,7,20,s,200,20,2,f
dear,spherical,published,7,20,d,300,15,4,g
)";

using FrontTest = TableTest;

TEST_F(FrontTest, PlotsThePictureThatMostDesignsDraw) {
  const Table study = read(c_front_study);
  const Table front = front_of(study);
  ASSERT_EQ(front.rows.size(), 4U);
  EXPECT_EQ(front.text(1, "point"), "q");
  EXPECT_EQ(front.text(3, "cells"), "300");
  EXPECT_EQ(front.text(3, "record"), "");
  const auto svg = must(draw_front(front, here()));
  EXPECT_THAT(svg, AllOf(HasSubstr("aria-label=\"q\""), HasSubstr("aria-label=\"s\""),
                         HasSubstr("aria-label=\"dear\""), HasSubstr("spherical, published"),
                         Not(HasSubstr("aria-label=\"p\"")), Not(HasSubstr("aria-label=\"q5\"")),
                         HasSubstr("cells")));
  // A design that costs more and errs more is not on the line.
  EXPECT_EQ(lower_left({{100, 8}, {200, 2}, {300, 4}}),
            (std::vector<std::pair<double, double>>{{100, 8}, {200, 2}}));
  EXPECT_EQ(lower_left({{.x = 50, .y = 1, .aside = true}, {200, 2}}),
            (std::vector<std::pair<double, double>>{{200, 2}}));
  // The page lists the designs on the line, including those hidden under another mark.
  const auto words = must(page_front(front));
  EXPECT_THAT(words, AllOf(HasSubstr("each of 3 designs"),
                           HasSubstr("1/255 of white):\nq (100 cells, 8);\ns (200 cells, 2)."),
                           Not(HasSubstr("dear")), Not(HasSubstr("Equal in both figures"))));
  std::string equal = c_front_study;
  equal += "twin,adaptive,exact,7,20,q,100,10,8,h\n";
  EXPECT_THAT(*page_front(front_of(read(equal))),
              AllOf(HasSubstr("q and twin (100 cells, 8)"), HasSubstr("Equal in both figures: q and twin.")));
  // If one count is missing, the axis shows clocks instead of cells.
  std::string uncounted = c_front_study;
  uncounted.replace(uncounted.find(",300,"), 5, ",,");
  const auto clocks = must(draw_front(front_of(read(uncounted)), here()));
  EXPECT_THAT(clocks, HasSubstr("clocks of the frame"));
  EXPECT_FALSE(page_front(front_of(read(uncounted))));
  EXPECT_FALSE(draw_front(front_of(read("point,method\n")), here()));
}

// The page's front must be of the checkout's scene, space and hardware, and agree with front.csv next to it.
class GalleryFront : public GalleryTest {
 protected:
  void SetUp() override {
    GalleryTest::SetUp();
    front_ = gallery_table("front.csv");
    auto space = must(study::read_space(c_source / "sim/studies/small.toml"));
    for (study::DesignPoint& point : space)
      if (point.name() == front_.text(0, "point"))
        for (study::DesignPoint& other : space)
          if (other.picture() == point.picture()) points_.push_back(other);
  }
  Table front_;
  std::vector<study::DesignPoint> points_;
};

TEST_F(GalleryFront, IsDrawnFromItsTable) {
  expect_drawn("front.svg", draw_front(front_, here()));
}

TEST_F(GalleryFront, IsWhatItsPageSays) {
  const auto page = must(read_file(c_source / "docs/accuracy.md"));
  EXPECT_EQ(must(page_part(page, "front")), must(page_front(front_))) << c_again;
}

TEST_F(GalleryFront, IsOfTheCheckoutsDesigns) {
  ASSERT_EQ(front_.rows.size(), points_.size()) << c_again;
  for (std::size_t row = 0; row < points_.size(); ++row) expect_same_design(front_, row, points_[row]);
}

// Draw one of its designs with the current RTL.
TEST_F(GalleryFront, IsWhatTheHardwareDrawsNow) {
  const auto found = std::ranges::find(points_, study::Method::quadratic, &study::DesignPoint::method);
  ASSERT_NE(found, points_.end());
  const auto row = static_cast<std::size_t>(found - points_.begin());
  const study::StudySettings settings = study_of(*found);
  const auto made = must(study::run_study(settings));
  const study::Measurement& m = made.records.at(0).measured;
  EXPECT_EQ(front_.text(row, "cycles"), fmt::format("{}", m.cycles)) << c_again;
  EXPECT_EQ(front_.text(row, "rms"), fmt::format("{}", m.picture.rms)) << c_again;
  EXPECT_EQ(front_.text(row, "largest_error"), fmt::format("{}", m.picture.max_lsb)) << c_again;
  if (find_program("yosys").empty()) return;
  const auto hardware = must(study::hardware_figures(settings.scene, made.records, settings.folders, {}));
  const auto& cells = hardware.at(m.hardware).cells;
  ASSERT_TRUE(cells);
  EXPECT_EQ(front_.text(row, "cells"), fmt::format("{:.0f}", study::cell_count(*cells))) << c_again;
}

}  // namespace
}  // namespace halfway::report
