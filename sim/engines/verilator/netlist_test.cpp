// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/verilator/netlist.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"

namespace halfway {
namespace {

TEST(Netlist, ReadsPortWidths) {
  const std::string text =
      "module inner\n  (input  [7:0] init_data,\n   output o);\nendmodule\n"
      "module top\n  (input  clk,\n   input  [1679:0] init_data,\n   output [868:0] data);\n  wire [3:0] "
      "w;\nendmodule\n";
  EXPECT_EQ(port_bits(text, "top", "init_data"), 1680U);
  EXPECT_EQ(port_bits(text, "top", "data"), 869U);
  EXPECT_EQ(port_bits(text, "top", "clk"), 1U);
  EXPECT_EQ(port_bits(text, "inner", "init_data"), 8U);
  EXPECT_EQ(port_bits(text, "top", "w"), 0U);
  EXPECT_EQ(port_bits(text, "none", "clk"), 0U);
}

TEST(Netlist, RepairsWideConstantsAndUndrivenBits) {
  EXPECT_EQ(*mend_netlist(
                "  assign a = b + \"1010\";\n  assign c = {d, 3'bZ};\n  assign e = \"XU-0\"; // \"note\"\n"),
            "  assign a = b + 4'b1010;\n  assign c = {d, 3'bx};\n  assign e = 4'bxxx0; \n");
}

TEST(Netlist, RefusesWhatItCannotRepair) {
  for (const char* line : {
           "  assign a = \"1012\";",
           "  assign a = \"101",
           "  assign a = \"\";",
           "  assign a = $signed(b) >> 31'b0101;",
           "  assign a = b / c; // sdiv",
           "  assign a = b % c; // smod",
           "  assign a = b % c; // srem",
           "  n33_o <= std_logic_vector(abs $signed(a));",
           "  n34_o <= a when $signed(a) < $signed(b) else b;",
           "  n34_o <= a;",
       }) {
    EXPECT_TRUE(is_error(mend_netlist(std::string("module t\n") + line + "\nendmodule\n"),
                         ExitCode::tool_failed, "netlist.v:2: "))
        << line;
  }
  const std::string sound =
      "  assign a = b <= c;\n  assign a = b >> 4'b0101;\n  always @*\n    case (s)\n      2'b10: n <= a;\n"
      "      2'b01: n <= b;\n    endcase\n  always @(posedge clk)\n    q <= n;\n";
  EXPECT_EQ(*mend_netlist(sound), sound);
}

}  // namespace
}  // namespace halfway
