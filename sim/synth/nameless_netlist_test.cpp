// SPDX-License-Identifier: Apache-2.0
// Netlists that differ only in comments and names become equal; other netlists do not.
#include "sim/synth/nameless_netlist.hpp"

#include <gtest/gtest.h>

#include <string>

namespace halfway::synth {
namespace {

constexpr const char* c_named_netlist =
    "module top\n"
    "  (input  clk,\n"
    "   output [7:0] sum);\n"
    "  wire n12_o;\n"
    "  reg [7:0] n7; // memory\n"
    "  /* rtl/a.vhd:3:4  */\n"
    "  assign sum = n12_o ? n7 : 8'b00000001; // (signal)\n"
    "endmodule\n";

TEST(NamelessNetlist, HasNoCommentsAndIsRenumbered) {
  EXPECT_EQ(nameless(c_named_netlist),
            "module module$0\n"
            "  (input  clk,\n"
            "   output [7:0] sum);\n"
            "  wire n$0;\n"
            "  reg [7:0] n$1;\n"
            "  assign sum = n$0 ? n$1 : 8'b00000001;\n"
            "endmodule\n");
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
  EXPECT_NE(one.find("  module$1 n$0 (.(x));\n"), std::string::npos) << one;
  // A module used before its definition.
  EXPECT_EQ(nameless("  a part ();\nmodule a\n"), nameless("  b part ();\nmodule b\n"));
}

// A leaf with a memory, and a top with two instances of it.
std::string with_names(const std::string& leaf_port, const std::string& leaf_net, const std::string& instance,
                       const std::string& net, const std::string& top_port = "d") {
  return "module leaf_1\n  (input  clk,\n   input  [3:0] " + leaf_port + ",\n   output q);\n  wire [3:0] " +
         leaf_net + ";\n  reg " + leaf_net + "_memory[7:0] ; // memory\n  assign " + leaf_net + " = " +
         leaf_port + ";\n  assign q = " + leaf_net +
         "[3];\nendmodule\nmodule top\n  (input  clk,\n   input  [3:0] " + top_port +
         ",\n   input  [3:0] e,\n   output q);\n  wire " + net + ";\n  wire other;\n  leaf_1 " + instance +
         " (\n    .clk(clk),\n    ." + leaf_port + "(" + top_port + "),\n    .q(" + net +
         "));\n  leaf_1 more (\n" + "    .clk(clk),\n    ." + leaf_port +
         "(e),\n    .q(other));\n  assign q = " + net + ";\nendmodule\n";
}

TEST(NamelessNetlist, IgnoresNamesOfNetsPortsAndInstances) {
  const std::string one = nameless(with_names("data", "word", "part", "sum"));
  EXPECT_EQ(nameless(with_names("value", "word", "part", "sum")), one);
  EXPECT_EQ(nameless(with_names("data", "other", "part", "sum")), one);
  EXPECT_EQ(nameless(with_names("data", "word", "first", "sum")), one);
  EXPECT_EQ(nameless(with_names("data", "word", "part", "result")), one);
  EXPECT_EQ(nameless(with_names("sum", "part", "word", "data")), one);
}

TEST(NamelessNetlist, DistinguishesPortsOfTheTopAndConnections) {
  const std::string one = nameless(with_names("data", "word", "part", "sum"));
  EXPECT_NE(nameless(with_names("data", "word", "part", "sum", "f")), one);
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = with_names("data", "word", "part", "sum");
    return nameless(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_NE(with("assign q = sum;", "assign q = other;"), one);
  EXPECT_NE(with(".data(d)", ".data(e)"), one);
  EXPECT_NE(with("assign q = word[3];", "assign q = word[2];"), one);
}

TEST(NamelessNetlist, TakesNoLiteralForAName) {
  const std::string with_b1 =
      nameless("module t\n  (output q);\n  wire b1;\n  assign q = 1'b1 & b1;\nendmodule\n");
  EXPECT_NE(with_b1.find("assign q = 1'b1 & n$0;"), std::string::npos) << with_b1;
}

TEST(NamelessNetlist, KeepsOtherWords) {
  for (const char* name :
       {"next", "n", "n1a", "n1_", "n1_X", "n1_o2", "parts_n1_value", "N1_o", "12n1_o", "clk", "n1_o_o"})
    EXPECT_EQ(nameless(name), std::string(name) + "\n");
  EXPECT_EQ(nameless("n1_o n22"), "n$0 n$1\n");
}

TEST(NamelessNetlist, AcceptsAnUnterminatedComment) {
  EXPECT_EQ(nameless("wire a; /* n1_o"), "wire n$0;\n");
  EXPECT_EQ(nameless("wire a; // n1_o"), "wire n$0;\n");
  EXPECT_EQ(nameless("a / b\n"), "a / b\n");
  EXPECT_EQ(nameless(""), "");
}

}  // namespace
}  // namespace halfway::synth
