// SPDX-License-Identifier: Apache-2.0
// Tests that need no tool: the wrapper's text, and reading nextpnr's report.
#include "sim/cost/synthesis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/must.hpp"

namespace halfway::synth {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* c_leaf_netlist =
    "module other\n  (input  clk);\nendmodule\nmodule top\n  (input  clk,\n   input  go,\n   input  [2:0] "
    "a,\n"
    "   output [1:0] sum,\n   output done);\nendmodule\n";

TEST(SynthWrapper, RegistersEveryPortExceptTheClock) {
  const std::string text = wrapper(c_leaf_netlist, "top", 256);
  for (const char* line : {"reg [3:0] in;", "assign go = {in[0]};", "assign a = {in[3], in[2], in[1]};",
                           "assign out = {done, sum};", "reg [2:0] folded;", ".clk(clk)"})
    EXPECT_THAT(text, HasSubstr(line));
  const std::string axi = wrapper("module top\n  (input  aclk,\n   output q);\nendmodule\n", "top", 256);
  EXPECT_THAT(axi, HasSubstr(".aclk(clk)"));
  EXPECT_THAT(axi, Not(HasSubstr("assign aclk")));
}

TEST(SynthWrapper, SharesFlipFlopsOfWideInputs) {
  const std::string text = wrapper(c_leaf_netlist, "top", 3);
  EXPECT_THAT(text, HasSubstr("reg [2:0] in;"));
  EXPECT_THAT(text, HasSubstr("assign a = {in[0], in[2], in[1]};"));
}

TEST(SynthWrapper, RefusesAMissingModuleOrOutput) {
  EXPECT_THROW(wrapper(c_leaf_netlist, "absent", 256), Failure);
  EXPECT_THROW(wrapper(c_leaf_netlist, "other", 256), Failure);  // no output
}

// Two flip-flops, with a lookup table and a carry between them.
constexpr const char* c_wrapped = R"({"modules": {"wrapped": {"cells": {
  "dut.first_SB_DFF_Q": {"type": "SB_DFF", "connections": {"C": [1], "D": [2], "Q": [3]}},
  "dut.x_SB_LUT4_I0": {"type": "SB_LUT4", "connections": {"I0": [3], "O": [4]}},
  "dut.second_SB_DFF_Q": {"type": "SB_DFF", "connections": {"C": [1], "D": [4], "Q": [5]}}},
  "netnames": {"dut.n7_q": {"hide_name": 0, "bits": [9, 3]}, "dut.unit.first": {"hide_name": 0, "bits": [9, 3]},
  "dut.second_SB_LUT4_O": {"hide_name": 0, "bits": [5]}, "dut.second": {"hide_name": 0, "bits": [5]},
  "dut.n8": {"hide_name": 0, "bits": [5]}}}}})";
constexpr const char* c_report = R"({"critical_paths": [
  {"from": "<async>", "to": "posedge clk", "path": []},
  {"from": "posedge clk", "to": "posedge clk", "path": [
  {"type": "clk-to-q", "delay": 0.5, "from": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "CLK"}, "to": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "O"}},
  {"type": "routing", "delay": 1.0, "net": "x", "from": {"cell": "dut.first_SB_DFF_Q_DFFLC", "port": "O"}, "to": {"cell": "c", "port": "I1"}},
  {"type": "logic", "delay": 0.25, "from": {"cell": "c", "port": "I1"}, "to": {"cell": "c", "port": "COUT"}},
  {"type": "logic", "delay": 0.25, "from": {"cell": "d", "port": "I3"}, "to": {"cell": "d", "port": "O"}},
  {"type": "routing", "delay": 0.5, "net": "y", "from": {"cell": "d", "port": "O"}, "to": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}},
  {"type": "setup", "delay": 0.5, "from": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}, "to": {"cell": "dut.x_SB_LUT4_I0_LC", "port": "I0"}}]}],
  "fmax": {"clk": {"achieved": 125.5, "constraint": 200}}})";

TEST(SynthPlacement, ReadsClockCellsAndPath) {
  const Placement placement = read_placement(c_report, c_wrapped, 4, c_hx8k.names);
  EXPECT_EQ(placement.seed, 4U);
  EXPECT_EQ(placement.mhz, 125.5);
  EXPECT_EQ(placement.path.from, "unit.first[1]");
  EXPECT_EQ(placement.path.to, "second");
  EXPECT_EQ(placement.path.luts, 1U);
  EXPECT_EQ(placement.path.carries, 1U);
  EXPECT_DOUBLE_EQ(placement.path.logic, 1.5);
  EXPECT_DOUBLE_EQ(placement.path.routing, 1.5);
}

// Two registers with a multiplier between them.
constexpr const char* c_ecp5_wrapped = R"({"modules": {"wrapped": {"cells": {
  "dut.a_TRELLIS_FF_Q_3": {"type": "TRELLIS_FF", "connections": {"DI": [2], "Q": [3]}},
  "dut.p_TRELLIS_FF_Q": {"type": "TRELLIS_FF", "connections": {"DI": [4], "Q": [5]}}},
  "netnames": {"dut.unit.a": {"bits": [9, 3]}, "dut.p": {"bits": [5]}}}}})";
constexpr const char* c_ecp5_report =
    R"({"critical_paths": [{"from": "posedge clk", "to": "posedge clk", "path": [
  {"type": "clk-to-q", "delay": 0.5, "from": {"cell": "dut.a_TRELLIS_FF_Q_3", "port": "CLK"}, "to": {"cell": "dut.a_TRELLIS_FF_Q_3", "port": "Q"}},
  {"type": "routing", "delay": 1.5, "from": {"cell": "dut.a_TRELLIS_FF_Q_3", "port": "Q"}, "to": {"cell": "m", "port": "B15"}},
  {"type": "logic", "delay": 4.0, "from": {"cell": "m", "port": "B15"}, "to": {"cell": "m", "port": "P32"}},
  {"type": "routing", "delay": 1.5, "from": {"cell": "m", "port": "P32"}, "to": {"cell": "dut.p_TRELLIS_FF_Q", "port": "M"}},
  {"type": "setup", "delay": 0, "from": {"cell": "dut.p_TRELLIS_FF_Q", "port": "M"}, "to": {"cell": "dut.p_TRELLIS_FF_Q", "port": "M"}}]}],
  "fmax": {"clk": {"achieved": 133.5, "constraint": 200}}})";

TEST(SynthPlacement, CountsTheMultipliersOfAPath) {
  const Placement placement = read_placement(c_ecp5_report, c_ecp5_wrapped, 1, c_lfe5u_85f.names);
  EXPECT_EQ(placement.mhz, 133.5);
  EXPECT_EQ(placement.path.from, "unit.a[1]");
  EXPECT_EQ(placement.path.to, "p");
  EXPECT_EQ(placement.path.luts, 0U);
  EXPECT_EQ(placement.path.multipliers, 1U);
  EXPECT_DOUBLE_EQ(placement.path.logic, 4.5);
}

TEST(SynthPlacement, RefusesWhatItCannotRead) {
  EXPECT_THROW(read_placement("", c_wrapped, 1, c_hx8k.names), Failure);
  EXPECT_THROW(read_placement("{}", c_wrapped, 1, c_hx8k.names), Failure);
  EXPECT_THROW(read_placement(c_report, "{}", 1, c_hx8k.names), Failure);
}

TEST(SynthCells, HaveTheReasonWhyTheyDoNotFit) {
  EXPECT_EQ(does_not_fit(c_hx8k, {.luts = 7680, .flip_flops = 7680, .rams = 32}), "");
  EXPECT_EQ(does_not_fit(c_hx8k, {.luts = 7681}), "does not fit the HX8K: 7681 LUTs of 7680");
  EXPECT_EQ(does_not_fit(c_hx8k, {.flip_flops = 7681}), "does not fit the HX8K: 7681 flip-flops of 7680");
  EXPECT_EQ(does_not_fit(c_hx8k, {.rams = 33}), "does not fit the HX8K: 33 RAMs of 32");
  EXPECT_EQ(does_not_fit(c_lfe5u_85f, {.multipliers = 156}), "");
  EXPECT_EQ(does_not_fit(c_lfe5u_85f, {.multipliers = 157}),
            "does not fit the LFE5U-85F: 157 multipliers of 156");
}

TEST(SynthPacking, ReadsNextpnrsOutput) {
  const std::string_view said =
      "Info: Packing..\nInfo: Device utilisation:\nInfo: \t         ICESTORM_LC:  2814/ 7680    36%\nInfo: "
      "\t        "
      "ICESTORM_RAM:     8/   32    25%\n";
  EXPECT_EQ(read_packing(said, c_hx8k.names), 2814U);
  EXPECT_THROW(read_packing("ERROR: no such file", c_hx8k.names), Failure);
  EXPECT_THROW(read_packing("ICESTORM_LC: many", c_hx8k.names), Failure);
}

}  // namespace
}  // namespace halfway::synth
