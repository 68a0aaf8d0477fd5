-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     (N.A)**x: the cosine of the angle between two directions, 0 if it is negative, to the power of the
--             highlight's exponent. Of a diffuse term, the cosine itself.
--
--                                                            | clocks
--               N.A, clamped to 0 to 1           dot_product | 2, exact 3
--               cosine**exponent                 power       | power_latency of shading_pkg
--                 or the cosine, rounded half up             | 1
--
-- Formats     normal, direction: direction, three components, x lowest; exponent: exponent (not used without
--             g_highlight); result: weight
-- Latency     cosine_power_latency of terms_pkg, clocks (published, exact): 3, 4 without g_highlight, otherwise
--             9, 14
-- Throughput  1 per clock
-- Error       that of power; without g_highlight half a step of weight
-- Source      processors paper, equation 5 and figure 1: (N.A)**x
-- Golden twin model/golden/cosine_power.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity cosine_power is
  generic (
    g_exact     : boolean := true;
    g_highlight : boolean := true -- with an exponent
  );
  port (
    clk       : in  std_logic;
    normal    : in  std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
    direction : in  std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
    exponent  : in  std_logic_vector(formats(g_exact).exponent.bits - 1 downto 0);
    result    : out std_logic_vector(formats(g_exact).weight.bits - 1 downto 0)
  );
end entity;

architecture rtl of cosine_power is

  constant c_direction : positive := formats(g_exact).direction.bits;

  signal dot    : std_logic_vector(2 * c_direction downto 0);
  signal angle  : unsigned(formats(g_exact).direction.fraction downto 0); -- its cosine

begin

  dot_product : entity work.dot_product
    generic map (
      g_bits   => c_direction,
      g_clocks => dot_product_latency(g_exact, true)
      )
    port map (
      clk    => clk,
      a      => normal,
      b      => direction,
      sum    => dot
      );

  angle <= cosine(g_exact, signed(dot));

  highlight : if g_highlight generate

    signal exponent_q : std_logic_vector(exponent'range);

  begin

    align_exponent : entity work.delay_line
      generic map (
        g_bits  => exponent'length,
        g_depth => dot_product_latency(g_exact, true)
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => exponent,
        delayed => exponent_q
        );

    raise : entity work.power
      generic map (
        g_exact => g_exact
        )
      port map (
        clk      => clk,
        base     => std_logic_vector(angle),
        exponent => exponent_q,
        result   => result
        );

  else generate

    round : process (clk)
    begin
      if rising_edge(clk) then
        result <= cosine_weight(g_exact, angle);
      end if;
    end process;

  end generate;

end architecture;
