// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/bitstream.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway::synth {
namespace {

// As GHDL 2.0.0 prints them.
constexpr const char* c_pad_netlist =
    "module SB_IO\n  #(parameter\n    PIN_TYPE)\n  (input  INPUT_CLK,\n   output D_IN_0);\nendmodule\n\n"
    "module SB_PLL\n  (output LOCK);\nendmodule\n\n"
    "module top\n  (input  clk);\n  SB_PLL #(\n    .FEEDBACK_PATH(32'b01010000010010000100000101010011),\n"
    "    .DIVR(4'b0001))\n    pll (\n    .LOCK(n1_o));\nendmodule\n";

TEST(VendorCells, LoseTheirEmptyModulesAndHaveTextsAsParameters) {
  const std::string mended = must(mend_cells(c_pad_netlist));
  EXPECT_THAT(mended, ::testing::Not(::testing::HasSubstr("module SB_")));
  EXPECT_THAT(mended, ::testing::HasSubstr("module top\n  (input  clk);"));
  EXPECT_THAT(mended, ::testing::HasSubstr(".FEEDBACK_PATH(\"PHAS\"),\n    .DIVR(4'b0001))"));
}

TEST(VendorCells, OtherFaultsOfTheNetlistAreMendedOrRefused) {
  EXPECT_FALSE(mend_cells("module top\n  (input  clk);\n  assign a = \"text\";\nendmodule\n"));
}

using BoardNetlist = FolderTest;

TEST_F(BoardNetlist, HasTheVendorsCellsAsTheyAre) {
  const std::string netlist = board_netlist({HALFWAY_SOURCE_DIR, here()});
  EXPECT_THAT(netlist, ::testing::HasSubstr("module board_top\n"));
  EXPECT_THAT(netlist, ::testing::HasSubstr("  SB_PLL40_2F_CORE "));
  EXPECT_THAT(netlist, ::testing::Not(::testing::HasSubstr("module SB_")));
}

}  // namespace
}  // namespace halfway::synth
