// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "common/test/is_error.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/image.hpp"
#include "sim/generator/word_lengths/made_tables.hpp"
#include "sim/os/sanitizers.hpp"
#include "sim/os/subprocess.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/test_files.hpp"
#include "sim/study/figures.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/table.hpp"

namespace halfway::study {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;

std::string table_of(const Study& study) {
  return to_csv(study.provenance, study.records, {}, markets_of(study.records, {}, {}));
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

TEST_F(StudyTest, ContinuesAfterAnInterruption) {
  const std::string first = table_of(study());
  EXPECT_EQ(study().measured, 0U);
  // Remove one point's figures and another point's frame.
  const Provenance provenance = study().provenance;
  EXPECT_TRUE(std::filesystem::remove(file(provenance, settings_.points[0], ".json")));
  EXPECT_TRUE(std::filesystem::remove(file(provenance, settings_.points[1], ".png")));
  const Study again = study();
  EXPECT_EQ(again.measured, 2U);
  EXPECT_EQ(table_of(again), first);
}

TEST_F(StudyTest, MeasuresUnreadablePointsAndOtherScenesAgain) {
  const std::string table = table_of(study());
  write(file(study().provenance, settings_.points[0], ".json"), "{");
  const Study again = study();
  EXPECT_EQ(again.measured, 1U);
  EXPECT_EQ(table_of(again), table);
  settings_.scene = "matte";
  EXPECT_EQ(study().measured, 4U);
}

TEST_F(StudyTest, PartsTogetherEqualTheWhole) {
  settings_.parts = 3;
  std::vector<std::string> names;
  for (settings_.part = 0; settings_.part < settings_.parts; ++settings_.part)
    for (const Record& record : study().records) names.push_back(record.point.name());
  std::vector<std::string> all;
  for (const DesignPoint& point : settings_.points) all.push_back(point.name());
  EXPECT_EQ(names, all);
  EXPECT_TRUE(open_parts(settings_).empty());
  std::filesystem::remove_all(at("points"));
  settings_.part = 1;
  study();
  EXPECT_THAT(open_parts(settings_), ::testing::ElementsAre(0U, 2U));
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

TEST_F(TiledStudyTest, TilesTogetherEqualTheWhole) {
  const Study tiled = study();
  EXPECT_EQ(tiled.measured, 4U);
  EXPECT_EQ(tiled.drawn_tiles, 4U * 4U);  // tiles of the reference and of all methods except phong
  expect_whole(tiled);
  EXPECT_THAT(tiled.records[2].point.name(), HasSubstr("64x48 in tiles of 37x29"));
  EXPECT_THAT(table_of(tiled), HasSubstr(",4,,,,,\n"));
  EXPECT_THAT(table_of(whole_), Not(HasSubstr(",4,,,,,\n")));
}

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

// Only lost tiles are drawn again.
TEST_F(InterruptedStudyTest, ContinuesTileByTile) {
  EXPECT_TRUE(std::filesystem::remove(tile_file(drawing_, "-tile-1.json")));
  EXPECT_TRUE(std::filesystem::remove(tile_file(drawing_, "-tile-2-mask.png")));
  EXPECT_TRUE(std::filesystem::remove(tile_file(reference_, "-tile-0.png")));
  expect_anew(3);
}

// A study stops at a damaged tile, and draws it again when it is removed.
TEST_F(InterruptedStudyTest, RefusesTilesOfAnotherSize) {
  const std::pair<std::filesystem::path, FrameSize> cases[] = {
      {tile_file(drawing_, "-tile-0.png"), {37, 8}}, {tile_file(reference_, "-tile-0-mask.png"), {64, 48}}};
  for (const auto& [tile, size] : cases) {
    ASSERT_TRUE(write_png(tile, Frame(size)));
    EXPECT_TRUE(
        is_error(caught([&] { return study(); }), ExitCode::bad_input,
                 fmt::format("{}: {}, but the tile has 37x29; remove it", tile.string(), to_string(size))));
    restore();
    EXPECT_TRUE(std::filesystem::remove(tile));
    expect_anew(1);
    restore();
  }
}

TEST_F(InterruptedStudyTest, RefusesTilesWithoutFigures) {
  const std::filesystem::path figures = tile_file(drawing_, "-tile-1.json");
  for (const char* text : {"{", "{}", R"({"hardware": "quadratic", "fragments": "many"})"}) {
    write(figures, text);
    const auto made = caught([&] { return study(); });
    EXPECT_TRUE(is_error(made, ExitCode::bad_input, figures.string() + ": [json.exception."));
    EXPECT_TRUE(is_error(made, ExitCode::bad_input, "; remove it"));
  }
  restore();
  EXPECT_TRUE(std::filesystem::remove(figures));
  expect_anew(1);
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
    for (settings_.part = 0; settings_.part < settings_.parts; ++settings_.part) {
      if (std::ranges::find(parts, settings_.part) == parts.end()) continue;
      const Study part = study();
      drawn += part.drawn_tiles;
      measured += part.measured;
    }
    return measured;
  };
  // Run the parts backwards. The reference comes last, so no point can be assembled before.
  EXPECT_EQ(run_parts({1, 2, 3, 4}), 0U);
  EXPECT_THAT(open_parts(settings_), ::testing::ElementsAre(0U, 1U, 2U, 3U, 4U));
  run_parts({0});
  EXPECT_EQ(drawn, 4U * 4U);
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
}

TEST_F(StudyTest, ReportsThePointThatFails) {
  settings_.scene = "lights";
  settings_.points = {{.method = Method::processors_1, .preset = Preset::published}};
  const auto made = caught([&] { return study(); });
  EXPECT_TRUE(is_error(made, ExitCode::bad_input, "processors-1 published"));
  EXPECT_TRUE(is_error(made, ExitCode::bad_input, "version II"));
}

// Draw with table sizes that are not compiled in, in RTL and golden model. measure() compares each fragment.
TEST_F(StudyTest, DrawsWithTablesOfAnySize) {
  settings_.points.clear();
  for (const auto size : {std::optional<words::CosineSize>{}, std::optional(words::CosineSize{5, 4}),
                          std::optional(words::CosineSize{3, 2})})
    settings_.points.push_back(
        {.method = Method::spherical, .hardware = {.tables = size}, .tessellation = 0.5, .size = {160, 120}});
  const Study made = study();
  ASSERT_EQ(made.records.size(), 3U);
  const Measurement &usual = made.records[0].measured, &coarse = made.records[1].measured,
                    &least = made.records[2].measured;
  EXPECT_THAT(usual.hardware, HasSubstr("rom9x8"));
  EXPECT_THAT(coarse.hardware, HasSubstr("rom5x4"));
  EXPECT_THAT(least.hardware, HasSubstr("rom3x2"));
  EXPECT_LT(usual.picture.rms, coarse.picture.rms);
  EXPECT_LT(coarse.picture.rms, least.picture.rms);
  EXPECT_EQ(usual.fragments, least.fragments);
}

// Draw with word lengths that are not compiled in, in setup, golden model and RTL: 16 bits with 4 fraction
// bits.
TEST_F(StudyTest, DrawsWithWordsOfAnyLength) {
  settings_.points = {
      {.method = Method::quadratic, .tessellation = 0.5, .size = {160, 120}},
      {.method = Method::quadratic, .words = {.fraction_bits = 4}, .tessellation = 0.5, .size = {160, 120}}};
  const Study made = study();
  ASSERT_EQ(made.records.size(), 2U);
  const Measurement &usual = made.records[0].measured, &coarse = made.records[1].measured;
  EXPECT_THAT(coarse.hardware, EndsWith("-fraction4"));
  EXPECT_LT(usual.picture.rms, coarse.picture.rms);
  EXPECT_EQ(usual.fragments, coarse.fragments);
  EXPECT_EQ(usual.counts.shaded, coarse.counts.shaded);
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
  settings_.points.push_back({.method = Method::gouraud, .size = {160, 120}});
  const Study made = study();
  HardwareTable hardware;
  synth::Cost& figures = hardware[made.records[2].measured.hardware];
  figures.cells = Cells{.luts = 100, .flip_flops = 20};
  figures.mhz = 80.0;
  figures.clock = "stored";
  figures.tools = "cells by Tool 1";
  std::vector<std::string> lines;
  std::istringstream stream(
      to_csv(made.provenance, made.records, hardware, markets_of(made.records, hardware, {})));
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 1 + made.records.size());
  EXPECT_THAT(
      lines[0],
      HasSubstr(",host_instructions,luts,flip_flops,memory_bits,multipliers,product_bits,cells,front,"
                "cycles_a_fragment,host_instructions_a_triangle,record,multiplier_luts,clock_mhz,clock,"
                "frame_ns,fragment_ns,device,device_luts,device_carries,device_flip_flops,device_rams,"
                "device_multipliers,"
                "angle_bits,fraction_bits,seed_bits,newton,tiles,highlight_test,span_ends,own_tables,"
                "objects,subpixels"));
  EXPECT_THAT(lines[1], HasSubstr(",,,,,,,,,,," + record_name(made.provenance, made.records[0].point) +
                                  ",,,,,,,,,,,,,,,,1,,,,,"));
  EXPECT_THAT(lines[3], HasSubstr(",100,20,0,0,0,120,1,1."));
  // The line names the tools that made its figures.
  EXPECT_THAT(lines[1], HasSubstr(",\"" + made.provenance.tools + "\","));
  EXPECT_THAT(lines[3], HasSubstr(",\"" + made.provenance.tools + ", cells by Tool 1\","));
  const auto cycles = static_cast<double>(made.records[2].measured.cycles),
             fragments = static_cast<double>(made.records[2].measured.fragments);
  EXPECT_THAT(lines[3], EndsWith(fmt::format(",0,80.0,\"stored\",{:.6g},{:.6g},,,,,,,,,,,1,,,,,",
                                             12.5 * cycles, 12.5 * cycles / fragments)));
  EXPECT_THAT(lines[4], HasSubstr(",100,20,0,0,0,120,1,1."));
  const auto commas = [](const std::string& line) {
    bool quoted = false;
    return std::ranges::count_if(line, [&](char c) { return (quoted ^= c == '"', c == ',' && !quoted); });
  };
  for (const std::string& line : lines) EXPECT_EQ(commas(line), commas(lines[0])) << line;
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
