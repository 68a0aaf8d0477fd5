// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/pinned.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "common/test/is_error.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/page_part.hpp"

namespace halfway::synth {
namespace {

using ::testing::HasSubstr;

constexpr Ice40Cells c_cells{.luts = 200, .carries = 39, .flip_flops = 40, .rams = 1};

TEST(SynthPins, SayWhatIsNotAsPinned) {
  const Pins pins = {{"a", {.cells = c_cells, .mhz = 100, .line = 7}}, {"unplaced", {.cells = c_cells}}};
  EXPECT_EQ(compare("a", pins, c_cells, 100), "");
  EXPECT_EQ(compare("a", pins, c_cells, {}), "");
  EXPECT_EQ(compare("unplaced", pins, c_cells, 0), "");
  EXPECT_THAT(compare("b", pins, c_cells, 100), HasSubstr("nothing is pinned"));
  const auto with = [&](std::uint64_t luts, std::uint64_t carries, std::uint64_t flip_flops,
                        std::uint64_t rams) {
    return compare("a", pins, {luts, carries, flip_flops, rams}, {});
  };
  EXPECT_EQ(with(206, 42, 40, 1), "");
  EXPECT_EQ(with(194, 36, 40, 1), "");
  EXPECT_EQ(
      with(207, 39, 40, 1),
      "tb/synth/pinned.txt:7: a: 207 LUTs, 200 are pinned, and 6 more or fewer may be; make synth DESIGN=a "
      "PIN=1 pins what it is now\n");
  EXPECT_THAT(with(193, 39, 40, 1), HasSubstr("LUTs"));
  EXPECT_THAT(with(200, 43, 40, 1), HasSubstr("carries"));
  EXPECT_THAT(with(200, 39, 41, 1), HasSubstr("41 flip-flops, 40 are pinned"));
  EXPECT_THAT(with(200, 39, 39, 1), HasSubstr("flip-flops"));
  EXPECT_THAT(with(200, 39, 40, 2), HasSubstr("RAMs"));
  EXPECT_EQ(compare("a", pins, c_cells, 92.5), "");
  EXPECT_EQ(compare("a", pins, c_cells, 107.5), "");
  EXPECT_THAT(compare("a", pins, c_cells, 91.5), HasSubstr("slower"));
  EXPECT_THAT(compare("a", pins, c_cells, 108.5), HasSubstr("faster"));
  EXPECT_THAT(compare("a", pins, c_cells, 0), HasSubstr("no clock, 100.0 MHz are pinned"));
  EXPECT_THAT(compare("unplaced", pins, c_cells, 100), HasSubstr("100.0 MHz, and no clock is pinned"));
}

TEST(SynthPins, ComeBackFromTheirFile) {
  auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const auto path = folder.path() / "pinned.txt";
  const std::string hash = "0123456789abcdef0123456789abcdef";
  ASSERT_TRUE(write_pins(path,
                         {{"a", {c_cells, 123.4, hash}},
                          {"b", {{1, 2, 3, 4}, 0}},
                          {"c", {.cells = c_cells, .mhz = 99, .netlist = hash, .seeds = 1}}},
                         "Yosys 0.23"));
  const auto pins = must(read_pins(path));
  ASSERT_EQ(pins.size(), 3U);
  EXPECT_EQ(pins.at("a").cells, c_cells);
  EXPECT_EQ(pins.at("a").mhz, 123.4);
  EXPECT_EQ(pins.at("a").netlist, hash);
  EXPECT_EQ(pins.at("a").seeds, c_seeds);
  EXPECT_EQ(pins.at("c").netlist, hash);
  EXPECT_EQ(pins.at("c").seeds, 1U);
  EXPECT_EQ(pins.at("b").netlist, "");
  EXPECT_EQ(pins.at("b").line, pins.at("a").line + 1);
  EXPECT_EQ(pins.at("b").cells, (Ice40Cells{1, 2, 3, 4}));
  EXPECT_EQ(*pin_versions(path), "Yosys 0.23");
  auto text = must(read_file(path));
  const std::size_t flow = text.find("flow " + flow_hash() + "\n");
  ASSERT_NE(flow, std::string::npos);
  std::string other = text, none = text;
  other[flow + 5] ^= 1;
  none.erase(flow, text.find('\n', flow) + 1 - flow);
  for (const std::string& another : {other, none}) {
    ASSERT_TRUE(write_file(path, another));
    const auto read = must(read_pins(path));
    EXPECT_EQ(read.at("a").netlist, "");
    EXPECT_EQ(read.at("a").mhz, 123.4);
  }
  for (const std::string& wrong : std::initializer_list<std::string>{
           "flow 2\n", "flow\n", "a 1 2 3 4\n", "a 1 2 3 4 5 6\n", "a 1 2 3 4 5 " + hash + " 6 7\n",
           "a 1 2 3 4 5 " + hash + " 0\n", "a 1 2 3 4 5 " + hash + " 3x\n", "a 1 2 3 x 5\n",
           "a 1 2 3 4 5\na 1 2 3 4 5\n"}) {
    ASSERT_TRUE(write_file(path, wrong));
    EXPECT_TRUE(is_error(read_pins(path), "pinned.txt:")) << wrong;
  }
}

TEST(SynthPins, HaveWhatThePapersPrintBeside) {
  EXPECT_EQ(published_ns("quadratic_shader_grey_exact"), 50);
  EXPECT_EQ(published_ns("spherical_shader_published"), 60);
  EXPECT_EQ(published_ns("shading_processor_diffuse_published"), 50);
  EXPECT_FALSE(published_ns("unrolled_shading_processor_diffuse_published"));
  EXPECT_FALSE(published_ns("accumulator_24"));
}

// Otherwise a study would have no clocks.
TEST(SynthPins, AreOfTheFlowAsItIs) {
  const auto pins = must(read_pins(std::filesystem::path(HALFWAY_SOURCE_DIR) / c_pins));
  EXPECT_TRUE(std::ranges::any_of(pins, [](const auto& pin) { return !pin.second.netlist.empty(); }))
      << "of another flow than " << flow_hash() << ": make synth PIN=1";
}

TEST(SynthPins, AreWhatThePageSays) {
  const std::filesystem::path root = HALFWAY_SOURCE_DIR;
  const auto pins = must(read_pins(root / c_pins));
  const auto clocks = must(readme_clocks(pins));
  const auto readme = must(read_file(root / "docs/performance.md"));
  const auto part = must(page_part(readme, "clocks"));
  EXPECT_EQ(part, clocks) << "make synth PIN=1 writes it";
}

TEST(SynthPins, AllHaveAClockThatThePageShows) {
  const auto pins = must(read_pins(std::filesystem::path(HALFWAY_SOURCE_DIR) / c_pins));
  Pins others = pins;
  others.at("accumulator_40").mhz = 0;
  EXPECT_FALSE(readme_clocks(others));
  others = pins;
  others.erase("spherical_shader_exact");
  EXPECT_TRUE(is_error(readme_clocks(others), "spherical_shader_exact: not pinned"));
  EXPECT_FALSE(readme_clocks({}));
  others = pins;
  others.at("accumulator_40").seeds = 1;
  const auto few = must(readme_clocks(others));
  EXPECT_THAT(few, HasSubstr("the median of 1 to "));
}

}  // namespace
}  // namespace halfway::synth
