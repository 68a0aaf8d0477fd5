// SPDX-License-Identifier: Apache-2.0
#include "sim/report/times.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/report/table_test.hpp"
#include "sim/system/must.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::report {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Two pictures. Times in ms: q 1, a 2, s 3 (beaten by a), p at least 1.5, phong 10.
constexpr const char* c_times =
    "scene_hash,point,design,method,preset,form,tessellation,exponent,width,height,hardware,triangles,"
    "host_ns,host_instructions,words,hardware_ns,overlapped_ns,sequential_ns,bound,rms,largest_error,"
    "perceived_pixels,clock_mhz,slowest_part\n"
    "7,q at,q,quadratic,published,,1,20,64,48,k,690,2e5,1e6,5,1e6,1e6,1.2e6,hardware,8,9,10,135.0,\n"
    "7,s at,s,spherical,exact,,1,20,64,48,k,690,3e6,1e6,5,1e6,3e6,4e6,host,5,9,10,105.0,\n"
    "7,a at,a,adaptive,exact,,1,20,64,48,k,690,1e6,1e6,5,2e6,2e6,3e6,hardware,2,3,4,105.0,\n"
    "7,v "
    "at,v,processors-2,exact,folded,1,20,64,48,k,690,3e5,1e6,5,1.5e6,1.5e6,1.8e6,hardware,1,3,4,40.9,dot\n"
    "7,p at,phong,phong,,,1,20,64,48,,690,1e7,,,,1e7,1e7,host,0,0,0,,\n"
    "7,q large,q,quadratic,published,,1,20,80,60,k,690,2e5,1e6,5,4e6,4e6,4.2e6,hardware,7,9,10,135.0,\n";

using TimesTest = TableTest;

TEST_F(TimesTest, EachPictureHasAPlot) {
  const auto pictures = pictures_of(read(c_times));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_EQ(pictures[0].rows.size(), 5U);
  EXPECT_EQ(plot_name(pictures[1]), "times-80x60.svg");
  const auto designs = must(write_times(read(c_times), here() / "out", here()));
  EXPECT_EQ(designs, 6U);
  const auto svg = must(read_file(here() / "out/times-64x48.svg"));
  EXPECT_THAT(svg, AllOf(HasSubstr("aria-label=\"q at\""), HasSubstr("aria-label=\"p at\""),
                         HasSubstr("milliseconds per frame"), Not(HasSubstr("q large")),
                         HasSubstr("class=\"aside\""), HasSubstr("aria-label=\"v at, at least\"")));
  EXPECT_TRUE(fs::exists(here() / "out/times-80x60.svg"));
  EXPECT_TRUE(fs::exists(here() / "out/times.csv"));
}

TEST_F(TimesTest, SentencesAreOfTheFront) {
  const auto text = must(readme_times(read(c_times)));
  EXPECT_THAT(
      text,
      AllOf(HasSubstr("| q | 1 | hardware | 1.2 | 8 | 9 |\n| a | 2 | hardware | 3 | 2 | 3 |\n| phong | 10 |"),
            HasSubstr(
                "- The rms error of a is 4 times smaller than that of q. Its frame takes 2 times as long.\n"),
            HasSubstr("hardware take 3 ms with a, of which the host takes 33 %, and 1.2 ms with q.\n"),
            HasSubstr("(phong) takes 10 ms, 5 times as long as a.\n"), Not(HasSubstr("| s |")),
            Not(HasSubstr("| v |"))));
  const auto page = must(page_times(read(c_times)));
  EXPECT_THAT(page,
              AllOf(HasSubstr("| s | 3 | host | 4 | 3 | 1 | 105.0 | 1 | 5 | 5 | 9 | 10 |"),
                    HasSubstr("| v | ≥ 1.5 | hardware | ≥ 1.8 | 0.3 | ≥ 1.5 | ≤ 40.9 (`dot`) | 1 | 5 | 1 "
                              "| 3 | 4 |"),
                    HasSubstr("times-80x60.svg"),
                    HasSubstr("| phong | 10 | host | 10 | 10 | – | – | – | – | 0 | 0 | 0 |")));
}

TEST_F(TimesTest, WithoutDesignsThereIsNothingToSay) {
  EXPECT_FALSE(page_times(read("point,method\n")));
  EXPECT_FALSE(readme_times(read("point,method\n")));
}

class GalleryTimes : public GalleryTest {
 protected:
  Table times_ = gallery_table("times.csv");
};

TEST_F(GalleryTimes, AreWhatThePagesSay) {
  const auto readme = read_file(c_source / "README.md"), page = read_file(c_source / "docs/accuracy.md");
  ASSERT_TRUE(readme && page);
  EXPECT_EQ(*page_part(*readme, "times"), *readme_times(times_)) << c_again;
  EXPECT_EQ(*page_part(*page, "times"), *page_times(times_)) << c_again;
}

TEST_F(GalleryTimes, AreDrawnFromTheirTable) {
  for (const Table& picture : pictures_of(times_))
    expect_drawn(plot_name(picture), draw_times(picture, here()));
}

TEST_F(GalleryTimes, AreOfTheCheckoutsDesigns) {
  const auto space = must(study::read_space(c_source / "sim/studies/times.toml"));
  for (std::size_t row = 0; row < times_.rows.size(); ++row) {
    const auto point = std::ranges::find(space, times_.text(row, "point"), &study::DesignPoint::name);
    ASSERT_NE(point, space.end()) << times_.text(row, "point") << ": " << c_again;
    expect_same_design(times_, row, *point);
  }
}

// Draw one of the designs with the current RTL. The host's time is the machine's, and is not compared.
TEST_F(GalleryTimes, AreWhatTheHardwareTakesNow) {
  const study::DesignPoint point{
      .method = study::Method::adaptive, .exponent = 20, .size = {640, 480}, .tile = {1024, 1024}};
  std::size_t row = 0;
  while (row < times_.rows.size() && times_.text(row, "point") != point.name()) ++row;
  ASSERT_LT(row, times_.rows.size()) << point.name() << ": " << c_again;
  const study::StudySettings settings = study_of(point);
  const auto made = must(study::run_study(settings));
  const auto hardware =
      study::hardware_figures(settings.scene, made.records, settings.folders, {.cells = false});
  ASSERT_TRUE(hardware) << hardware.error().message;
  const study::Measurement& m = made.records.at(0).measured;
  EXPECT_EQ(times_.text(row, "cycles"), fmt::format("{}", m.cycles)) << c_again;
  EXPECT_EQ(times_.text(row, "rms"), fmt::format("{}", m.picture.rms)) << c_again;
  const auto& mhz = hardware->at(m.hardware).mhz;
  ASSERT_TRUE(mhz);
  EXPECT_EQ(times_.text(row, "hardware_ns"),
            fmt::format("{:.6g}", 1e3 * static_cast<double>(m.cycles) / *mhz))
      << c_again;
}

}  // namespace
}  // namespace halfway::report
