// SPDX-License-Identifier: Apache-2.0
#include "equivalence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace halfway::mutants {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(Netlist, IsTheSameWhateverItsNumbersAndComments) {
  const Netlist a = netlist_of(
      "module one\n  (input n1);\n  wire n12_o;\n  /* a.vhd:3:4 */\n  assign n12_o = n1; // here\nendmodule\n"
      "module two\n  (input x);\nendmodule\n",
      "two");
  const Netlist b =
      netlist_of("module one\n  (input n7);\n  wire n99_o;\n  assign n99_o = n7;\nendmodule\n", "one");
  ASSERT_EQ(a.modules.size(), 2U);
  EXPECT_EQ(a.modules.at("two"), "module two\n  (input x);\nendmodule\n");
  EXPECT_THAT(a.modules.at("one"), HasSubstr("assign n1_o = n0;"));
  EXPECT_THAT(b.modules.at("one"), HasSubstr("assign n1_o = n0;"));
}

TEST(Netlist, TellsNetsApart) {
  const auto text = [](const char* verilog) { return netlist_of(verilog, "m").modules.at("m"); };
  EXPECT_NE(text("module m\n  assign n1_o = n2_o & n3_o;\nendmodule\n"),
            text("module m\n  assign n1_o = n2_o & n2_o;\nendmodule\n"));
  EXPECT_NE(text("module m\n  assign n1_o = a;\nendmodule\n"),
            text("module m\n  assign n1_o = b;\nendmodule\n"));
}

constexpr const char* c_memory =
    "  reg [7:0] words[15:0] ; // memory\n  always @(posedge clk)\n    if (enable)\n      n4_data <= "
    "words[index];\n"
    "  always @(posedge clk)\n    if (writes)\n      words[place] <= word;\n";

TEST(Memories, AreOpened) {
  const std::string opened = with_open_memories(std::string("module m\n") + c_memory + "endmodule\n");
  EXPECT_THAT(opened, HasSubstr("n4_data <= words_read__;"));
  EXPECT_THAT(opened, HasSubstr("(* keep *) wire [31:0] words_from_told__ = enable ? index : 0;"));
  EXPECT_THAT(opened, HasSubstr("words_to_told__ = writes ? place : 0;"));
  EXPECT_THAT(opened, HasSubstr("words_word_told__ = writes ? word : 0;"));
  EXPECT_THAT(opened, Not(HasSubstr("words[")));
}

TEST(Memories, OfTwoNamesOrOfConstantsStay) {
  std::string other = c_memory;
  other.replace(other.find("words[index]"), 5, "table");
  EXPECT_EQ(with_open_memories(other), other);
  const std::string rom =
      "  reg [7:0] n8[1:0] ; // memory\n  initial begin\n    n8[1] = 8'b00000001;\n    end\n";
  EXPECT_EQ(with_open_memories(rom), rom);
}

}  // namespace
}  // namespace halfway::mutants
