// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/clock_store.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

TEST(ClockStore, ReadsWhatItWrites) {
  const auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
  ASSERT_TRUE(folder) << folder.error().message;
  const std::filesystem::path root = folder->path();
  const std::filesystem::path file = root / clocks_file(c_ice40);
  EXPECT_EQ(clocks_file(c_ice40), "docs/results/clocks_hx8k.csv");
  EXPECT_TRUE(read_clocks(root, c_ice40)->empty());
  ASSERT_TRUE(make_folders(file.parent_path()));
  ASSERT_TRUE(write_clocks(root, c_ice40,
                           {{"a",
                             {.cells = {1, 2, 3, 4},
                              .mhz = 87.54,
                              .seeds = 3,
                              .range = "80 to 90 of 3",
                              .path = "`r.x` → `r.y`, 3 LUTs",
                              .tools = "GHDL 2, Yosys 1",
                              .netlist = "ab",
                              .hardware = "e g_a=1"}},
                            {"large", {.cells = {5, 6, 7, 8}, .netlist = "cd"}}}));
  const auto clocks = read_clocks(root, c_ice40);
  ASSERT_TRUE(clocks) << clocks.error().message;
  ASSERT_EQ(clocks->size(), 2U);
  const StoredClock& a = clocks->at("a");
  EXPECT_EQ(a.cells, (Cells{1, 2, 3, 4}));
  EXPECT_EQ(a.mhz, 87.5);
  EXPECT_EQ(a.seeds, 3U);
  EXPECT_EQ(a.range, "80 to 90 of 3");
  EXPECT_EQ(a.path, "`r.x` → `r.y`, 3 LUTs");
  EXPECT_EQ(a.tools, "GHDL 2, Yosys 1");
  EXPECT_EQ(a.netlist, "ab");
  EXPECT_EQ(a.hardware, "e g_a=1");
  EXPECT_EQ(clocks->at("large").mhz, 0);
  EXPECT_EQ(clock_of(*clocks, "cd")->first, "large");
  for (const char* other : {"aa", "bc", "ef"}) EXPECT_EQ(clock_of(*clocks, other), clocks->end()) << other;

  // The netlists of one GHDL are compared.
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=1", "GHDL 5")->first, "a");
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=1", "GHDL 2"), clocks->end());
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=2", "GHDL 5"), clocks->end());

  const auto text = read_file(file);
  ASSERT_TRUE(text);
  for (const char* line : {"a,1,2,3,4,5,6,,,,ef,\n", "b,1,2,x,4,5,6,,,,ef,\n", "b,1,2,-3,4,5,6,,,,ef,\n",
                           "b,1,2,3,4,5,6,,,,,\n"}) {
    ASSERT_TRUE(write_file(file, *text + line));
    const auto wrong = read_clocks(root, c_ice40);
    ASSERT_FALSE(wrong) << line;
    EXPECT_THAT(wrong.error().message, ::testing::HasSubstr("clocks_hx8k.csv:4: ")) << line;
  }
}

TEST(ClockStore, KnowsWhatIsPlaced) {
  const StoredClock clock{.seeds = 3, .tools = "GHDL 5", .netlist = "ab"};
  EXPECT_TRUE(is_placed(clock, "GHDL 5", "ab", 3));
  EXPECT_FALSE(is_placed(clock, "GHDL 6", "ab", 3));
  EXPECT_FALSE(is_placed(clock, "GHDL 5", "ac", 3));
  EXPECT_FALSE(is_placed(clock, "GHDL 5", "ab", 9));
  const StoredClock no_room{.tools = "GHDL 5", .netlist = "ab"};
  EXPECT_TRUE(is_placed(no_room, "GHDL 5", "ab", 9));
  EXPECT_FALSE(is_placed(no_room, "GHDL 5", "ac", 9));
}

// The clocks of two devices do not mix, and each file has its family's cells.
TEST(ClockStore, IsOfOneDevice) {
  const TemporaryFolder folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::filesystem::path root = folder.path();
  ASSERT_TRUE(make_folders((root / clocks_file(c_ecp5)).parent_path()));
  const StoredClock clock{.cells = {.luts = 1, .carries = 9, .flip_flops = 2, .rams = 3, .multipliers = 4},
                          .mhz = 99,
                          .netlist = "ab"};
  ASSERT_TRUE(write_clocks(root, c_ecp5, {{"a", clock}}));
  EXPECT_TRUE(must(read_clocks(root, c_ice40)).empty());
  EXPECT_EQ(must(read_clocks(root, c_ecp5)).at("a").cells,
            (Cells{.luts = 1, .flip_flops = 2, .rams = 3, .multipliers = 4}));
  EXPECT_THAT(must(read_file(root / clocks_file(c_ecp5))),
              ::testing::StartsWith("design,luts,flip_flops,rams,multipliers,mhz,"));
}

}  // namespace
}  // namespace halfway::synth
