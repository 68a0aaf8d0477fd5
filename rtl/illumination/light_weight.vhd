-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The weight of a light at a point: (N.A)**x; for a spot, times the share of its cone.
--
--                                                              | clocks
--               L . axis              dot_product                | 2, exact 3
--               share of the cone     spot_cone                  | 8
--                 * (N.A)**x          product, cut               | 1
--
--             g_lead is the number of clocks from to_light to its cosine. The earlier one of cosine and share is delayed
--             to align with the other.
-- Contract    spot, axis, outer and slope must not change while a point is in the stages
-- Formats     to_light, axis: direction, three components, x lowest; outer: direction; slope: spot_slope; cosine,
--             weight: weight
-- Latency     0 without g_spot, otherwise light_weight_latency of terms_pkg, from cosine, in clocks
-- Throughput  1 per clock
-- Error       that of spot_cone, and (-1, 0] steps of weight: the product is cut
-- Source      ours: the processors paper has no spot lights
-- Golden twin model/golden/light_weight.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity light_weight is
  generic (
    g_exact : boolean := true;
    g_spot  : boolean := true; -- the light can be a spot
    g_lead  : natural
  );
  port (
    clk      : in  std_logic;
    spot     : in  std_logic; -- the light is one
    axis     : in  std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
    outer    : in  std_logic_vector(formats(g_exact).direction.bits - 1 downto 0);
    slope    : in  std_logic_vector(formats(g_exact).spot_slope.bits - 1 downto 0);
    to_light : in  std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
    cosine   : in  std_logic_vector(formats(g_exact).weight.bits - 1 downto 0);
    weight   : out std_logic_vector(formats(g_exact).weight.bits - 1 downto 0)
  );
end entity;

architecture rtl of light_weight is

  constant c_direction : positive := formats(g_exact).direction.bits;
  constant c_share     : positive := dot_product_latency(g_exact, true) + c_spot_cone_latency;
  constant c_both      : positive := larger(c_share, g_lead); -- clocks from to_light until both are valid

  subtype weight_t is std_logic_vector(weight'range);

begin

  narrowed : if g_spot generate

    signal dot         : std_logic_vector(2 * c_direction downto 0);
    signal share       : weight_t;
    signal share_both  : weight_t;
    signal cosine_both : weight_t;

  begin

    axis_product : entity work.dot_product
      generic map (
        g_bits   => c_direction,
        g_clocks => dot_product_latency(g_exact, true)
        )
      port map (
        clk    => clk,
        a      => to_light,
        b      => axis,
        sum    => dot
        );

    cone : entity work.spot_cone
      generic map (
        g_exact => g_exact
        )
      port map (
        clk      => clk,
        axis_sum => dot,
        outer    => outer,
        slope    => slope,
        factor   => share
        );

    align_share : entity work.delay_line
      generic map (
        g_bits  => share'length,
        g_depth => c_both - c_share
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => share,
        delayed => share_both
        );

    align_cosine : entity work.delay_line
      generic map (
        g_bits  => cosine'length,
        g_depth => c_both - g_lead
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => cosine,
        delayed => cosine_both
        );

    narrow : process (clk)
    begin
      if rising_edge(clk) then
        weight <= cosine_both;
        if spot = '1' then
          weight <= coned_weight(g_exact, unsigned(cosine_both) * unsigned(share_both));
        end if;
      end if;
    end process;

  else generate

    weight <= cosine;

  end generate;

end architecture;
