// SPDX-License-Identifier: Apache-2.0
#include "sim/report/front_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/report/table_test.hpp"

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
  EXPECT_THAT(
      draw_front(front, here()),
      AllOf(HasSubstr("aria-label=\"q\""), HasSubstr("aria-label=\"s\""), HasSubstr("aria-label=\"dear\""),
            HasSubstr("spherical, published"), Not(HasSubstr("aria-label=\"p\"")),
            Not(HasSubstr("aria-label=\"q5\"")), HasSubstr("cells")));
  // A design that costs more and errs more is not on the line.
  EXPECT_EQ(lower_left({{100, 8}, {200, 2}, {300, 4}}),
            (std::vector<std::pair<double, double>>{{100, 8}, {200, 2}}));
  EXPECT_EQ(lower_left({{.x = 50, .y = 1, .aside = true}, {200, 2}}),
            (std::vector<std::pair<double, double>>{{200, 2}}));
  // The page lists the designs on the line, including those hidden under another mark.
  EXPECT_THAT(page_front(front),
              AllOf(HasSubstr("each of 3 designs"),
                    HasSubstr("1/255 of white):\nq (100 cells, 8);\ns (200 cells, 2)."),
                    Not(HasSubstr("dear")), Not(HasSubstr("Equal in cells and in rms error"))));
  std::string equal = c_front_study;
  equal += "twin,adaptive,exact,7,20,q,100,10,8,h\n";
  EXPECT_THAT(page_front(front_of(read(equal))),
              AllOf(HasSubstr("q and twin (100 cells, 8)"),
                    HasSubstr("Equal in cells and in rms error: q and twin.")));
  // If one count is missing, the axis shows clocks instead of cells.
  std::string uncounted = c_front_study;
  uncounted.replace(uncounted.find(",300,"), 5, ",,");
  EXPECT_THAT(draw_front(front_of(read(uncounted)), here()), HasSubstr("clocks of the frame"));
  EXPECT_THROW(page_front(front_of(read(uncounted))), Failure);
  EXPECT_THROW(draw_front(front_of(read("point,method\n")), here()), Failure);
}

}  // namespace
}  // namespace halfway::report
