// SPDX-License-Identifier: Apache-2.0
// Netlists that differ only in comments, GHDL's numbers and module names become equal; other netlists do not.
#include "sim/synth/nameless_netlist.hpp"

#include <gtest/gtest.h>

#include <string>

namespace halfway::synth {
namespace {

constexpr const char* c_netlist =
    "module top\n"
    "  (input  clk,\n"
    "   output [7:0] sum);\n"
    "  wire n12_o;\n"
    "  reg [7:0] n7; // memory\n"
    "  /* rtl/a.vhd:3:4  */\n"
    "  assign sum = n12_o ? n7 : 8'b00000001; // (signal)\n"
    "endmodule\n";

TEST(NamelessNetlist, HasNoCommentsAndIsRenumbered) {
  EXPECT_EQ(nameless(c_netlist),
            "module module$0\n"
            "  (input  clk,\n"
            "   output [7:0] sum);\n"
            "  wire n$0;\n"
            "  reg [7:0] n$1;\n"
            "  assign sum = n$0 ? n$1 : 8'b00000001;\n"
            "endmodule\n");
}

TEST(NamelessNetlist, IgnoresNumbersAndPositions) {
  const std::string other =
      "module top\n"
      "  (input  clk,\n"
      "   output [7:0] sum);\n"
      "  wire n3_o;\n"
      "  reg [7:0] n4;\n"
      "  /* rtl/b.vhd:30:41  */\n"
      "\n"
      "  assign sum = n3_o ? n4 : 8'b00000001;\n"
      "endmodule";
  EXPECT_EQ(nameless(other), nameless(c_netlist));
}

TEST(NamelessNetlist, DistinguishesOtherHardware) {
  const auto with = [](const std::string& expression) {
    return nameless("assign sum = " + expression + ";");
  };
  const std::string one = with("n1_o & n2_o");
  EXPECT_NE(with("n1_o & n1_o"), one);
  EXPECT_NE(with("n1_o | n2_o"), one);
  EXPECT_NE(with("n1_o & n2_q"), with("n1_o & n1_o"));
  EXPECT_NE(with("n1_o & n2_o & n1_o"), with("n1_o & n2_o & n2_o"));
  EXPECT_NE(with("8'd1"), with("8'd2"));
  EXPECT_EQ(with("n5_o & n2_o"), one);
}

TEST(NamelessNetlist, NumbersModules) {
  const auto with = [](const std::string& a, const std::string& b, const std::string& used) {
    return nameless("module " + a + "\n  (input x);\nendmodule\nmodule " + b + "\n  (input x);\nendmodule\n" +
                    "module top\n  (input x);\n  " + used + " part (.x(x));\nendmodule\n");
  };
  const std::string one = with("sum_8_01ab", "sum_9", "sum_9");
  EXPECT_EQ(with("sum_8", "sum_9_77", "sum_9_77"), one);
  EXPECT_NE(with("sum_8", "sum_9_77", "sum_8"), one);
  EXPECT_NE(one.find("  module$1 part (.x(x));\n"), std::string::npos) << one;
  // A module used before its definition.
  EXPECT_EQ(nameless("  a part ();\nmodule a\n"), nameless("  b part ();\nmodule b\n"));
}

TEST(NamelessNetlist, KeepsNamesFromTheVhdl) {
  for (const char* name :
       {"next", "n", "n1a", "n1_", "n1_X", "n1_o2", "parts_n1_value", "N1_o", "12n1_o", "clk", "n1_o_o"})
    EXPECT_EQ(nameless(name), std::string(name) + "\n");
  EXPECT_EQ(nameless("n1_o n22"), "n$0 n$1\n");
}

TEST(NamelessNetlist, AcceptsAnUnterminatedComment) {
  EXPECT_EQ(nameless("wire a; /* n1_o"), "wire a;\n");
  EXPECT_EQ(nameless("wire a; // n1_o"), "wire a;\n");
  EXPECT_EQ(nameless("a / b\n"), "a / b\n");
  EXPECT_EQ(nameless(""), "");
}

}  // namespace
}  // namespace halfway::synth
