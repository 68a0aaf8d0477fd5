// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/clock_store.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::synth {
namespace {

using ClockStoreTest = FolderTest;

TEST_F(ClockStoreTest, ReadsWhatItWrites) {
  const std::string file = "docs/results/clocks_hx8k.csv";
  EXPECT_EQ(clocks_file(c_ice40), file);
  EXPECT_TRUE(read_clocks(here(), c_ice40)->empty());
  ASSERT_TRUE(make_folders(at(file).parent_path()));
  const StoredClock clock{.cells = {1, 2, 3, 4},
                          .mhz = 87.54,
                          .seeds = 3,
                          .range = "80 to 90 of 3",
                          .path = "`r.x` → `r.y`, 3 LUTs",
                          .tools = "GHDL 2, Yosys 1",
                          .netlist = "ab",
                          .hardware = "e g_a=1"};
  ASSERT_TRUE(
      write_clocks(here(), c_ice40, {{"a", clock}, {"large", {.cells = {5, 6, 7, 8}, .netlist = "cd"}}}));
  const auto clocks = read_clocks(here(), c_ice40);
  ASSERT_TRUE(clocks) << clocks.error().message;
  ASSERT_EQ(clocks->size(), 2U);
  const StoredClock& a = clocks->at("a");
  EXPECT_EQ(a.cells, clock.cells);
  EXPECT_EQ(a.mhz, 87.5);
  EXPECT_EQ(a.seeds, clock.seeds);
  for (std::string StoredClock::* text : {&StoredClock::range, &StoredClock::path, &StoredClock::tools,
                                          &StoredClock::netlist, &StoredClock::hardware})
    EXPECT_EQ(a.*text, clock.*text);
  EXPECT_EQ(clocks->at("large").mhz, 0);
  EXPECT_EQ(clock_of(*clocks, "cd")->first, "large");
  for (const char* other : {"aa", "bc", "ef"}) EXPECT_EQ(clock_of(*clocks, other), clocks->end()) << other;

  // The netlists of one GHDL are compared.
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=1", "GHDL 5")->first, "a");
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=1", "GHDL 2"), clocks->end());
  EXPECT_EQ(clock_by_other_ghdl(*clocks, "e g_a=2", "GHDL 5"), clocks->end());

  const std::string text = text_of(file);
  for (const char* line : {"a,1,2,3,4,5,6,,,,ef,\n", "b,1,2,x,4,5,6,,,,ef,\n", "b,1,2,-3,4,5,6,,,,ef,\n",
                           "b,1,2,3,4,5,6,,,,,\n"}) {
    write(file, text + line);
    EXPECT_TRUE(is_error(read_clocks(here(), c_ice40), "clocks_hx8k.csv:4: ")) << line;
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

}  // namespace
}  // namespace halfway::synth
