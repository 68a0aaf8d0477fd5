// SPDX-License-Identifier: Apache-2.0
// For tests: tables of studies, and comparison of the gallery's tables and plots with the checkout.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/report/plot.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/study/hardware.hpp"
#include "sim/study/pictures.hpp"
#include "sim/study/study.hpp"
#include "sim/system/csv.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::report {

class TableTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  }
  Table read(const std::string& text) const {
    EXPECT_TRUE(write_file(here() / "t.csv", text));
    return must(read_csv(here() / "t.csv"));
  }
  const std::filesystem::path& here() const { return folder_.path(); }
  const TemporaryFolder folder_ = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
};

/// The tables and plots in docs/results/gallery, all of the scene sim/studies/sphere.toml.
class GalleryTest : public TableTest {
 protected:
  static Table gallery_table(const char* name) { return must(read_csv(c_gallery / name)); }
  /// Skips the comparison if another gnuplot drew the file.
  static void expect_drawn(const std::string& name, const Result<std::string>& svg) {
    const auto drawn = must(read_file(c_gallery / name));
    ASSERT_TRUE(svg) << svg.error().message;
    const auto gnuplot = [](const std::string& text) {
      const std::size_t at = text.find("GNUPLOT");
      return text.substr(at, text.find('\n', at) - at);
    };
    if (gnuplot(drawn) != gnuplot(*svg)) GTEST_SKIP() << "drawn by " << gnuplot(drawn);
    EXPECT_TRUE(drawn == *svg) << name << ": " << c_again;
  }
  /// The row is of the point, with the checkout's scene and hardware.
  static void expect_same_design(const Table& table, std::size_t row, const study::DesignPoint& point) {
    EXPECT_EQ(table.text(row, "point"), point.name()) << c_again;
    const auto loaded = must(load_scene(c_scene, c_source / "sim/scenes"));
    EXPECT_EQ(table.text(row, "scene_hash"), study::scene_hash(loaded)) << c_again;
    if (!study::in_hardware(point.method)) return;
    const auto drawn = must(study::drawn_scene(c_scene, c_source / "sim/scenes", point));
    const auto hardware = must(study::hardware_of(point, drawn));
    EXPECT_EQ(table.text(row, "hardware"), hardware.key.name()) << c_again;
  }
  /// Settings to measure the point with the current RTL.
  study::StudySettings study_of(const study::DesignPoint& point) const {
    study::StudySettings settings;
    settings.scene = c_scene;
    settings.points = {point};
    settings.out = here();
    settings.folders = {c_source, c_source / "build/cache"};
    return settings;
  }
  static inline const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
  static inline const std::filesystem::path c_gallery = c_source / "docs/results/gallery";
  static inline const std::string c_scene = c_source / "sim/studies/sphere.toml";
  static constexpr const char* c_again = "make gallery measures it again";
};

}  // namespace halfway::report
