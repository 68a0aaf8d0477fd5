// SPDX-License-Identifier: Apache-2.0
#include "sim/extras/lanes/register_names.hpp"

#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

// As GHDL prints a top with copies of an entity and a block. r is a record of four fields.
constexpr const char* c_netlist = R"(entity stage is
architecture rtl of stage is
  signal n5_q : std_logic_vector (17 downto 0);
begin
  out_x <= n5_q;
  -- rtl/stage.vhd:1:8
  r <= n5_q; -- (signal)
  -- rtl/stage.vhd:3:14
  n1_o <= r (0);
  -- rtl/stage.vhd:4:10
  n2_o <= r (12 downto 1);
  -- rtl/stage.vhd:5:16
  n3_o <= r (8 downto 5);
  -- rtl/stage.vhd:6:12
  n4_o <= r (12);
  n6_o <= r (16 downto 13);
  n7_q <= n1_o;
end rtl;
architecture rtl of top is
begin
  stages_n2_first_stage : entity work.stage port map (
    clk => clk,
  -- rtl/top.vhd:5:12
  block_r <= n8_q; -- (signal)
  -- rtl/top.vhd:6:12
  n9_o <= block_r (3 downto 0);
end rtl;
)";
constexpr const char* c_stage = R"(signal r, r_next : reg_t;

  valid <= r.valid;
  y <= r.y + 1;
  first <= r.y.first;
  n4 <= r.y(11);
)";
constexpr const char* c_top = R"(  stages : for number in 0 to 3 generate
    first : if g_first generate
      stage : entity work.stage
  block : if g_exact generate
    signal r : reg_t;
    z <= r.depth;
)";

using RegisterNamesTest = FolderTest;

TEST_F(RegisterNamesTest, AreThoseOfTheRtl) {
  write("rtl/stage.vhd", c_stage);
  write("rtl/top.vhd", c_top);
  const RegisterNames names(c_netlist, here());

  const std::string stage = "top.stages_n2_first_stage.n5_q";
  EXPECT_EQ(names.name(stage, 18, 0, 1), "stages(1)/first/stage/r.valid");
  EXPECT_EQ(names.name(stage, 18, 1, 12), "stages(1)/first/stage/r.y");
  EXPECT_EQ(names.name(stage, 18, 3, 4), "stages(1)/first/stage/r.y(5 downto 2)");
  EXPECT_EQ(names.name(stage, 18, 12, 1), "stages(1)/first/stage/r.y(11)");
  EXPECT_EQ(names.name(stage, 18, 13, 4), "stages(1)/first/stage/r(16 downto 13)");
  EXPECT_EQ(names.name(stage, 18, 10, 6), "stages(1)/first/stage/r(15 downto 10)");
  EXPECT_EQ(names.name(stage, 18, 0, 18), "stages(1)/first/stage/r");
  EXPECT_EQ(names.name("top.n8_q", 4, 0, 4), "block/r.depth");
  EXPECT_EQ(names.name("top.n7_q", 1, 0, 1), "n7_q");
  EXPECT_EQ(names.name("top.unknown.n5_q", 2, 1, 1), "unknown/n5_q(1)");
}

TEST(RegisterNames, HavePathsOfSignalsThatAreNotRegisters) {
  const RegisterNames names(c_netlist, "/nonexistent");
  EXPECT_EQ(names.path("top.stages_n2_first_stage.n5_q"), "stages_n2_first_stage/r");
  EXPECT_EQ(names.path("top.stages_n2_first_stage.x"), "stages_n2_first_stage/x");
  EXPECT_EQ(names.path("top.x"), "x");
}

TEST(RegisterNames, AreTheNetlistsWithoutTheRtl) {
  EXPECT_EQ(RegisterNames().name("top.stages_n2_first_stage.n5_q", 18, 1, 12),
            "stages_n2_first_stage/n5_q(12 downto 1)");
  // The files cannot be read.
  EXPECT_EQ(RegisterNames(c_netlist, "/nonexistent").name("top.n8_q", 4, 0, 1), "block_r(0)");
}

TEST(RegisterNames, ChangeTheKeyOfACache) {
  EXPECT_EQ(RegisterNames().text(), "");
  EXPECT_NE(RegisterNames(c_netlist, "/nonexistent").text(), "");
}

}  // namespace
}  // namespace halfway
