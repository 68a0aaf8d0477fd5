// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/image.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/csv.hpp"
#include "sim/os/sanitizers.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/table.hpp"

namespace halfway::study {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;

std::string table_of(const Study& study) {
  return study_csv(study.provenance, study.records, {}, markets_of(study.records, {}, {}));
}

class StudyTest : public FolderTest {
 protected:
  void SetUp() override {
    settings_.scene = c_source_folder / "sim/study/spaces/sphere.toml";
    settings_.out = here();
    settings_.threads = 2;
    settings_.folders = c_checkout;
    for (const Method method : {Method::phong, Method::gouraud, Method::quadratic, Method::adaptive})
      settings_.points.push_back(
          {.method = method, .tessellation = 0.5, .exponent = 50.0, .size = {160, 120}});
  }
  Study study() const { return run_study(settings_); }
  /// A file of a point that the study keeps.
  template <class Point>
  std::filesystem::path file(const Provenance& of, const Point& point, const char* ending) const {
    return at("points") / (record_name(of, point) + ending);
  }
  StudySettings settings_;
};

TEST_F(StudyTest, MeasuresEachMethod) {
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
  EXPECT_GT(adaptive.counts.leaves, quadratic.counts.leaves);
}

TEST_F(StudyTest, ContinuesAfterAnInterruptionAndMeasuresOtherScenesAgain) {
  const Study first = study();
  EXPECT_EQ(study().measured, 0U);
  // Remove one point's figures and another point's frame; damage a third point's figures.
  EXPECT_TRUE(std::filesystem::remove(file(first.provenance, settings_.points[0], ".json")));
  EXPECT_TRUE(std::filesystem::remove(file(first.provenance, settings_.points[1], ".png")));
  write(file(first.provenance, settings_.points[2], ".json"), "{");
  const Study again = study();
  EXPECT_EQ(again.measured, 3U);
  EXPECT_EQ(table_of(again), table_of(first));
  settings_.scene = "matte";
  EXPECT_EQ(study().measured, 4U);
}

// Drawing in tiles gives the same figures as drawing the whole frame, except for the clocks of the hardware.
class TiledStudyTest : public StudyTest {
 protected:
  void SetUp() override {
    StudyTest::SetUp();
    for (DesignPoint& point : settings_.points) point.size = {64, 48};
    whole_ = study();
    for (DesignPoint& point : settings_.points) point.tile = {37, 29};
  }
  // All figures except those that differ for tiles.
  static std::string figures(Record record) {
    record.measured.cycles = 0;
    std::string text;
    for_each_figure(record.measured, [&](const char* name, const auto& value) {
      text += fmt::format("{} {}, ", name, ::testing::PrintToString(value));
    });
    return text;
  }
  void expect_whole(const Study& tiled) const {
    ASSERT_EQ(tiled.records.size(), whole_.records.size());
    for (std::size_t i = 0; i < tiled.records.size(); ++i) {
      EXPECT_EQ(figures(tiled.records[i]), figures(whole_.records[i]));
      EXPECT_EQ(picture(tiled, i), picture(whole_, i));
      EXPECT_GE(tiled.records[i].measured.cycles, whole_.records[i].measured.cycles);
    }
  }
  std::vector<std::uint8_t> picture(const Study& of, std::size_t point) const {
    return must(read_png(file(of.provenance, of.records[point].point, ".png"))).rgb;
  }
  Study whole_;
};

// A study that was interrupted before any point was assembled.
class InterruptedStudyTest : public TiledStudyTest {
 protected:
  void SetUp() override {
    TiledStudyTest::SetUp();
    // Each part has a point's tiles. Part 0, with the reference's tiles, runs last.
    settings_.parts = settings_.points.size();
    for (settings_.part = settings_.parts; settings_.part-- > 0;) study();
    settings_.part = 0;
    settings_.parts = 1;
    for (const char* ending : {".json", ".png"})
      ASSERT_TRUE(std::filesystem::remove(tile_file(settings_.points[0].name(), ending)));
    std::filesystem::copy(at("points"), at("tiles"));
    table_ = table_of(study());
    restore();
  }
  void restore() const {
    std::filesystem::remove_all(at("points"));
    std::filesystem::copy(at("tiles"), at("points"));
  }
  std::filesystem::path tile_file(const std::string& name, const char* ending) const {
    return file(whole_.provenance, name, ending);
  }
  void expect_anew(std::size_t tiles) const {
    const Study again = study();
    EXPECT_EQ(again.drawn_tiles, tiles);
    EXPECT_EQ(again.measured, 4U);
    EXPECT_EQ(table_of(again), table_);
    expect_whole(again);
  }
  const std::string drawing_ = "quadratic exact, 64x48 in tiles of 37x29, tessellation 0.5, exponent 50",
                    reference_ = "reference, 64x48 in tiles of 37x29, tessellation 0.5, exponent 50";
  std::string table_;
};

// Only lost tiles are drawn again. A study stops at a damaged tile, and draws it again when it is removed.
TEST_F(InterruptedStudyTest, ContinuesTileByTile) {
  EXPECT_TRUE(std::filesystem::remove(tile_file(drawing_, "-tile-1.json")));
  EXPECT_TRUE(std::filesystem::remove(tile_file(drawing_, "-tile-2-mask.png")));
  EXPECT_TRUE(std::filesystem::remove(tile_file(reference_, "-tile-0.png")));
  expect_anew(3);
  const auto expect_refused = [&](const std::filesystem::path& tile, const std::string& message) {
    const auto made = caught([&] { return study(); });
    EXPECT_TRUE(is_error(made, ExitCode::bad_input, tile.string() + message));
    EXPECT_TRUE(is_error(made, "; remove it"));
    restore();
  };
  restore();
  for (const auto& [tile, size] : {std::pair{tile_file(drawing_, "-tile-0.png"), FrameSize{37, 8}},
                                   {tile_file(reference_, "-tile-0-mask.png"), {64, 48}}}) {
    ASSERT_TRUE(write_png(tile, Frame(size)));
    expect_refused(tile, fmt::format(": {}, but the tile has 37x29", to_string(size)));
  }
  const std::filesystem::path figures = tile_file(drawing_, "-tile-1.json");
  for (const char* text : {"{", "{}", R"({"hardware": "quadratic", "fragments": "many"})"}) {
    write(figures, text);
    expect_refused(figures, ": [json.exception.");
  }
}

// Drawings are removed after assembly. The reference's tiles stay for later points; losing them does no harm.
TEST_F(InterruptedStudyTest, KeepsOnlyTheReferencesTiles) {
  expect_anew(0);
  std::size_t left = 0;
  for (const auto& entry : std::filesystem::directory_iterator(at("points")))
    left += entry.path().filename().string().find("-tile-") != std::string::npos;
  EXPECT_EQ(left, 4U * 3U);
  EXPECT_TRUE(std::filesystem::remove(tile_file(reference_, "-tile-3.json")));
  Study again = study();
  EXPECT_EQ(again.drawn_tiles + again.measured, 0U);
  EXPECT_TRUE(std::filesystem::remove(tile_file(drawing_, ".json")));
  again = study();
  EXPECT_EQ(again.drawn_tiles, 5U);
  EXPECT_EQ(again.measured, 1U);
  EXPECT_EQ(table_of(again), table_);
}

TEST_F(TiledStudyTest, PartsDrawTilesAndTheLastOneAssembles) {
  settings_.parts = 5;
  std::size_t drawn = 0;
  const auto run_parts = [&](const std::vector<std::size_t>& parts) {
    std::size_t measured = 0;
    for (const std::size_t part : parts) {
      settings_.part = part;
      const Study made = study();
      drawn += made.drawn_tiles;
      measured += made.measured;
    }
    return measured;
  };
  // The reference comes last, so no point can be assembled before.
  EXPECT_EQ(run_parts({1, 2, 3, 4}), 0U);
  EXPECT_THAT(open_parts(settings_), ::testing::ElementsAre(0U, 1U, 2U, 3U, 4U));
  run_parts({0});
  EXPECT_EQ(drawn, 4U * 4U);  // tiles of the reference and of all methods except phong
  const std::vector<std::size_t> open = open_parts(settings_);
  EXPECT_FALSE(open.empty());
  run_parts(open);
  EXPECT_EQ(drawn, 4U * 4U);
  EXPECT_TRUE(open_parts(settings_).empty());
  settings_.part = 0;
  settings_.parts = 1;
  const Study all = study();
  EXPECT_EQ(all.measured + all.drawn_tiles, 0U);
  expect_whole(all);
  EXPECT_THAT(all.records[2].point.name(), HasSubstr("64x48 in tiles of 37x29"));
  EXPECT_THAT(table_of(all), HasSubstr(",4,,,,,\n"));
}

TEST_F(StudyTest, ReportsThePointThatFails) {
  settings_.scene = "lights";
  settings_.points = {{.method = Method::processors_1, .preset = Preset::published}};
  const auto made = caught([&] { return study(); });
  EXPECT_TRUE(is_error(made, ExitCode::bad_input, "processors-1 published"));
  EXPECT_TRUE(is_error(made, ExitCode::bad_input, "version II"));
}

// Draw with table sizes and word lengths that are not compiled in, in setup, golden model and RTL: words of
// 16 bits with 4 fraction bits. measure() compares each fragment.
TEST_F(StudyTest, DrawsWithTablesAndWordsOfAnySize) {
  settings_.points.clear();
  for (const auto size : {std::optional<words::CosineSize>{}, std::optional(words::CosineSize{5, 4}),
                          std::optional(words::CosineSize{3, 2})})
    settings_.points.push_back({.method = Method::spherical, .hardware = {.tables = size}});
  for (const auto bits : {std::optional<int>{}, std::optional(4)})
    settings_.points.push_back({.method = Method::quadratic, .words = {.fraction_bits = bits}});
  for (DesignPoint& point : settings_.points) point.tessellation = 0.5, point.size = {160, 120};
  const Study made = study();
  ASSERT_EQ(made.records.size(), 5U);
  const char* const hardware[] = {"rom9x8", "rom5x4", "rom3x2", "quadratic", "-fraction4"};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_THAT(made.records[i].measured.hardware, HasSubstr(hardware[i]));
    if (i == 0 || i == 3) continue;
    const Measurement &finer = made.records[i - 1].measured, &coarser = made.records[i].measured;
    EXPECT_LT(finer.picture.rms, coarser.picture.rms);
    EXPECT_EQ(finer.fragments, coarser.fragments);
  }
  EXPECT_EQ(made.records[3].measured.counts.shaded, made.records[4].measured.counts.shaded);
  EXPECT_THAT(table_of(made), HasSubstr(",,4,,,1,,,,,\n"));
}

// Filtered pictures are compared with a filtered reference. Too few object processors are refused, and tiles.
TEST_F(StudyTest, DrawsBehindObjectProcessors) {
  DesignPoint point{
      .method = Method::processors_2, .hardware = {.objects = 6, .subpixels = 4}, .tessellation = 0.3};
  point.size = {64, 48};
  settings_.points = {point};
  const Measurement measured = study().records.at(0).measured;
  EXPECT_LT(measured.picture.rms, 4.0);
  EXPECT_THAT(measured.hardware, EndsWith("-o6x4"));
  settings_.points[0].tessellation = 4.0;
  EXPECT_TRUE(is_error(caught([&] { return study(); }), ExitCode::bad_input, "the hardware has 6 object"));
  point.tile = {32, 24};
  EXPECT_THAT(drawable({point}, settings_.scene, settings_.folders).reasons,
              ::testing::ElementsAre(HasSubstr("filtered frames are not drawn in tiles")));
}

TEST_F(StudyTest, RtlWithOtherTablesThanTheGoldenModelsIsFound) {
  const DesignPoint point{
      .method = Method::spherical, .hardware = {.tables = words::CosineSize{5, 4}}, .size = {160, 120}};
  // Change one entry of the cached tables that the study will use.
  const auto folder = tables::rtl_with(true, words::CosineSize{5, 4}, {}, c_source_folder, here());
  replace_in(folder / "rtl/tables/cosine_pkg.vhd", "15", "14", "constant c_exact_cosine_1_5x4");
  settings_.folders.cache = here();
  settings_.points = {point};
  EXPECT_TRUE(
      is_error(caught([&] { return study(); }), ExitCode::differs, "the RTL differs from the golden model"));
}

TEST_F(StudyTest, OmitsPointsThatCannotDrawTheScene) {
  const std::vector<DesignPoint> points = {{.method = Method::gouraud},
                                           {.method = Method::processors_1, .preset = Preset::published},
                                           {.method = Method::processors_2, .preset = Preset::published}};
  const Drawable all = drawable(points, "matte", settings_.folders);
  EXPECT_EQ(all.points.size(), 3U);
  ASSERT_EQ(all.hardware.size(), 2U);
  EXPECT_EQ(all.hardware[1].method, Method::processors_2);
  EXPECT_EQ(all.left_out, 0U);
  const Drawable some = drawable(points, "lights", settings_.folders);
  ASSERT_EQ(some.points.size(), 2U);
  EXPECT_EQ(some.hardware.size(), 1U);
  EXPECT_EQ(some.points[1].method, Method::processors_2);
  EXPECT_EQ(some.left_out, 1U);
  ASSERT_EQ(some.reasons.size(), 1U);
  EXPECT_THAT(some.reasons[0], HasSubstr("processors-1: lights: version I"));
}

// Mesa's picture of the design's scene, size, tessellation and exponent, whole and in tiles.
TEST_F(StudyTest, MesaDrawsThePicture) {
  ASSERT_EQ(mesa_lacks(settings_.folders.source), "");
  DesignPoint point{.method = Method::phong_mesa, .tessellation = 0.5, .exponent = 5.0, .size = {160, 120}};
  settings_.points = {point};
  point.tile = {96, 64};
  settings_.points.push_back(point);
  const Study made = study();
  ASSERT_EQ(made.records.size(), 2U);
  for (const Record& record : made.records) {
    const Measurement& m = record.measured;
    EXPECT_TRUE(m.hardware.empty());
    // Equal but for outlines: other subpixels.
    EXPECT_GT(m.picture.psnr_db, 25.0) << record.point.name();
    EXPECT_LE(m.highlight.max_lsb, 1) << record.point.name();
    EXPECT_GT(m.highlight.pixels, 100U);
  }
  EXPECT_EQ(made.records[0].measured.picture.rms, made.records[1].measured.picture.rms);
  EXPECT_GT(host_time(settings_.points[0], settings_.scene, settings_.folders).ns, 0);
  // Scenes that it does not draw are left out.
  const Drawable shadows = drawable({point}, "shadows", settings_.folders);
  EXPECT_EQ(shadows.left_out, 1U);
  ASSERT_EQ(shadows.reasons.size(), 1U);
  EXPECT_THAT(shadows.reasons[0], HasSubstr("phong-mesa: halfway_mesa draws no shadows"));
}

TEST_F(StudyTest, TheTableContainsTheFront) {
  const Study made = study();
  const Measurement& quadratic = made.records[2].measured;
  HardwareTable hardware;
  synth::Cost& figures = hardware[quadratic.hardware];
  figures.cells = Cells{.luts = 100, .flip_flops = 20};
  figures.mhz = 80.0;
  figures.clock = "stored";
  figures.tools = "cells by Tool 1";
  const auto markets = markets_of(made.records, hardware, {});
  const Table table =
      must(read_csv(write("study.csv", study_csv(made.provenance, made.records, hardware, markets))));
  ASSERT_EQ(table.rows.size(), made.records.size());
  // The line names the tools that made its figures.
  EXPECT_EQ(table.text(0, "tools"), made.provenance.tools);
  EXPECT_EQ(table.text(2, "tools"), made.provenance.tools + ", cells by Tool 1");
  for (const char* column : {"luts", "front", "clock_mhz", "clock", "frame_ns"})
    EXPECT_EQ(table.text(0, column), "");
  EXPECT_EQ(table.text(0, "record"), record_name(made.provenance, made.records[0].point));
  const double cycles = static_cast<double>(quadratic.cycles),
               fragments = static_cast<double>(quadratic.fragments);
  const std::pair<const char*, std::string> values[] = {
      {"luts", "100"},
      {"flip_flops", "20"},
      {"cells", "120"},
      {"front", "1"},
      {"clock_mhz", "80.0"},
      {"clock", "stored"},
      {"cycles_a_fragment", fmt::format("{:.6g}", cycles / fragments)},
      {"frame_ns", fmt::format("{:.6g}", 12.5 * cycles)},
      {"fragment_ns", fmt::format("{:.6g}", 12.5 * cycles / fragments)},
      {"tiles", "1"}};
  for (const auto& [column, value] : values) EXPECT_EQ(table.text(2, column), value) << column;
  EXPECT_THAT(table.columns, ::testing::IsSupersetOf({"angle_bits", "highlight_test", "own_tables", "objects",
                                                      "subpixels", "device_multipliers"}));
}

TEST_F(StudyTest, CountsTheHostsInstructions) {
  ASSERT_FALSE(find_program("valgrind").empty()) << "no Valgrind: " << c_install_valgrind;
  if (c_sanitized) GTEST_SKIP() << "Valgrind cannot run a program built with sanitizers";
  const auto space =
      write("space.toml", "[[sweep]]\nmethod = [\"quadratic\", \"adaptive\"]\nsize = \"160x120\"\n");
  const auto points = read_space(space);
  settings_.points = points;
  settings_.set_up = {HALFWAY_PROGRAM, "study", "--space", space.string()};
  const Study made = study();
  ASSERT_EQ(made.records.size(), 2U);
  const auto of = [](const Record& record) { return record.measured.host_instructions; };
  ASSERT_TRUE(of(made.records[0]) && of(made.records[1]));
  EXPECT_GT(of(made.records[1]), of(made.records[0]));
  // The counts do not depend on the order of the points.
  const auto again = host_instructions(settings_.set_up, {points.at(1).name(), points.at(0).name()}, here());
  EXPECT_EQ(again->at(0), of(made.records[1]));
  EXPECT_EQ(again->at(1), of(made.records[0]));
  EXPECT_THROW(host_instructions(settings_.set_up, {"no such point"}, here()), Failure);
  // The count is stored with the record.
  settings_.set_up.clear();
  EXPECT_EQ(of(study().records[1]), of(made.records[1]));
}

}  // namespace
}  // namespace halfway::study
