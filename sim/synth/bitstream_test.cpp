// SPDX-License-Identifier: Apache-2.0
#include "sim/synth/bitstream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/system/must.hpp"

namespace halfway::synth {
namespace {

// As GHDL 2.0.0 prints them.
constexpr const char* c_pad_netlist =
    "module SB_IO\n  #(parameter\n    PIN_TYPE)\n  (input  INPUT_CLK,\n   output D_IN_0);\nendmodule\n\n"
    "module SB_PLL\n  (output LOCK);\nendmodule\n\n"
    "module top\n  (input  clk);\n  SB_PLL #(\n    .FEEDBACK_PATH(32'b01010000010010000100000101010011),\n"
    "    .DIVR(4'b0001))\n    pll (\n    .LOCK(n1_o));\nendmodule\n";

TEST(VendorCells, LoseTheirEmptyModulesAndHaveTextsAsParameters) {
  const auto mended = must(mend_cells(c_pad_netlist));
  EXPECT_THAT(mended, ::testing::Not(::testing::HasSubstr("module SB_")));
  EXPECT_THAT(mended, ::testing::HasSubstr("module top\n  (input  clk);"));
  EXPECT_THAT(mended, ::testing::HasSubstr(".FEEDBACK_PATH(\"PHAS\"),\n    .DIVR(4'b0001))"));
}

TEST(VendorCells, OtherFaultsOfTheNetlistAreMendedOrRefused) {
  EXPECT_FALSE(mend_cells("module top\n  (input  clk);\n  assign a = \"text\";\nendmodule\n"));
}

}  // namespace
}  // namespace halfway::synth
