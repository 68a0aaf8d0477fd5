-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     H, the unit vector halfway between the directions to the light and to the eye.
--               preset exact      H = (L + V) / |L + V|
--               preset published  H = (E + (P_p - P)) / |E + (P_p - P)| as printed for a positional light;
--                                 for a directional light, the constant H from the light's registers
--
--                                                              | clocks
--               to_light + to_eye     sum of the vectors         | 1
--                 / length            unit_vector                | unit_vector_latency
--
-- Contract    preset published: positional and to_eye must not change while a vector is in the stages
-- Formats     to_light: direction in preset exact, offset in preset published; to_eye, half: direction. A vector is
--             three components, x lowest.
-- Latency     half_vector_latency of terms_pkg, clocks: 0 without g_normalize, otherwise 8 in preset
--             published and 16 in preset exact
-- Throughput  1 vector per clock
-- Error       that of unit_vector; the sum is exact, and wraps in preset published
-- Source      processors paper, equation 3 and figure 2 (the second vector adder)
-- Golden twin model/golden/half_vector.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.vector_pkg.all;

entity half_vector is
  generic (
    g_exact     : boolean := true;
    g_normalize : boolean := true -- H depends on the point; else to_eye is H
  );
  port (
    clk        : in  std_logic;
    positional : in  std_logic; -- preset published: the light has a position; otherwise to_eye is H
    to_light   : in  std_logic_vector(c_axes * half_light_bits(g_exact) - 1 downto 0);
    to_eye     : in  std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
    half       : out std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of half_vector is

  constant c_sum : positive := half_sum_bits(g_exact);

begin

  normalized : if g_normalize generate

    signal sum  : std_logic_vector(c_axes * c_sum - 1 downto 0);
    signal unit : std_logic_vector(half'range);

  begin

    add : process (clk)
    begin
      if rising_edge(clk) then
        sum <= sums(to_light, to_eye, c_sum);
      end if;
    end process;

    normalize : entity work.unit_vector
      generic map (
        g_exact       => g_exact,
        g_vector_bits => c_sum
        )
      port map (
        clk        => clk,
        components => sum,
        unit       => unit
        );

    half <= unit when g_exact or positional = '1' else to_eye;

  else generate

    half <= to_eye;

  end generate;

end architecture;
