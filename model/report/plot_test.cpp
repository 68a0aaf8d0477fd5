// SPDX-License-Identifier: Apache-2.0
#include "report/plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>

#include "common/file.hpp"
#include "common/subprocess.hpp"

namespace halfway::report {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class PlotTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (find_program("gnuplot").empty()) GTEST_SKIP() << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Result<TemporaryFolder> folder_ = TemporaryFolder::make(std::filesystem::temp_directory_path());
};

TEST_F(PlotTest, EachPointIsALinkInItsPlace) {
  Plot plot{.x_label = "clocks \"of\" a frame", .y_label = "error"};
  plot.points = {{10, 1, 2, 0, "far < below"}, {1000, 100, 0, 1, "above"}, {100, 10, 2, 2, "between", true}};
  plot.front = {{10, 1}, {1000, 100}};
  const auto svg = draw_plot(plot, folder_->path());
  ASSERT_TRUE(svg) << svg.error().message;
  pugi::xml_document document;
  ASSERT_TRUE(document.load_string(svg->c_str()));
  std::map<std::string, std::pair<double, double>> places;
  for (const auto& found : document.select_nodes("//a")) {
    const pugi::xml_node link = found.node();
    const pugi::xml_node circle = link.child("circle");
    ASSERT_TRUE(link.child("use"));
    std::pair<double, double> place;
    ASSERT_EQ(
        std::sscanf(circle.attribute("transform").value(), "translate(%lf,%lf)", &place.first, &place.second),
        2)
        << circle.attribute("transform").value();
    places[std::string(link.attribute("href").value()) + " " + link.attribute("aria-label").value()] = place;
  }
  ASSERT_EQ(places.size(), 3U);
  const auto below = places.at("#point-0 far < below"), above = places.at("#point-1 above"),
             between = places.at("#point-2 between");
  EXPECT_THAT(*svg, HasSubstr("aria-label=\"between\" class=\"aside\""));
  EXPECT_THAT(*svg, Not(HasSubstr("aria-label=\"above\" class")));
  // SVG's y goes down; both axes are logarithmic.
  EXPECT_LT(below.first, between.first);
  EXPECT_GT(below.second, between.second);
  EXPECT_NEAR(between.first, (below.first + above.first) / 2, 1.0);
  EXPECT_NEAR(between.second, (below.second + above.second) / 2, 1.0);
}

TEST_F(PlotTest, TimingShowsLevelsAndValues) {
  const auto svg = draw_timing({{"valid", true, {"0", "1", "1", "0"}}, {"x", false, {"", "7", "7", "31"}}}, 0,
                               folder_->path());
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_THAT(*svg, HasSubstr("valid"));
  EXPECT_THAT(*svg, HasSubstr(">7<"));
  EXPECT_THAT(*svg, HasSubstr(">31<"));
}

}  // namespace
}  // namespace halfway::report
