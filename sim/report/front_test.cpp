// SPDX-License-Identifier: Apache-2.0
#include "sim/report/front.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/costs/cells.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/pictures.hpp"
#include "sim/study/study.hpp"
#include "sim/system/file.hpp"
#include "sim/system/page_part.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::report {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path c_source = HALFWAY_SOURCE_DIR;

// Two pictures with two and three hardware designs.
constexpr const char* c_study = R"(point,method,preset,scene_hash,exponent,hardware,cells,cycles,rms,record
p,phong,,7,5,,,0,0,a
q5,quadratic,exact,7,5,q,100,10,4,b
s5,spherical,exact,7,5,s,200,10,2,c
p,phong,,7,20,,,0,0,d
q,quadratic,exact,7,20,q,100,10,8,e
s,spherical,exact,7,20,s,200,20,2,f
dear,spherical,published,7,20,d,300,15,4,g
)";

class FrontTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Table read(const std::string& text) const {
    EXPECT_TRUE(write_file(here() / "t.csv", text));
    auto table = read_csv(here() / "t.csv");
    EXPECT_TRUE(table) << table.error().message;
    return table ? *table : Table{};
  }
  const fs::path& here() const { return folder_->path(); }
  Result<TemporaryFolder> folder_ = TemporaryFolder::make(fs::temp_directory_path());
};

TEST_F(FrontTest, PlotsThePictureThatMostDesignsDraw) {
  const Table study = read(c_study);
  const Table front = front_of(study);
  ASSERT_EQ(front.rows.size(), 4U);
  EXPECT_EQ(front.text(1, "point"), "q");
  EXPECT_EQ(front.text(3, "cells"), "300");
  EXPECT_EQ(front.text(3, "record"), "");
  const auto svg = draw_front(front, here());
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_THAT(*svg, AllOf(HasSubstr("aria-label=\"q\""), HasSubstr("aria-label=\"s\""),
                          HasSubstr("aria-label=\"dear\""), HasSubstr("spherical, published"),
                          Not(HasSubstr("aria-label=\"p\"")), Not(HasSubstr("aria-label=\"q5\"")),
                          HasSubstr("cells")));
  // A design that costs more and errs more is not on the line.
  EXPECT_EQ(lower_left({{100, 8}, {200, 2}, {300, 4}}),
            (std::vector<std::pair<double, double>>{{100, 8}, {200, 2}}));
  EXPECT_EQ(lower_left({{.x = 50, .y = 1, .aside = true}, {200, 2}}),
            (std::vector<std::pair<double, double>>{{200, 2}}));
  // The page lists the designs on the line, including those hidden under another mark.
  const auto words = page_front(front);
  ASSERT_TRUE(words) << words.error().message;
  EXPECT_THAT(*words, AllOf(HasSubstr("each of 3 designs"),
                            HasSubstr("1/255 of white):\nq (100 cells, 8);\ns (200 cells, 2)."),
                            Not(HasSubstr("dear")), Not(HasSubstr("Equal in both figures"))));
  std::string equal = c_study;
  equal += "twin,adaptive,exact,7,20,q,100,10,8,h\n";
  EXPECT_THAT(*page_front(front_of(read(equal))),
              AllOf(HasSubstr("q and twin (100 cells, 8)"), HasSubstr("Equal in both figures: q and twin.")));
  // If one count is missing, the axis shows clocks instead of cells.
  std::string uncounted = c_study;
  uncounted.replace(uncounted.find(",300,"), 5, ",,");
  const auto clocks = draw_front(front_of(read(uncounted)), here());
  ASSERT_TRUE(clocks) << clocks.error().message;
  EXPECT_THAT(*clocks, HasSubstr("clocks of the frame"));
  EXPECT_FALSE(page_front(front_of(read(uncounted))));
  EXPECT_FALSE(draw_front(front_of(read("point,method\n")), here()));
}

// The page's front must be of the checkout's scene, space and hardware, and agree with front.csv next to it.
class GalleryFront : public FrontTest {
 protected:
  void SetUp() override {
    FrontTest::SetUp();
    if (IsSkipped()) return;
    auto table = read_csv(c_source / "docs/results/gallery/front.csv");
    ASSERT_TRUE(table) << table.error().message;
    front_ = std::move(*table);
    auto space = study::read_space(c_source / "sim/studies/small.toml");
    ASSERT_TRUE(space) << space.error().message;
    for (study::DesignPoint& point : *space)
      if (point.name() == front_.text(0, "point"))
        for (study::DesignPoint& other : *space)
          if (other.picture() == point.picture()) points_.push_back(other);
  }
  static constexpr const char* c_again = "make gallery measures it again";
  Table front_;
  std::vector<study::DesignPoint> points_;
};

TEST_F(GalleryFront, IsDrawnFromItsTable) {
  const auto drawn = read_file(c_source / "docs/results/gallery/front.svg");
  ASSERT_TRUE(drawn) << drawn.error().message;
  const auto svg = draw_front(front_, here());
  ASSERT_TRUE(svg) << svg.error().message;
  const auto gnuplot = [](const std::string& text) {
    const std::size_t at = text.find("GNUPLOT");
    return text.substr(at, text.find('\n', at) - at);
  };
  if (gnuplot(*drawn) != gnuplot(*svg)) GTEST_SKIP() << "drawn by " << gnuplot(*drawn);
  EXPECT_TRUE(*drawn == *svg) << c_again;
}

TEST_F(GalleryFront, IsWhatItsPageSays) {
  const auto page = read_file(c_source / "docs/accuracy.md");
  ASSERT_TRUE(page) << page.error().message;
  const auto part = page_part(*page, "front"), expected = page_front(front_);
  ASSERT_TRUE(part) << part.error().message;
  ASSERT_TRUE(expected) << expected.error().message;
  EXPECT_EQ(*part, *expected) << c_again;
}

TEST_F(GalleryFront, IsOfTheCheckoutsDesigns) {
  ASSERT_EQ(front_.rows.size(), points_.size()) << c_again;
  const std::string scene = c_source / "sim/studies/sphere.toml";
  const auto loaded = load_scene(scene, c_source / "sim/scenes");
  ASSERT_TRUE(loaded) << loaded.error().message;
  for (std::size_t row = 0; row < points_.size(); ++row) {
    EXPECT_EQ(front_.text(row, "point"), points_[row].name()) << c_again;
    EXPECT_EQ(front_.text(row, "scene_hash"), study::scene_hash(*loaded)) << c_again;
    if (!study::in_hardware(points_[row].method)) continue;
    const auto drawn = study::drawn_scene(scene, c_source / "sim/scenes", points_[row]);
    ASSERT_TRUE(drawn) << drawn.error().message;
    const auto hardware = study::hardware_of(points_[row], *drawn);
    ASSERT_TRUE(hardware) << hardware.error().message;
    EXPECT_EQ(front_.text(row, "hardware"), hardware->key.name()) << c_again;
  }
}

// Draw one of its designs with the current RTL.
TEST_F(GalleryFront, IsWhatTheHardwareDrawsNow) {
  const auto found = std::ranges::find(points_, study::Method::quadratic, &study::DesignPoint::method);
  ASSERT_NE(found, points_.end());
  const auto row = static_cast<std::size_t>(found - points_.begin());
  study::StudySettings settings;
  settings.scene = c_source / "sim/studies/sphere.toml";
  settings.points = {*found};
  settings.out = here();
  settings.folders = {c_source, c_source / "build/cache"};
  const auto made = study::run_study(settings);
  ASSERT_TRUE(made) << made.error().message;
  const study::Measurement& m = made->records.at(0).measured;
  EXPECT_EQ(front_.text(row, "cycles"), fmt::format("{}", m.cycles)) << c_again;
  EXPECT_EQ(front_.text(row, "rms"), fmt::format("{}", m.picture.rms)) << c_again;
  EXPECT_EQ(front_.text(row, "largest_error"), fmt::format("{}", m.picture.max_lsb)) << c_again;
  if (find_program("yosys").empty()) return;
  const auto hardware = study::hardware_figures(settings.scene, made->records, settings.folders, {});
  ASSERT_TRUE(hardware) << hardware.error().message;
  const auto& cells = hardware->at(m.hardware).cells;
  ASSERT_TRUE(cells);
  EXPECT_EQ(front_.text(row, "cells"), fmt::format("{:.0f}", study::cell_count(*cells))) << c_again;
}

}  // namespace
}  // namespace halfway::report
