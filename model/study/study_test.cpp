// SPDX-License-Identifier: Apache-2.0
#include "study/study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "common/file.hpp"

namespace halfway::study {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;

class StudyTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
    ASSERT_TRUE(folder) << folder.error().message;
    folder_.emplace(std::move(*folder));
    settings_.scene = c_source / "sim/studies/sphere.toml";
    settings_.out = folder_->path();
    settings_.threads = 2;
    settings_.folders = {c_source, c_source / "build" / "cache"};
    for (const Method method : {Method::phong, Method::gouraud, Method::quadratic, Method::adaptive})
      settings_.points.push_back(
          {.method = method, .tessellation = 0.5, .exponent = 50.0, .size = {160, 120}});
  }
  Study study() const {
    auto made = run_study(settings_);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::move(*made) : Study{};
  }
  std::optional<TemporaryFolder> folder_;
  StudySettings settings_;
};

TEST_F(StudyTest, MeasuresEachMethodAsWhatItIs) {
  const Study made = study();
  ASSERT_EQ(made.records.size(), 4U);
  EXPECT_EQ(made.measured, 4U);
  const Measurement &phong = made.records[0].measured, &gouraud = made.records[1].measured,
                    &quadratic = made.records[2].measured, &adaptive = made.records[3].measured;
  EXPECT_EQ(phong.picture.max_lsb, 0U);
  EXPECT_EQ(phong.mach_bands.rms, 0.0);
  EXPECT_GT(phong.mach_bands.edges, 10U);
  EXPECT_GT(phong.highlight.pixels, 100U);
  EXPECT_LT(phong.highlight.pixels, phong.picture.pixels / 2);
  EXPECT_GT(gouraud.picture.rms, quadratic.picture.rms);
  EXPECT_GT(quadratic.picture.rms, adaptive.picture.rms);
  EXPECT_GT(gouraud.highlight.rms, gouraud.picture.rms);
  EXPECT_GT(gouraud.perceived, adaptive.perceived);
  EXPECT_LE(adaptive.picture.max_lsb, 4U);
  EXPECT_EQ(gouraud.cycles, 0U);
  EXPECT_GE(quadratic.cycles, quadratic.fragments);
  EXPECT_GT(quadratic.fragments, 1000U);
  EXPECT_EQ(quadratic.hardware, adaptive.hardware);
  EXPECT_GT(adaptive.setup.leaves, quadratic.setup.leaves);
}

TEST_F(StudyTest, GoesOnWhereItWasBrokenOff) {
  const std::string first = to_csv(study().provenance, study().records);
  EXPECT_EQ(study().measured, 0U);
  // A point without its figures, and another without its frame.
  const Provenance provenance = study().provenance;
  const auto lose = [&](std::size_t point, const char* ending) {
    return std::filesystem::remove(folder_->path() / "points" /
                                   (record_name(provenance, settings_.points[point]) + ending));
  };
  EXPECT_TRUE(lose(0, ".json") && lose(1, ".png"));
  const Study again = study();
  EXPECT_EQ(again.measured, 2U);
  EXPECT_EQ(to_csv(again.provenance, again.records), first);
}

TEST_F(StudyTest, MeasuresAnewWhatIsDamagedOrOfAnotherScene) {
  study();
  const auto file =
      folder_->path() / "points" / (record_name(study().provenance, settings_.points[0]) + ".json");
  ASSERT_TRUE(write_file(file, "{\"figures\": {}}"));
  EXPECT_EQ(study().measured, 1U);
  settings_.scene = "matte";
  EXPECT_EQ(study().measured, 4U);
}

TEST_F(StudyTest, PartsAreTheWhole) {
  settings_.parts = 3;
  std::vector<std::string> names;
  for (settings_.part = 0; settings_.part < settings_.parts; ++settings_.part)
    for (const Record& record : study().records) names.push_back(record.point.name());
  std::vector<std::string> all;
  for (const DesignPoint& point : settings_.points) all.push_back(point.name());
  EXPECT_EQ(names, all);
  const auto open = open_parts(settings_);
  ASSERT_TRUE(open) << open.error().message;
  EXPECT_TRUE(open->empty());
  std::filesystem::remove_all(folder_->path() / "points");
  settings_.part = 1;
  study();
  EXPECT_THAT(*open_parts(settings_), ::testing::ElementsAre(0U, 2U));
}

TEST_F(StudyTest, TellsThePointThatFails) {
  settings_.scene = "lights";
  settings_.points = {{.method = Method::processors_1, .preset = Preset::published}};
  const auto made = run_study(settings_);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ExitCode::bad_input);
  EXPECT_THAT(made.error().message, HasSubstr("processors-1 published"));
  EXPECT_THAT(made.error().message, HasSubstr("version II"));
}

std::vector<double> errors_and_cycles(const Record& record) {
  return {record.measured.picture.rms, static_cast<double>(record.measured.cycles)};
}

TEST(Front, IsWhatNoOtherBeats) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Record> records(1 + random() % 30);
    for (Record& record : records) {
      record.measured.picture.rms = static_cast<double>(random() % 8);
      record.measured.cycles = random() % 8;
    }
    const auto front = front_of(records, errors_and_cycles);
    ASSERT_FALSE(front.empty());
    for (std::size_t i = 0; i < records.size(); ++i) {
      const bool on_front = std::ranges::find(front, i) != front.end();
      bool beaten = false;
      for (const Record& other : records) {
        const auto a = errors_and_cycles(other), b = errors_and_cycles(records[i]);
        beaten = beaten || (a[0] <= b[0] && a[1] <= b[1] && (a[0] < b[0] || a[1] < b[1]));
      }
      EXPECT_NE(on_front, beaten);
    }
  }
}

}  // namespace
}  // namespace halfway::study
