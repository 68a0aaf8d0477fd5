-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A line_interpolator of a skewed word (skew_pkg): takes a start value, then adds an increment per step. Each part
--             is a part_interpolator; its carry reaches the part above one clock later.
-- Contract    load and step are never both '1'. start and increment are skewed words, part 0 in the strobe's clock
-- Formats     g_bits of two's complement; sums wrap, modulo 2**g_bits
-- Latency     1 clock from load or step to part 0 of value; value is a skewed word
-- Throughput  1 step per clock
-- Error       adds none: k steps carry k times the increment's rounding
-- Source      quadratic paper, figure 6: a register with its adder; spherical paper, figure 12
-- Golden twin model/golden/line_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.skew_pkg.all;

entity skewed_interpolator is
  generic (
    g_bits  : positive;
    g_parts : positive := 1
  );
  port (
    clk       : in  std_logic;
    load      : in  std_logic; -- not with step
    start     : in  std_logic_vector(g_bits - 1 downto 0);
    step      : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    value     : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of skewed_interpolator is

  signal loads, steps : std_logic_vector(g_parts - 1 downto 0);
  signal carries      : std_logic_vector(g_parts downto 0); -- into each part, and out of the last

begin

  skewed_load : entity work.skewed_strobe
    generic map (g_parts => g_parts)
    port map (clk => clk, strobe => load, strobes => loads);

  skewed_step : entity work.skewed_strobe
    generic map (g_parts => g_parts)
    port map (clk => clk, strobe => step, strobes => steps);

  carries(0) <= '0';

  parts : for part in 0 to g_parts - 1 generate

    constant c_low  : natural := part_low(g_bits, g_parts, part);
    constant c_high : natural := part_low(g_bits, g_parts, part + 1) - 1;

  begin

    interpolator : entity work.part_interpolator
      generic map (g_bits => c_high - c_low + 1)
      port map (
        clk       => clk,
        load      => loads(part),
        start     => start(c_high downto c_low),
        step      => steps(part),
        increment => increment(c_high downto c_low),
        carry_in  => carries(part),
        value     => value(c_high downto c_low),
        carry_out => carries(part + 1));

  end generate;

end architecture;
