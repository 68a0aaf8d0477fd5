-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The folded processor's only vector product and its operands. In these clocks of schedule_pkg it computes
--               scale_1, _2   the shifted vector times 1/sqrt of its square
--               until sum_1   the light's position times the point's distance (preset exact)
--               narrow        weight times a spot's factor, in the first component
--               weigh         its last product k I, times weight
--               others        k I
-- Formats     factors: factor_a_bits and factor_b_bits of schedule_pkg; products: shared_product_bits, three components or
--             channels, the first lowest; others: formats_pkg
-- Latency     vector_multiply_latency of shading_pkg: 1 clock, in preset exact 2
-- Throughput  1 product per clock
-- Error       none
-- Source      processors paper, figures 1 and 2: the vector multiplication with its multiplexers
-- Golden twin model/golden/vector_multiply.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.vector_pkg.all;

entity shared_multiplier is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk      : in  std_logic;
    cycle    : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    token    : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    light    : in  std_logic_vector(light_bits(g_config) - 1 downto 0);
    shifted  : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    root     : in  std_logic_vector(formats(g_config.exact).root.bits downto 0);
    weight   : in  std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0);
    factor   : in  std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0);
    products : out std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0)
  );
end entity;

architecture rtl of shared_multiplier is

  constant c_exact   : boolean    := g_config.exact;
  constant c_shape   : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at      : schedule_t := schedule(g_config, g_kind, g_light);
  constant c_a       : positive   := factor_a_bits(g_config, g_kind, g_light);
  constant c_b       : positive   := factor_b_bits(g_config, g_kind, g_light);
  constant c_product : positive   := c_a + c_b;
  constant c_k_i     : positive   := formats(c_exact).coefficient.bits + formats(c_exact).light_intensity.bits;

  subtype reflections_t is std_logic_vector(g_config.channels * formats(c_exact).reflected.bits - 1 downto 0);

  signal a : std_logic_vector(c_axes * c_a - 1 downto 0);
  signal b : std_logic_vector(c_axes * c_b - 1 downto 0);

  signal reflections : reflections_t; -- k I, rounded

begin

  round : process (all)
    constant c_bits : positive := formats(c_exact).reflected.bits;
  begin
    for channel in 0 to g_config.channels - 1 loop
      reflections((channel + 1) * c_bits - 1 downto channel * c_bits) <=
        reflected(c_exact, unsigned(products(channel * c_product + c_k_i - 1 downto channel * c_product)));
    end loop;
  end process;

  operands : process (all)
  begin
    if (c_shape.first and cycle = c_at.scale_1) or (c_shape.second and cycle = c_at.scale_2) then
      a <= widened(shifted, c_a);
      b <= widened(repeated('0' & root), c_b);
    elsif c_shape.far and cycle < c_at.sum_1 then
      a <= widened(light_place(c_exact, light), c_a);
      b <= widened(repeated(distance_of(g_config, token)), c_b);
    elsif c_shape.spots and cycle = c_at.narrow then
      a <= std_logic_vector(resize(unsigned(weight), a'length));
      b <= std_logic_vector(resize(unsigned(factor), b'length));
    elsif g_kind /= c_ambient and cycle = c_at.weigh then
      a <= widened(positive_words(reflections, g_config.channels), c_a);
      b <= widened(repeated('0' & weight), c_b);
    else
      a <= widened(positive_words(coefficients_of(g_config, g_kind, token), g_config.channels), c_a);
      b <= widened(positive_words(intensities_of(g_config, light), g_config.channels), c_b);
    end if;
  end process;

  multiply : entity work.vector_multiply
    generic map (
      g_a_bits => c_a,
      g_b_bits => c_b,
      g_clocks => vector_multiply_latency(c_exact)
      )
    port map (
      clk      => clk,
      a        => a,
      b        => b,
      products => products
      );

end architecture;
