// SPDX-License-Identifier: Apache-2.0
#include "vhdl_text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/ghdl/ghdl_library.hpp"

namespace halfway::mutants {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr std::string_view c_entity = R"(-- and '0' < 3
library ieee;
entity e is
  generic (g_bits : positive := 4);
  port (
    clk  : in  std_logic;
    step : in  std_logic;
    a, b : in  std_logic_vector(g_bits - 1 downto 0);
    c    : out std_logic
  );
end entity;
architecture rtl of e is
  subtype word_t is unsigned(7 downto 0);
  type pair_t is record
    low  : word_t;
    high : word_t;
  end record;
  type reg_t is record
    valid : std_logic;
    pair  : pair_t;
    count : natural;
  end record;
  signal r, r_next : reg_t;
  -- synthesis translate_off
  constant c_seen : natural := 7;
  -- synthesis translate_on
begin
  assert g_bits > 2 report "and 3 < 4" severity failure;
  c <= r.valid when a = b else '0';
  inner : entity work.inner
    generic map (g_count => 5)
    port map (clk => clk, load => step, word => a, value => open);
  registers : process (clk)
  begin
    if rising_edge(clk) then
      if step = '1' and r.count < 9 then
        r <= r_next;
      end if;
    end if;
  end process;
end architecture;
)";

Outline outline(std::string_view text = c_entity) {
  auto read = outline_of("e.vhd", text);
  EXPECT_TRUE(read) << read.error().message;
  return read ? *read : Outline{};
}

// What the operator makes, `from -> to`.
std::vector<std::string> made(Operator by, std::string_view text = c_entity) {
  std::vector<std::string> all;
  for (const Change& change : outline(text).changes)
    if (change.by == by)
      all.push_back(std::string(text.substr(change.begin, change.end - change.begin)) + " -> " + change.to);
  return all;
}

TEST(VhdlText, ChangesWhatDecides) {
  EXPECT_THAT(made(Operator::logic), ElementsAre("and -> or"));
  EXPECT_THAT(made(Operator::relation), ElementsAre("= -> /=", "= -> /=", "< -> <="));
  EXPECT_THAT(made(Operator::bit), ElementsAre("'0' -> '1'", "'1' -> '0'"));
  EXPECT_THAT(made(Operator::number), ElementsAre("5 -> 6", "5 -> 4", "9 -> 10", "9 -> 8"));
  EXPECT_THAT(made(Operator::condition),
              ElementsAre("a = b -> true", "a = b -> false", "step = '1' and r.count < 9 -> true",
                          "step = '1' and r.count < 9 -> false"));
  EXPECT_THAT(made(Operator::enable), ElementsAre("step -> '1'", "a -> not (a)"));
  EXPECT_THAT(made(Operator::drop), ElementsAre("r <= r_next; -> null;"));
}

TEST(VhdlText, TakesAnotherNameOfTheSameTypeAlone) {
  const auto names = made(Operator::name);
  EXPECT_THAT(names, Contains("a -> b"));
  EXPECT_THAT(names, Contains("r_next -> r"));
  EXPECT_THAT(names, Not(Contains("step -> clk")));
  EXPECT_THAT(names, Not(Contains("valid -> count")));
}

TEST(VhdlText, ChangesATableByBits) {
  constexpr std::string_view table =
      "package p is\nend package;\npackage body p is\n"
      "  constant c_rom : sine_table_t(0 to 2) := (0, 255, 3);\nend package body;\n";
  EXPECT_THAT(made(Operator::rom, table), ElementsAre("0 -> 1", "255 -> 253", "3 -> 7"));
  EXPECT_THAT(made(Operator::number, table), IsEmpty());
}

TEST(VhdlText, KnowsStatementsConditionsAndSignals) {
  const Outline all = outline();
  EXPECT_EQ(all.architecture_of, "e");
  std::vector<std::size_t> lines;
  for (const Statement& s : all.statements) lines.push_back(line_of(c_entity, s.at));
  EXPECT_THAT(lines, ElementsAre(29, 30, 33, 35, 36, 37));
  ASSERT_EQ(all.conditions.size(), 2U);
  EXPECT_EQ(c_entity.substr(all.conditions[0].begin, all.conditions[0].end - all.conditions[0].begin),
            "a = b");
  std::vector<std::string> names;
  for (const Watched& w : all.watched) names.push_back(w.name);
  EXPECT_THAT(names, ElementsAre("clk", "step", "a", "b", "c", "r.valid", "r.pair.low", "r.pair.high",
                                 "r_next.valid", "r_next.pair.low", "r_next.pair.high"));
  EXPECT_THAT(all.unwatched, ElementsAre("r.count", "r_next.count"));
}

TEST(VhdlText, RefusesWhatItDoesNotKnow) {
  const auto read =
      outline_of("e.vhd", "architecture rtl of e is\nbegin\n  with a select b <= '1' when others;\nend;\n");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, ::testing::HasSubstr("e.vhd:3"));
}

// So that no file of the RTL is without mutants.
TEST(VhdlText, ReadsAllOfTheRtl) {
  const auto rtl = read_rtl_sources(HALFWAY_SOURCE_DIR);
  ASSERT_TRUE(rtl);
  for (const VhdlSource& source : *rtl) {
    const auto read = outline_of(source.name, source.content);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_GE(read->changes.size(), 5U) << source.name;
    EXPECT_FALSE(read->statements.empty()) << source.name;
  }
}

}  // namespace
}  // namespace halfway::mutants
