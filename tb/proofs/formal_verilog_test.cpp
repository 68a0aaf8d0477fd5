// SPDX-License-Identifier: Apache-2.0
#include "formal_verilog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfway::proofs {
namespace {

using testing::HasSubstr;

TEST(FormalVerilog, WritesAssertAndAssumeAsYosysReadsThem) {
  const auto formal = formal_verilog(
      "module m;\n"
      "  always @*\n    if (!n1_o)\n      $fatal(1, \"assertion failure holds\");\n"
      "  stays: assert n2_o = '1' severity warning; --  assume\n"
      "  assign ghost = 8'bX; // (signal)\n"
      "endmodule\n",
      "m");
  ASSERT_TRUE(formal) << formal.error().message;
  EXPECT_EQ(formal->text,
            "module m;\n"
            "  always @* stays: assume (n2_o);\n"
            "  always @* holds: assert (n1_o);\n"
            "endmodule\n");
  EXPECT_EQ(formal->counts, (PropertyCounts{1, 1}));
}

TEST(FormalVerilog, StartsWithAResetAndChecksFromTheSecondClockOn) {
  const std::string assertion =
      "  always @*\n    if (!n1_o)\n      $fatal(1, \"assertion failure holds\");\n";
  const std::string started = "  reg proof_started = 0;\n  always @(posedge clk) proof_started <= 1;\n",
                    starts = "  always @* assume (proof_started || reset);\n",
                    holds = "  always @* holds: assert (!proof_started || n1_o);\nendmodule\n";
  const std::string inner = "module x\n  (input  clk);\n", top = "module m\n   input  reset);\n";
  const auto formal =
      formal_verilog(inner + assertion + "endmodule\n" + top + assertion + "endmodule\n", "m");
  ASSERT_TRUE(formal) << formal.error().message;
  EXPECT_EQ(formal->text, inner + started + holds + top + started + starts + holds);
  const std::string own = "  m_starts: assert n2_o = '1' severity warning; --  assume\n";
  EXPECT_EQ(formal_verilog(top + own + assertion + "endmodule\n", "m")->text,
            top + started + "  always @* m_starts: assume (n2_o);\n" + holds);
}

TEST(FormalVerilog, DropsTheAssertionsOfTheRtl) {
  const auto formal =
      formal_verilog("  always @*\n    if (!n45_q)\n      $fatal(1, \"assertion failure n34\");\n", "m");
  ASSERT_TRUE(formal) << formal.error().message;
  EXPECT_EQ(formal->text, "");
  EXPECT_EQ(formal->counts, (PropertyCounts{0, 0}));
}

TEST(FormalVerilog, ConnectsAFreeSignalToThatInsideTheInstance) {
  const auto formal = formal_verilog("  assign dut_edge_value = 40'bX; // (signal)\n", "m");
  ASSERT_TRUE(formal) << formal.error().message;
  EXPECT_EQ(formal->text,
            "  (* hierconn *) wire [39:0] \\dut.edge_value ;\n"
            "  assign dut_edge_value = \\dut.edge_value ;\n");
}

TEST(FormalVerilog, WritesWideConstantsAsNumbers) {
  const auto formal = formal_verilog("assign a = \"0101\";\nassign b = \"text\";\n", "m");
  ASSERT_TRUE(formal) << formal.error().message;
  EXPECT_EQ(formal->text, "assign a = 4'b0101;\nassign b = \"text\";\n");
}

TEST(FormalVerilog, RefusesAConstantThatLostItsSign) {
  const std::string word = '1' + std::string(31, '0');
  const auto negative = formal_verilog("assign a = \"00000000" + word + "\";\n", "m");
  ASSERT_FALSE(negative);
  EXPECT_THAT(negative.error().message, HasSubstr("GHDL lost the sign"));
  EXPECT_TRUE(formal_verilog("assign a = \"00000001" + word + "\";\n", "m"));
  EXPECT_TRUE(formal_verilog("assign a = \"" + word + "\";\n", "m"));
}

TEST(FormalVerilog, RefusesAnAssertionInAnotherForm) {
  EXPECT_FALSE(
      formal_verilog("  always @(posedge clk)\n    if (!n1_o)\n      $fatal(1, \"failure x\");\n", "m"));
}

TEST(CountProperties, CountsLabelledStatementsOutsideComments) {
  const auto counts = count_properties(
      "  a : assert always x;\n  b : assume always y; -- c : assume z\n  -- d : assert always w;\n  assert_x "
      ":= 1;\n");
  EXPECT_EQ(counts, (PropertyCounts{1, 1}));
}

}  // namespace
}  // namespace halfway::proofs
