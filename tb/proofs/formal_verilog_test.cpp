// SPDX-License-Identifier: Apache-2.0
#include "formal_verilog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfway::proofs {
namespace {

using testing::HasSubstr;

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

}  // namespace
}  // namespace halfway::proofs
