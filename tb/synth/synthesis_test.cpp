// SPDX-License-Identifier: Apache-2.0
// What needs no tool: the wrapper's text, nextpnr's report read, pinned figures compared.
#include "synthesis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/file.hpp"
#include "pinned.hpp"

namespace halfway::synth {
namespace {

using ::testing::HasSubstr;

constexpr const char* kNetlist =
    "module other\n  (input  clk);\nendmodule\nmodule top\n  (input  clk,\n   input  go,\n   input  [2:0] "
    "a,\n"
    "   output [1:0] sum,\n   output done,\n   output [8:0] probe);\nendmodule\n";

TEST(SynthWrapper, RegistersEveryPortButClockAndProbe) {
  const auto text = wrapper(kNetlist, "top", 256);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_THAT(*text, HasSubstr("reg [3:0] in;"));
  EXPECT_THAT(*text, HasSubstr("assign go = {in[0]};"));
  EXPECT_THAT(*text, HasSubstr("assign a = {in[3], in[2], in[1]};"));
  EXPECT_THAT(*text, HasSubstr("assign out = {done, sum};"));
  EXPECT_THAT(*text, HasSubstr("reg [2:0] folded;"));
  EXPECT_THAT(*text, HasSubstr(".probe()"));
}

TEST(SynthWrapper, SharesFlipFlopsInFrontOfWideInputs) {
  const auto text = wrapper(kNetlist, "top", 3);
  ASSERT_TRUE(text) << text.error().message;
  EXPECT_THAT(*text, HasSubstr("reg [2:0] in;"));
  EXPECT_THAT(*text, HasSubstr("assign a = {in[0], in[2], in[1]};"));
}

TEST(SynthWrapper, RefusesWhatIsNotThere) {
  EXPECT_FALSE(wrapper(kNetlist, "absent", 256));
  EXPECT_FALSE(wrapper(kNetlist, "other", 256));  // no output
}

// Two flip-flops with a lookup table and a carry between them.
constexpr const char* kWrapped = R"({"modules": {"wrapped": {"cells": {
  "dut.first_SB_DFF_Q": {"type": "SB_DFF", "connections": {"C": [1], "D": [2], "Q": [3]}},
  "dut.x_SB_LUT4_I0": {"type": "SB_LUT4", "connections": {"I0": [3], "O": [4]}},
  "dut.second_SB_DFF_Q": {"type": "SB_DFF", "connections": {"C": [1], "D": [4], "Q": [5]}}},
  "netnames": {"dut.n7_q": {"hide_name": 0, "bits": [9, 3]}, "dut.unit.first": {"hide_name": 0, "bits": [9, 3]},
  "dut.second_SB_LUT4_O": {"hide_name": 0, "bits": [5]}, "dut.second": {"hide_name": 0, "bits": [5]}}}}})";
constexpr const char* kReport = R"({"critical_paths": [
  {"from": "<async>", "to": "posedge clk", "path": []},
  {"from": "posedge clk", "to": "posedge clk", "path": [
  {"type": "clk-to-q", "delay": 0.5, "from": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "CLK"}, "to": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "O"}},
  {"type": "routing", "delay": 1.0, "net": "x", "from": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "O"}, "to": {"cell": "c", "port": "I1"}},
  {"type": "logic", "delay": 0.25, "from": {"cell": "c", "port": "I1"}, "to": {"cell": "c", "port": "COUT"}},
  {"type": "logic", "delay": 0.25, "from": {"cell": "d", "port": "I3"}, "to": {"cell": "d", "port": "O"}},
  {"type": "routing", "delay": 0.5, "net": "y", "from": {"cell": "d", "port": "O"}, "to": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}},
  {"type": "setup", "delay": 0.5, "from": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}, "to": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}}]}],
  "fmax": {"clk": {"achieved": 125.5, "constraint": 200}},
  "utilization": {"ICESTORM_LC": {"available": 7680, "used": 12}}})";

TEST(SynthPlacement, ReadsClockCellsAndPath) {
  const auto placement = read_placement(kReport, kWrapped, 4);
  ASSERT_TRUE(placement) << placement.error().message;
  EXPECT_EQ(placement->seed, 4U);
  EXPECT_EQ(placement->mhz, 125.5);
  EXPECT_EQ(placement->cells_used, 12U);
  EXPECT_EQ(placement->cells_there, 7680U);
  EXPECT_EQ(placement->path.from, "unit.first[1]");
  EXPECT_EQ(placement->path.to, "second");
  EXPECT_EQ(placement->path.luts, 1U);
  EXPECT_EQ(placement->path.carries, 1U);
  EXPECT_DOUBLE_EQ(placement->path.logic, 1.5);
  EXPECT_DOUBLE_EQ(placement->path.routing, 1.5);
}

TEST(SynthPlacement, RefusesWhatItCannotRead) {
  EXPECT_FALSE(read_placement("", kWrapped, 1));
  EXPECT_FALSE(read_placement("{}", kWrapped, 1));
  EXPECT_FALSE(read_placement(kReport, "{}", 1));
}

constexpr Ice40Cells kCells{.luts = 200, .carries = 39, .flip_flops = 40, .rams = 1};

TEST(SynthPins, SayWhatIsNotAsPinned) {
  const Pins pins = {{"a", {kCells, 100}}};
  EXPECT_EQ(compare("a", pins, kCells, 100), "");
  EXPECT_EQ(compare("a", pins, kCells, 0), "");  // not measured
  EXPECT_THAT(compare("b", pins, kCells, 100), HasSubstr("nothing is pinned"));
  const auto with = [&](std::uint64_t luts, std::uint64_t carries, std::uint64_t flip_flops,
                        std::uint64_t rams) {
    return compare("a", pins, {luts, carries, flip_flops, rams}, 0);
  };
  EXPECT_EQ(with(206, 42, 40, 1), "");
  EXPECT_EQ(with(194, 36, 40, 1), "");
  EXPECT_THAT(with(207, 39, 40, 1), HasSubstr("207 LUTs, 200 are pinned"));
  EXPECT_THAT(with(193, 39, 40, 1), HasSubstr("LUTs"));
  EXPECT_THAT(with(200, 43, 40, 1), HasSubstr("carries"));
  EXPECT_THAT(with(200, 39, 41, 1), HasSubstr("41 flip-flops, 40 are pinned"));
  EXPECT_THAT(with(200, 39, 39, 1), HasSubstr("flip-flops"));
  EXPECT_THAT(with(200, 39, 40, 2), HasSubstr("RAMs"));
  EXPECT_EQ(compare("a", pins, kCells, 92.5), "");
  EXPECT_EQ(compare("a", pins, kCells, 107.5), "");
  EXPECT_THAT(compare("a", pins, kCells, 91.5), HasSubstr("slower"));
  EXPECT_THAT(compare("a", pins, kCells, 108.5), HasSubstr("faster"));
}

TEST(SynthPins, ComeBackFromTheirFile) {
  auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
  ASSERT_TRUE(folder) << folder.error().message;
  const auto path = folder->path() / "pinned.txt";
  ASSERT_TRUE(write_pins(path, {{"a", {kCells, 123.4}}, {"b", {{1, 2, 3, 4}, 0}}}, "Yosys 0.23"));
  const auto pins = read_pins(path);
  ASSERT_TRUE(pins) << pins.error().message;
  ASSERT_EQ(pins->size(), 2U);
  EXPECT_EQ(pins->at("a").cells, kCells);
  EXPECT_EQ(pins->at("a").mhz, 123.4);
  EXPECT_EQ(pins->at("b").cells, (Ice40Cells{1, 2, 3, 4}));
  for (const char* wrong :
       {"a 1 2 3 4\n", "a 1 2 3 4 5 6\n", "a 1 2 3 x 5\n", "a 1 2 3 4 5\na 1 2 3 4 5\n"}) {
    ASSERT_TRUE(write_file(path, wrong));
    const auto read = read_pins(path);
    ASSERT_FALSE(read) << wrong;
    EXPECT_THAT(read.error().message, HasSubstr("pinned.txt:"));
  }
}

}  // namespace
}  // namespace halfway::synth
