// SPDX-License-Identifier: Apache-2.0
#include "sim/verilator/netlist.hpp"

#include <gtest/gtest.h>

namespace halfway {
namespace {

TEST(Netlist, KnowsThePortsWidths) {
  const std::string text =
      "module inner\n  (input  [7:0] init_data,\n   output o);\nendmodule\n"
      "module top\n  (input  clk,\n   input  [1679:0] init_data,\n   output [868:0] probe);\n  wire [3:0] "
      "w;\nendmodule\n";
  EXPECT_EQ(port_bits(text, "top", "init_data"), 1680U);
  EXPECT_EQ(port_bits(text, "top", "probe"), 869U);
  EXPECT_EQ(port_bits(text, "top", "clk"), 1U);
  EXPECT_EQ(port_bits(text, "inner", "init_data"), 8U);
  EXPECT_EQ(port_bits(text, "top", "w"), 0U);
  EXPECT_EQ(port_bits(text, "none", "clk"), 0U);
}

TEST(Netlist, MendsWideConstantsAndUndrivenBits) {
  EXPECT_EQ(*mend_netlist(
                "  assign a = b + \"1010\";\n  assign c = {d, 3'bZ};\n  assign e = \"XU-0\"; // \"note\"\n"),
            "  assign a = b + 4'b1010;\n  assign c = {d, 3'bx};\n  assign e = 4'bxxx0; \n");
}

TEST(Netlist, RefusesWhatItCannotMend) {
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
    const auto mended = mend_netlist(std::string("module t\n") + line + "\nendmodule\n");
    ASSERT_FALSE(mended) << line;
    EXPECT_EQ(mended.error().code, ExitCode::tool_failed);
    EXPECT_EQ(mended.error().message.find("netlist.v:2: "), 0U) << mended.error().message;
  }
  const std::string sound =
      "  assign a = b <= c;\n  assign a = b >> 4'b0101;\n  always @*\n    case (s)\n      2'b10: n <= a;\n"
      "      2'b01: n <= b;\n    endcase\n  always @(posedge clk)\n    q <= n;\n";
  EXPECT_EQ(*mend_netlist(sound), sound);
}

TEST(Netlist, MakesRegistersHoldAndSplitsTheirFields) {
  const std::string netlist = R"(module m
  (input  clk,
   input  load,
   input  step,
   input  [3:0] d,
   output [3:0] o);
  wire [4:0] r;
  wire [3:0] n1_o;
  wire [3:0] n2_o;
  wire [3:0] n3_o;
  wire n4_o;
  wire n5_o;
  wire [4:0] n6_o;
  reg [4:0] q;
  assign o = n1_o;
  assign r = q;
  assign n1_o = r[3:0];
  assign n2_o = n1_o + d;
  assign n3_o = step ? n2_o : n1_o;
  assign n4_o = r[4];
  assign n5_o = load ? n4_o : step;
  assign n6_o = {n5_o, n3_o};
  always @(posedge clk)
    q <= n6_o;
endmodule
)";
  const std::string split = split_registers(netlist);
  EXPECT_NE(split.find("reg [3:0] q__0;"), std::string::npos) << split;
  EXPECT_NE(split.find("reg q__1;"), std::string::npos) << split;
  EXPECT_NE(split.find("assign q = {q__1, q__0};"), std::string::npos) << split;
  EXPECT_NE(split.find("if (step) begin q__0 <= n1_o + d; end\n"), std::string::npos) << split;
  EXPECT_NE(split.find("if (!load) begin q__1 <= step; end\n"), std::string::npos) << split;
  EXPECT_NE(split.find("assign n1_o = q__0;"), std::string::npos) << split;
  EXPECT_EQ(split.find("q <= n6_o"), std::string::npos) << split;
}

// A record of three fields, reset in front of one of them, cut where one branch puts parts together.
constexpr const char* kRecord = R"(module m
  (input  clk,
   input  reset,
   input  load,
   input  step,
   input  [4:0] d,
   output [3:0] o);
  wire [4:0] r;
  wire [3:0] n1_o;
  wire n2_o;
  wire [4:0] n3_o;
  wire [4:0] n4_o;
  wire [4:0] n5_o;
  wire [3:0] n6_o;
  wire n7_o;
  wire n8_o;
  wire n9_o;
  wire [4:0] n10_o;
  wire [4:0] n11_o;
  reg [4:0] q;
  assign o = n1_o;
  assign r = q;
  assign n1_o = r[3:0];
  assign n2_o = r[4];
  assign n3_o = {n2_o, n1_o};
  assign n4_o = n3_o + d;
  assign n5_o = load ? d : n4_o;
  assign n6_o = n5_o[3:0];
  assign n7_o = n5_o[4];
  assign n8_o = step ? n7_o : n2_o;
  assign n9_o = reset ? 1'b0 : n8_o;
  assign n10_o = step ? n5_o : r;
  assign n11_o = {n9_o, n10_o[3:0]};
  always @(posedge clk)
    q <= n11_o;
endmodule
)";

TEST(Netlist, LeavesWhatIsChosenTogetherOutside) {
  const std::string split = split_registers(kRecord);
  EXPECT_NE(split.find("    q__0 <= n10_o[3:0];\n"), std::string::npos) << split;
  EXPECT_NE(split.find("if (reset) begin q__1 <= 1'b0; end else begin if (step)"), std::string::npos)
      << split;
}

TEST(Netlist, FormsWhatIsLoadedWhereItIsLoaded) {
  const std::string inside = split_registers(kRecord, Wires::inside);
  EXPECT_EQ(inside.find("assign n4_o"), std::string::npos) << inside;
  EXPECT_EQ(inside.find("wire [4:0] n4_o"), std::string::npos) << inside;
  EXPECT_NE(
      inside.find(
          "if (step) begin d__here = d; if (load) begin q__0 <= d__here[3:0]; q__1 <= d__here[4]; end else "
          "begin n4_o = {q__1, q__0} + d__here; q__0 <= n4_o[3:0]; q__1 <= n4_o[4]; end end\n      if "
          "(reset) q__1 <= 1'b0;\n"),
      std::string::npos)
      << inside;
  EXPECT_NE(inside.find("assign o = q__0;"), std::string::npos) << inside;
}

TEST(Netlist, KeepsOutsideWhatOthersAskForToo) {
  std::string netlist = kRecord;
  netlist.insert(netlist.find("endmodule"), "  other other_1 (\n    .a(n4_o));\n");
  const std::string inside = split_registers(netlist, Wires::inside);
  EXPECT_NE(inside.find("assign n4_o = {q__1, q__0} + d;"), std::string::npos) << inside;
}

// As a multiplier's digit, or a sum of three.
std::string masked(const std::string& a, const std::string& operation, const std::string& mask) {
  return "module m\n  (input  clk,\n   input  [1:0] a,\n   input  [1:0] b,\n   output [3:0] o);\n"
         "  wire [3:0] n1_o;\n  wire [3:0] n2_o;\n  wire [3:0] n3_o;\n  wire n4_o;\n  wire n5_o;\n"
         "  wire n6_o;\n  wire n7_o;\n  wire [2:0] n8_o;\n  wire [3:0] n9_o;\n  reg [3:0] q;\n"
         "  assign o = q;\n  assign n1_o = " +
         a + ";\n  assign n2_o = {2'b0, b};\n  assign n3_o = n1_o " + operation +
         " n2_o;\n  assign n4_o = n3_o[3];\n  assign n5_o = a[1];\n  assign n6_o = " + mask +
         ";\n  assign n7_o = n4_o & n6_o;\n  assign n8_o = n3_o[2:0];\n  assign n9_o = {n7_o, n8_o};\n"
         "  always @(posedge clk)\n    q <= n9_o;\nendmodule\n";
}

TEST(Netlist, DropsTheMaskOfABitThatItNeverClears) {
  struct Case {
    const char *a, *operation, *mask;
    bool dropped;
  };
  for (const Case& c : {Case{"{2'b0, a}", "*", "n5_o | n5_o", true},   // 1 * 3
                        Case{"{a, 2'b0}", "*", "n5_o | n5_o", false},  // 4 * 3
                        Case{"{a, 2'b0}", "+", "1'b0 | n5_o", true},   // 4 + 3
                        Case{"{a, 2'b0}", "+", "b[0] | b[0]", false},  // 12 + 2
                        Case{"{2'b0, a}", "-", "n5_o | n5_o", false}}) {
    for (const Wires wires : {Wires::outside, Wires::inside}) {
      const std::string split = split_registers(masked(c.a, c.operation, c.mask), wires);
      EXPECT_EQ(split.find("reg q__1;") == std::string::npos, c.dropped) << split;
    }
  }
}

// As an interpolator's part: an addend chosen in front of its sum.
constexpr const char* kAddend = R"(module m
  (input  clk,
   input  load,
   input  step,
   input  [3:0] start,
   input  [3:0] increment,
   output [3:0] o,
   output c);
  wire n1_o;
  wire [3:0] n2_o;
  wire [3:0] n3_o;
  wire [3:0] n4_o;
  wire [3:0] n5_o;
  wire n6_o;
  wire n7_o;
  wire n8_o;
  wire n9_o;
  reg [3:0] q;
  reg p;
  assign o = q;
  assign c = p;
  assign n1_o = load | step;
  assign n2_o = step ? increment : start;
  assign n3_o = q + n2_o;
  assign n4_o = load ? n2_o : n3_o;
  assign n5_o = n1_o ? n4_o : q;
  assign n6_o = n3_o[3];
  assign n7_o = ~load;
  assign n8_o = n6_o & n7_o;
  assign n9_o = n1_o ? n8_o : p;
  always @(posedge clk)
    q <= n5_o;
  always @(posedge clk)
    p <= n9_o;
endmodule
)";

TEST(Netlist, KnowsInEachBranchWhichOfTwoConditionsHolds) {
  const std::string inside = split_registers(kAddend, Wires::inside);
  EXPECT_NE(inside.find("if (step) begin increment__here = increment; "
                        "if (load) begin q <= increment__here; p <= 1'b0; end "
                        "else begin n3_o__part1 = q + increment__here; q <= n3_o__part1; p <= "
                        "n3_o__part1[3]; end end "
                        "else begin if (load) begin q <= start; p <= 1'b0; end end"),
            std::string::npos)
      << inside;
  EXPECT_NE(inside.find("reg [3:0] increment__here;"), std::string::npos) << inside;
  const std::string outside = split_registers(kAddend);
  EXPECT_NE(outside.find("  wire [3:0] n3_o__part1;\n"), std::string::npos) << outside;
  EXPECT_NE(outside.find("  assign n3_o__part1 = q + n2_o__part0;\n"), std::string::npos) << outside;
  EXPECT_NE(outside.find("if (step) begin q <= load ? n2_o__part0 : n3_o__part1; end else begin if (load) "
                         "begin q <= start; end end"),
            std::string::npos)
      << outside;
}

// A record of which one field is never assigned, and one is chosen from itself.
TEST(Netlist, WritesNoProcessForWhatNeverChanges) {
  const std::string netlist = R"(module m
  (input  clk,
   input  load,
   input  [3:0] d,
   output [6:0] o);
  wire [6:0] r;
  wire n1_o;
  wire [1:0] n2_o;
  wire [1:0] n3_o;
  wire [6:0] n4_o;
  reg [6:0] q;
  assign o = q;
  assign r = q;
  assign n1_o = r[4];
  assign n2_o = r[6:5];
  assign n3_o = load ? n2_o : n2_o;
  assign n4_o = {n3_o, n1_o, d};
  always @(posedge clk)
    q <= n4_o;
endmodule
)";
  const std::string outside = split_registers(netlist);
  EXPECT_NE(outside.find("  assign q = {q__2, q__1, q__0};\n"), std::string::npos) << outside;
  EXPECT_NE(outside.find("  always @(posedge clk)\n    q__0 <= d;\nendmodule\n"), std::string::npos)
      << outside;
  const std::string inside = split_registers(netlist, Wires::inside);
  EXPECT_EQ(inside.find("q__1 <="), std::string::npos) << inside;
  EXPECT_EQ(inside.find("q__2 <="), std::string::npos) << inside;
}

TEST(Netlist, LeavesAloneWhatItDoesNotUnderstand) {
  const std::string netlist =
      "module m\n  (input  clk,\n   input  a);\n  reg [3:0] mem[15:0] ; // memory\n  always @(posedge clk)\n"
      "    if (a)\n      mem[1] <= 4'b0;\n  initial begin\n    mem[0] = 4'b0001;\n  end\nendmodule\n";
  EXPECT_EQ(split_registers(netlist), netlist);
}

}  // namespace
}  // namespace halfway
