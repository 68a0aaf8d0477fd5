-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A parameter_register of skewed words (skew_pkg): each part loads one clock after the part below it.
-- Contract    start holds skewed words, part 0 in the clock of load
-- Formats     g_words words of g_bits, the first lowest
-- Latency     1 clock from load to part 0 of value; value holds skewed words
-- Throughput  1 load per clock
-- Error       none
-- Source      parameter_register; the parts are ours
-- Golden twin model/golden/parameter_register.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.skew_pkg.all;

entity skewed_register is
  generic (
    g_bits  : positive;
    g_words : positive := 1;
    g_parts : positive := 1
  );
  port (
    clk   : in  std_logic;
    load  : in  std_logic;
    start : in  std_logic_vector(g_words * g_bits - 1 downto 0);
    value : out std_logic_vector(g_words * g_bits - 1 downto 0)
  );
end entity;

architecture rtl of skewed_register is

  signal loads : std_logic_vector(g_parts - 1 downto 0);

begin

  skewed_load : entity work.skewed_strobe
    generic map (g_parts => g_parts)
    port map (clk => clk, strobe => load, strobes => loads);

  words : for word in 0 to g_words - 1 generate

    parts : for part in 0 to g_parts - 1 generate

      constant c_low  : natural := word * g_bits + part_low(g_bits, g_parts, part);
      constant c_high : natural := word * g_bits + part_low(g_bits, g_parts, part + 1) - 1;

    begin

      part_register : entity work.parameter_register
        generic map (g_bits => c_high - c_low + 1)
        port map (
          clk   => clk,
          load  => loads(part),
          start => start(c_high downto c_low),
          value => value(c_high downto c_low));

    end generate;

  end generate;

end architecture;
