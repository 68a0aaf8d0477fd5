// SPDX-License-Identifier: Apache-2.0
// The plots and page parts that are made from the tables of studies.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/csv.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/report/front_plot.hpp"
#include "sim/report/times.hpp"

namespace halfway::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TablePlots : public FolderTest {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Table read(const std::string& text) const { return must(read_csv(write("t.csv", text))); }
};

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

TEST_F(TablePlots, PlotsThePictureThatMostDesignsDraw) {
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
  const Table empty = read("point,method\n");
  EXPECT_THROW(draw_front(front_of(empty), here()), Failure);
  EXPECT_THROW(page_times(empty), Failure);
  EXPECT_THROW(readme_times(empty), Failure);
}

// Two pictures. Times in ms: q 1, a 2, s and t 3 (beaten by a), v 2.5 (beaten by a), phong 10.
constexpr const char* c_times =
    "scene,scene_hash,point,design,method,preset,form,tessellation,exponent,width,height,hardware,triangles,"
    "host_ns,host_instructions,words,hardware_ns,overlapped_ns,sequential_ns,bound,rms,largest_error,"
    "perceived_pixels,clock_mhz,device\n"
    "ball,7,q at,q,quadratic,published,,1,20,64,48,k,690,2e5,1e6,5,1e6,1e6,1.2e6,hardware,8,9,10,135.0,FPGA "
    "1\n"
    "ball,7,s at,s,spherical,exact,,1,20,64,48,k,690,3e6,1e6,5,1e6,3e6,4e6,host,5,9,10,105.0,FPGA 1\n"
    "ball,7,t at,t,spherical,exact,,1,20,64,48,k,690,3e6,1e6,5,1e6,3e6,4e6,host,6,9,10,105.0,FPGA 1\n"
    "ball,7,a at,a,adaptive,exact,,1,20,64,48,k,690,1e6,1e6,5,2e6,2e6,3e6,hardware,2,3,4,105.0,FPGA 1\n"
    "ball,7,v "
    "at,v,processors-2,exact,folded,1,20,64,48,k,690,3e5,1e6,5,2.5e6,2.5e6,2.8e6,hardware,2.5,3,4,40.9,"
    "FPGA 1\n"
    "ball,7,p at,phong,phong,,,1,20,64,48,,690,1e7,,,,1e7,1e7,host,0,0,0,,\n"
    "ball,7,m at,phong-mesa,phong-mesa,,,1,20,64,48,,690,6e6,,,,6e6,6e6,host,3,3,4,,\n"
    "ball,7,q "
    "large,q,quadratic,published,,1,20,80,60,k,690,2e5,1e6,5,4e6,4e6,4.2e6,hardware,7,9,10,135.0,FPGA "
    "1\n";

TEST_F(TablePlots, EachPictureHasAPlot) {
  const auto pictures = pictures_of(read(c_times));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].rows.size(), 7U);
  EXPECT_EQ(plot_name(pictures[1]), "times-ball-80x60.svg");
  EXPECT_EQ(write_times(read(c_times), at("out"), here()), 8U);
  EXPECT_THAT(
      text_of("out/times-ball-64x48.svg"),
      AllOf(HasSubstr("aria-label=\"q at\""), HasSubstr("aria-label=\"p at\""), HasSubstr("ms per frame"),
            Not(HasSubstr("q large")), HasSubstr("the host takes longer"), HasSubstr("quadratic published"),
            Not(HasSubstr("centroid")), HasSubstr("aria-label=\"v at\"")));
  EXPECT_TRUE(std::filesystem::exists(at("out/times-ball-80x60.svg")));
  EXPECT_TRUE(std::filesystem::exists(at("out/times.csv")));
}

TEST_F(TablePlots, SentencesAreOfTheFront) {
  EXPECT_THAT(
      readme_times(read(c_times)),
      AllOf(HasSubstr("| q | 1 | hardware | 1.2 | 8 | 9 |\n"),
            HasSubstr("| a | 2 | hardware | 3 | 2 | 3 |\n"),
            HasSubstr(
                "- The rms error of a is 4 times smaller than that of q. Its frame takes 2 times as long.\n"),
            HasSubstr("- phong takes 5 times as long as a overlapped, and 3.3 times in sequence.\n"),
            HasSubstr("the hardware at its clock on an FPGA 1."),
            HasSubstr("| phong-mesa | 6 | host | 6 | 3 | 3 |\n| phong | 10 |"),
            HasSubstr("- phong-mesa takes 3 times as long as a overlapped, and 2 times in sequence.\n"),
            HasSubstr("| s | 3 | host | 4 | 5 | 9 |"), HasSubstr("| v | 2.5 | hardware | 2.8 | 2.5 | 3 |"),
            Not(HasSubstr("| t |"))));
  EXPECT_THAT(page_times(read(c_times)),
              AllOf(HasSubstr("| s | 3 | host | 4 | 3 | 1 | 105.0 | 1 | 5 | 5 | 9 | 10 |"),
                    HasSubstr("| v | 2.5 | hardware | 2.8 | 0.3 | 2.5 | 40.9 | 1 | 5 | 2.5 | 3 | 4 |"),
                    HasSubstr("times-ball-80x60.svg"),
                    HasSubstr("| phong | 10 | host | 10 | 10 | – | – | – | – | 0 | 0 | 0 |")));
}

// Their errors are against another reference.
TEST_F(TablePlots, FilteredPicturesAreNotOnTheFront) {
  EXPECT_THAT(readme_times(read(c_times)), Not(HasSubstr("filtered")));
  Table times = read(c_times);
  times.columns.emplace_back("subpixels");
  for (std::vector<std::string>& row : times.rows) row.emplace_back();
  std::vector<std::string> filtered = times.rows.front();  // as quick as the quickest
  filtered[2] = filtered[3] = "f";
  filtered[20] = "0.1";
  filtered.back() = "16";
  times.rows.push_back(filtered);
  EXPECT_EQ(pictures_of(times).size(), 2U);
  EXPECT_THAT(readme_times(times),
              AllOf(HasSubstr("*8 designs draw"), HasSubstr("against a filtered reference"),
                    HasSubstr("| q | 1 |"), Not(HasSubstr("| f |"))));
  EXPECT_THAT(page_times(times), HasSubstr("| f | 1 | hardware |"));
  write_times(times, at("out"), here());
  EXPECT_THAT(text_of("out/times-ball-64x48.svg"), HasSubstr("filtered published"));
}

}  // namespace
}  // namespace halfway::report
