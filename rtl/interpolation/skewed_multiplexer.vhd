-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Selects one of two skewed words (skew_pkg): each part is selected one clock after the part below it.
-- Contract    a and b are skewed words, part 0 in the clock of select_b
-- Formats     g_bits of anything
-- Latency     none: value is a skewed word, part 0 in the clock of select_b
-- Throughput  1 word per clock
-- Error       none
-- Source      quadratic paper, figure 6, whose edges have one step; ours have two
-- Golden twin none: a choice

library ieee;
use ieee.std_logic_1164.all;
use work.skew_pkg.all;

entity skewed_multiplexer is
  generic (
    g_bits  : positive;
    g_parts : positive := 1
  );
  port (
    clk      : in  std_logic;
    select_b : in  std_logic;
    a        : in  std_logic_vector(g_bits - 1 downto 0);
    b        : in  std_logic_vector(g_bits - 1 downto 0);
    value    : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of skewed_multiplexer is

  signal selects : std_logic_vector(g_parts - 1 downto 0);

begin

  skewed_select : entity work.skewed_strobe
    generic map (g_parts => g_parts)
    port map (clk => clk, strobe => select_b, strobes => selects);

  parts : for part in 0 to g_parts - 1 generate

    constant c_low  : natural := part_low(g_bits, g_parts, part);
    constant c_high : natural := part_low(g_bits, g_parts, part + 1) - 1;

  begin

    value(c_high downto c_low) <= b(c_high downto c_low) when selects(part) = '1' else a(c_high downto c_low);

  end generate;

end architecture;
