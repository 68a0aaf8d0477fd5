// SPDX-License-Identifier: Apache-2.0
#include "sim/report/linked_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <regex>
#include <set>

#include "sim/files/gnuplot.hpp"
#include "sim/files/timing_diagram.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// The position of each point, by its link and its name.
std::map<std::string, std::pair<double, double>> places_in(const std::string& svg) {
  std::map<std::string, std::pair<double, double>> places;
  pugi::xml_document document;
  EXPECT_TRUE(document.load_string(svg.c_str()));
  for (const auto& found : document.select_nodes("//a")) {
    const pugi::xml_node link = found.node();
    const pugi::xml_node circle = link.child("circle");
    EXPECT_TRUE(link.child("use"));
    std::pair<double, double> place;
    EXPECT_EQ(
        std::sscanf(circle.attribute("transform").value(), "translate(%lf,%lf)", &place.first, &place.second),
        2)
        << circle.attribute("transform").value();
    places[std::string(link.attribute("href").value()) + " " + link.attribute("aria-label").value()] = place;
  }
  return places;
}

class PlotTest : public FolderTest {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
};

TEST_F(PlotTest, EachPointIsALinkAtItsPosition) {
  Plot plot{.x_label = "clocks \"of\" a frame", .y_label = "error"};
  plot.points = {{10, 1, 2, 0, "far < below"}, {1000, 100, 0, 1, "above"}, {100, 10, 2, 2, "between", true}};
  plot.front = {{10, 1}, {1000, 100}};
  const std::string svg = draw_plot(plot, here());
  const auto places = places_in(svg);
  ASSERT_EQ(places.size(), 3U);
  const auto below = places.at("#point-0 far < below"), above = places.at("#point-1 above"),
             between = places.at("#point-2 between");
  EXPECT_THAT(svg, AllOf(HasSubstr("aria-label=\"between\" class=\"aside\""),
                         Not(HasSubstr("aria-label=\"above\" class"))));
  // SVG's y axis points down; both axes are logarithmic.
  EXPECT_LT(below.first, between.first);
  EXPECT_GT(below.second, between.second);
  EXPECT_NEAR(between.first, (below.first + above.first) / 2, 1.0);
  EXPECT_NEAR(between.second, (below.second + above.second) / 2, 1.0);
}

TEST_F(PlotTest, PointsHaveLabelsAndRings) {
  Plot plot{.x_label = "ms", .y_label = "error", .legend = {"one"}, .looks = {{"#123456", 7}}};
  plot.points = {{1, 1, 0, 0, "first"}, {10, 2, 0, 1, "second"}};
  const std::regex mark("<use");
  const auto marks = [&](const std::string& text) {
    return std::distance(std::sregex_iterator(text.begin(), text.end(), mark), {});
  };
  const std::string plain = draw_plot(plot, here());
  plot.ring_legend = "it waits";
  plot.points[0].label = "named";
  plot.points[1].ring = true;
  const std::string svg = draw_plot(plot, here());
  EXPECT_EQ(marks(svg), marks(plain) + 2);  // one around the point, one in the legend
  EXPECT_THAT(svg, AllOf(HasSubstr("named"), HasSubstr("it waits"), HasSubstr("rgb( 18,  52,  86)")));
}

TEST(PlotLooks, AreDistinct) {
  std::set<std::pair<std::string, int>> looks;
  for (std::size_t series = 0; series < 60; ++series)
    looks.emplace(look_of(series).colour, look_of(series).shape);
  EXPECT_EQ(looks.size(), 60U);
}

TEST_F(PlotTest, ZeroHasASeparatePosition) {
  Plot plot{.x_label = "evaluations", .y_label = "pixels seen"};
  plot.points = {{0, 5, 0, 0, "none on the host"},
                 {10, 1, 0, 1, "least"},
                 {40, 0, 1, 2, "none seen"},
                 {20, 300, 1, 3, "most"}};
  plot.levels = {{0, "the best"}, {30, "a yardstick"}};
  plot.front = {{0, 5}, {10, 1}, {40, 0}};
  const std::string svg = draw_plot(plot, here());
  const auto places = places_in(svg);
  ASSERT_EQ(places.size(), 4U);
  const auto left = places.at("#point-0 none on the host"), least = places.at("#point-1 least"),
             bottom = places.at("#point-2 none seen"), most = places.at("#point-3 most");
  // Visibly separated. SVG's y axis points down.
  EXPECT_LT(left.first, least.first - 20);
  EXPECT_GT(bottom.second, least.second + 20);
  EXPECT_LT(most.second, least.second);
  EXPECT_LT(least.first, most.first);
  EXPECT_THAT(svg, AllOf(HasSubstr(">0<"), HasSubstr("a yardstick"), HasSubstr("the best")));
  // A plot with zeros only.
  EXPECT_NO_THROW(draw_plot({.points = {{0, 0, 0, 0, "alone"}}}, here()));
}

TEST_F(PlotTest, TimingShowsLevelsAndValues) {
  const TimingDiagram diagram{.lanes = {{"valid", {}, {{0, 1, false}, {1, 3, true}, {3, 4, false}}},
                                        {"x", {{1, 3, "7"}, {3, 4, "31"}, {0, 1, "too long"}}}},
                              .end = 4,
                              .width = 92,
                              .axis = "clock",
                              .ticks = {{0.5, "0"}, {2.5, "2"}},
                              .lines = {1, 2, 3, 4}};
  const std::string svg = run_gnuplot(timing_script(diagram), here(), "timing");
  for (const char* text : {"valid", ">7<", ">31<", ">2<", ">clock<"}) EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_THAT(svg, Not(HasSubstr("too long")));
}

}  // namespace
}  // namespace halfway::report
