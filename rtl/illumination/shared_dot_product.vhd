-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The folded processor's only dot product and its operands. In these clocks of schedule_pkg it computes
--               square_1, _2  the shifted vector times itself
--               axis          L times the axis of a spot's cone
--               sum_2         N times L, for a highlight in preset exact
--               others        N times A: L, or H of a highlight
--             The ambient processor computes only squares.
-- Formats     directions: direction, three components, x lowest; dot: dot_product
-- Latency     dot_product_latency of shading_pkg: 1 clock, in preset exact 3
-- Throughput  1 product per clock
-- Error       none
-- Source      processors paper, figures 1 and 2: the dot product with its multiplexers
-- Golden twin model/golden/dot_product.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity shared_dot_product is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk      : in  std_logic;
    cycle    : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    shifted  : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    normal   : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    to_light : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    half     : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    axis     : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    dot      : out std_logic_vector(2 * formats(g_config.exact).direction.bits downto 0)
  );
end entity;

architecture rtl of shared_dot_product is

  constant c_shape : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at    : schedule_t := schedule(g_config, g_kind, g_light);

  signal a, b : std_logic_vector(shifted'range);

begin

  operands : process (all)
  begin
    a <= normal;
    b <= to_light;
    if g_kind = c_specular and not (g_config.exact and cycle = c_at.sum_2) then
      b <= half;
    end if;
    if c_shape.spots and cycle = c_at.axis then
      a <= to_light;
      b <= axis;
    end if;
    if g_kind = c_ambient or (c_shape.first and cycle = c_at.square_1) or (c_shape.second and cycle = c_at.square_2) then
      a <= shifted;
      b <= shifted;
    end if;
  end process;

  multiply : entity work.dot_product
    generic map (
      g_bits   => formats(g_config.exact).direction.bits,
      g_clocks => dot_product_latency(g_config.exact, false)
      )
    port map (
      clk    => clk,
      a      => a,
      b      => b,
      sum    => dot
      );

end architecture;
