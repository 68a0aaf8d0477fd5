// SPDX-License-Identifier: Apache-2.0
#include "sim/study/design_point.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::study {
namespace {

using ::testing::UnorderedElementsAre;

class SpaceTest : public FolderTest {
 protected:
  std::vector<DesignPoint> read(const std::string& text) const {
    return read_space(write("space.toml", text));
  }
  std::vector<std::string> designs_of(const std::string& text) const {
    std::vector<std::string> designs;
    for (const DesignPoint& point : read(text)) designs.push_back(point.design());
    return designs;
  }
};

TEST_F(SpaceTest, IsTheProductOfEachSweepsListsWithoutDuplicates) {
  // Preset and threshold are ignored for software. The threshold is ignored for methods that never split.
  const auto points = read(
      "[[sweep]]\nmethod = [\"gouraud\", \"quadratic\"]\npreset = [\"exact\", \"published\"]\n"
      "threshold = [1, 2]\nexponent = [5, 50]\n[[sweep]]\nmethod = \"gouraud\"\nexponent = 5\n");
  EXPECT_EQ(points.size(), 2 * (1U + 2U));
  std::set<std::string> names;
  for (const DesignPoint& point : points) names.insert(point.name());
  EXPECT_EQ(names.size(), points.size());
}

TEST_F(SpaceTest, PutsPointsOfAPictureTogether) {
  const auto points = read(
      "[[sweep]]\nmethod = \"gouraud\"\nexponent = [5, 50]\n[[sweep]]\nmethod = \"phong\"\nexponent = [50, "
      "5]\n");
  ASSERT_EQ(points.size(), 4U);
  EXPECT_EQ(points[0].picture(), points[1].picture());
  EXPECT_EQ(points[2].picture(), points[3].picture());
}

TEST_F(SpaceTest, IgnoresWordLengthsOfOtherMethods) {
  EXPECT_THAT(
      designs_of(
          "[[sweep]]\nmethod = [\"gouraud\", \"quadratic\", \"spherical\", \"processors-2\"]\n"
          "angle_bits = [22, 16]\nfraction_bits = [28, 20]\nseed_bits = [12, 8]\nnewton = [true, false]\n"),
      UnorderedElementsAre("gouraud", "quadratic exact", "quadratic exact fraction 20",
                           "spherical exact, threshold 2", "spherical exact angle 16, threshold 2",
                           "processors-2 exact", "processors-2 exact without Newton",
                           "processors-2 exact seed 8", "processors-2 exact seed 8 without Newton"));
}

// Tests and ends of other methods are ignored; the conservative test and the surface are the defaults.
TEST_F(SpaceTest, VariesTestsAndEndsOfTheMethodsThatHaveThem) {
  EXPECT_THAT(
      designs_of("[[sweep]]\nmethod = [\"phong-mesa\", \"quadratic\", \"adaptive\", \"spherical\"]\n"
                 "preset = [\"exact\", \"published\"]\n"
                 "highlight_test = [\"conservative\", \"centroid\"]\nspan_ends = [\"surface\", \"slerp\"]\n"),
      UnorderedElementsAre("phong-mesa", "quadratic exact", "quadratic published",
                           "adaptive exact, threshold 2", "adaptive exact centroid, threshold 2",
                           "adaptive published, threshold 2", "adaptive published centroid, threshold 2",
                           "spherical exact, threshold 2", "spherical exact slerp", "spherical published"));
}

// The full space varies every parameter of the other spaces, including all word lengths.
TEST(Spaces, VaryTheExpectedParameters) {
  const auto designs_of = [](const char* file) {
    std::set<std::string> designs;
    for (const DesignPoint& point : read_space(c_source_folder / "sim/study/spaces" / file))
      designs.insert(point.design());
    return designs;
  };
  EXPECT_THAT(designs_of("designs.toml"),
              ::testing::IsSupersetOf({"spherical exact 8x6, threshold 8", "spherical exact, threshold 8",
                                       "spherical published 4x4", "planes exact",
                                       "adaptive exact centroid, threshold 2", "phong-mesa"}));
  for (const char* file : {"words.toml", "small.toml"})
    EXPECT_THAT(designs_of("full.toml"), ::testing::IsSupersetOf(designs_of(file))) << file;
}

TEST_F(SpaceTest, EveryKeyIsARowOfThePage) {
  std::istringstream page(must(read_file(c_source_folder / "sim/study/spaces/README.md")));
  std::vector<std::string> documented, keys;
  bool in_table = false;
  for (std::string line; std::getline(page, line);) {
    in_table = line.starts_with("| key |") || (in_table && line.starts_with('|'));
    if (!in_table) continue;
    // The names in the first cell.
    std::istringstream cell(line.substr(1, line.find('|', 1) - 1));
    for (std::string word; std::getline(cell, word, '`') && std::getline(cell, word, '`');)
      documented.push_back(word);
  }
  for (const Knob& knob : knobs()) keys.emplace_back(knob.name);
  EXPECT_THAT(documented, ::testing::UnorderedElementsAreArray(keys));
}

TEST_F(SpaceTest, ErrorsNameFileAndLine) {
  const auto expect_error = [&](const std::string& text, const std::string& place_and_message) {
    EXPECT_TRUE(is_error(caught([&] { read(text); }), "space.toml" + place_and_message)) << text;
  };
  expect_error("", ": no sweep");
  expect_error("[[sweep]\n", ":1:");
  expect_error("[[sweep]]\nexponent = 5\n", ":1: method is missing");
  expect_error("[[sweep]]\nmethod = []\n", ":2: method is an empty list");
  expect_error("[[sweep]]\nmethod = \"quadratc\"\n", ":2: method takes phong");
  // Keys after the method.
  const std::array<const char*, 3> cases[] = {
      {"quadratic", "exponent = 0.5", ":3: exponent takes numbers from 1"},
      {"quadratic", "exponents = 5", ":3: exponents is not a key here"},
      {"quadratic", "fraction_bits = 60", ":3: fraction_bits takes numbers from 2 to 40"},
      {"quadratic", "size = \"4097x1\"",
       ":3: size takes WIDTHxHEIGHT in pixels, such as 640x480, each 1 to 4096"},
      {"quadratic", "size = \"large\"", ":3: size takes"},
      {"quadratic", "tile = \"15x100\"",
       ":3: tile takes WIDTHxHEIGHT in pixels, such as 640x480, each 16 to 4096"},
      {"adaptive", "highlight_test = \"most\"",
       ":3: highlight_test: 'most' is not one of its values; take none or centroid"},
      {"spherical", "span_ends = \"edges\"",
       ":3: span_ends: 'edges' is not one of its values; take surface or slerp"},
      {"spherical", "cosine = 9",
       ":3: cosine: '9' is not ADDRESSxDATA bits of the cosine tables, such as 9x8"},
      {"spherical", "cosine = \"9x13\"", ":3: cosine: '9x13' is not"},
      {"spherical", "own_tables = true", ":3: own_tables is only allowed with cosine"},
      {"spherical", "own_tables = 1", ":3: own_tables takes true or false"},
      {"spherical", "cosine = \"10x8\"\nangle_bits = 9", ":4: angle_bits must be 10 at least"},
      {"processors-2", "preset = \"published\"\nnewton = true", ":4: newton is only allowed in preset exact"},
      {"processors-2", "objects = 8\nsubpixels = 9", ":4: subpixels: 9 is not 1, 4 or 16"},
      {"processors-2", "subpixels = 4", ":3: subpixels goes with objects above 0"}};
  for (const auto& [method, keys, expected] : cases)
    expect_error(fmt::format("[[sweep]]\nmethod = \"{}\"\n{}\n", method, keys), expected);
}

TEST(DesignPoint, NameContainsAllParameters) {
  DesignPoint spherical{
      .method = Method::spherical, .hardware = {.tables = words::CosineSize{9, 8}}, .exponent = 50.0};
  spherical.host.quadratic.threshold = spherical.host.spherical.threshold = 4.0;
  DesignPoint own = spherical, published = spherical;
  own.own_tables = true;
  published.preset = Preset::published;
  const DesignPoint centroid{.method = Method::adaptive,
                             .preset = Preset::published,
                             .host = {.quadratic = {.test = HighlightTest::centroid}}},
      slerped{.method = Method::spherical, .host = {.spherical = {.ends = SpanEnds::slerped_along_edges}}},
      folded{
          .method = Method::processors_2, .hardware = {.form = ProcessorForm::folded}, .tessellation = 0.5},
      filtered{.method = Method::processors_2, .hardware = {.objects = 8, .subpixels = 16}};
  for (const auto& [point, name] :
       {std::pair{spherical, "spherical exact 9x8, threshold 4, 320x240, exponent 50"},
        {own, "spherical exact 9x8 own, threshold 4, 320x240, exponent 50"},
        {published, "spherical published 9x8, 320x240, exponent 50"},
        {centroid, "adaptive published centroid, threshold 2, 320x240"},
        {slerped, "spherical exact slerp, 320x240"},
        {folded, "processors-2 exact folded, 320x240, tessellation 0.5"},
        {filtered, "processors-2 exact objects 8 subpixels 16, 320x240, filtered"}})
    EXPECT_EQ(point.name(), name);
  EXPECT_EQ(centroid.setup().quadratic.test, HighlightTest::centroid);
  EXPECT_EQ(slerped.setup().spherical.ends, SpanEnds::slerped_along_edges);
}

// The tile appears in the name only if the frame is larger.
TEST_F(SpaceTest, CutsFramesThatAreLargerThanATile) {
  const auto points = read(
      "[[sweep]]\nmethod = \"quadratic\"\nsize = [\"4096x4096\", \"33x17\", \"1280x960\"]\n"
      "tile = [\"1280x960\", \"2048x4096\"]\n");
  std::vector<std::string> pictures;
  for (const DesignPoint& point : points)
    pictures.push_back(fmt::format("{}: {}", point.picture(), point.tiles().size()));
  EXPECT_THAT(pictures,
              UnorderedElementsAre("4096x4096 in tiles of 1280x960: 20", "4096x4096 in tiles of 2048x4096: 2",
                                   "33x17: 1", "1280x960: 1"));
}

}  // namespace
}  // namespace halfway::study
