// SPDX-License-Identifier: Apache-2.0
#include "sim/engines/ghdl/ghdl_library.hpp"

#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

TEST(BareVhdl, HasNoCommentsAndOneSpace) {
  EXPECT_EQ(bare_vhdl("A  <= b; -- c\n\n  d <= \"-- E\";\n"), "a <= b; d <= \"-- E\"; ");
  EXPECT_EQ(bare_vhdl("x; -- \"\ny;"), bare_vhdl("x;\n  y;"));
  EXPECT_EQ(bare_vhdl("a/* b\n -- */<= c;"), "a <= c;");
  EXPECT_NE(bare_vhdl("a <= b;"), bare_vhdl("a <= c;"));
}

TEST(BareVhdl, KeepsLiterals) {
  // A quote as a character begins no string, and no comment is in a literal.
  EXPECT_EQ(bare_vhdl("c = '\"' -- A\nD"), "c = '\"' d");
  EXPECT_NE(bare_vhdl("a = \"--1\";"), bare_vhdl("a = \"--2\";"));
  EXPECT_NE(bare_vhdl("\\a--1\\"), bare_vhdl("\\a--2\\"));
  EXPECT_NE(bare_vhdl("a = 'X';"), bare_vhdl("a = 'x';"));
}

constexpr const char* c_entity = R"(library ieee;
use ieee.std_logic_1164.all;
entity held is
  generic (g_bits : positive := 4);
  port (clk : in std_logic; d : in std_logic_vector(g_bits - 1 downto 0);
        q : out std_logic_vector(g_bits - 1 downto 0));
end entity;
architecture rtl of held is
begin
  hold : process (clk)
  begin
    if rising_edge(clk) then
      q <= d;
    end if;
  end process;
end architecture;
)";

using GhdlLibraryTest = FolderTest;

TEST_F(GhdlLibraryTest, KeepsNetlistsByEntityGenericsAndSources) {
  auto tool = must(GhdlTool::find());
  const auto synthesize = [&](const std::string& source, const char* bits) -> Result<std::string> {
    const auto library = GhdlLibrary::for_synthesis(tool, {{"held.vhd", source}}, here());
    if (!library) return library.error();
    return library->synthesize("held", {{"g_bits", bits}});
  };
  const auto four = synthesize(c_entity, "4"), seven = synthesize(c_entity, "7");
  ASSERT_TRUE(four && seven) << (four ? seven : four).error().message;
  EXPECT_NE(*four, *seven);
  std::string other = c_entity;
  other.replace(other.find("q <= d"), 6, "q <= not d");
  const auto inverted = must(synthesize(other, "4"));
  EXPECT_NE(inverted, *four);
  // Without GHDL, only cached results are available.
  tool.program = at("none").string();
  for (const auto& [source, bits, text] : {std::tuple{std::string(c_entity), "4", *four},
                                           {std::string(c_entity), "7", *seven},
                                           {other, "4", inverted}}) {
    const auto kept = must(synthesize(source, bits));
    EXPECT_EQ(kept, text);
  }
  EXPECT_FALSE(synthesize(c_entity, "5"));
}

}  // namespace
}  // namespace halfway
