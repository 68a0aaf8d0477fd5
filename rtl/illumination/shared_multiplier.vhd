-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The folded processor's only three multipliers and their operands. In these clocks of schedule_pkg they
--             compute a vector product
--               scale_1, _2   the shifted vector times 1/sqrt of its square
--               until sum_1   the light's position times the point's distance (preset exact)
--               narrow        weight times a spot's factor, in the first component
--               weigh         their last product k I, times weight
--               others        k I, used in clock reflect
--             or a dot product, which is the sum of the three products
--               square_1, _2  the shifted vector times itself
--               axis          L times the axis of a spot's cone; k I if the light is no spot
--               sum_2         N times L, for a highlight in preset exact
--               cosine        N times A: L, or H of a highlight
--             The ambient processor computes only squares, and no dot product if it normalizes nothing.
-- Formats     factors: factor_a_bits and factor_b_bits of schedule_pkg; products: shared_product_bits, three components or
--             channels, the first lowest; directions: three components, x lowest; dot: dot_product; others: formats_pkg
-- Latency     products: vector_multiply_latency of shading_pkg: 1 clock, in preset exact 2
--             dot: dot_product_latency: 1 clock, in preset exact 3
-- Throughput  1 product per clock
-- Error       none
-- Source      processors paper, figures 1 and 2: the vector multiplication, the split dot product whose products are used
--             before their sum, and the multiplexers
-- Golden twin model/golden/vector_multiply.hpp, model/golden/dot_product.hpp

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
    normal   : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    to_light : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    half     : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    root     : in  std_logic_vector(formats(g_config.exact).root.bits downto 0);
    weight   : in  std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0);
    factor   : in  std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0);
    products : out std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0);
    dot      : out std_logic_vector(2 * formats(g_config.exact).direction.bits downto 0)
  );
end entity;

architecture rtl of shared_multiplier is

  constant c_exact   : boolean    := g_config.exact;
  constant c_shape   : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at      : schedule_t := schedule(g_config, g_kind, g_light);
  constant c_a       : positive   := factor_a_bits(g_config, g_kind, g_light);
  constant c_b       : positive   := factor_b_bits(g_config, g_kind, g_light);
  constant c_product : positive   := c_a + c_b;
  constant c_square  : positive   := 2 * formats(c_exact).direction.bits;
  constant c_k_i     : positive   := formats(c_exact).coefficient.bits + formats(c_exact).light_intensity.bits;

  subtype reflections_t is std_logic_vector(g_config.channels * formats(c_exact).reflected.bits - 1 downto 0);

  signal spot : std_logic; -- the light is one
  signal a    : std_logic_vector(c_axes * c_a - 1 downto 0);
  signal b    : std_logic_vector(c_axes * c_b - 1 downto 0);

  signal reflections : reflections_t; -- k I, rounded

begin

  assert c_at.reflect /= c_at.square_1 and c_at.reflect /= c_at.square_2 and c_at.reflect /= c_at.cosine
    and c_at.reflect /= c_at.axis and c_at.reflect /= c_at.sum_2 and c_at.reflect /= c_at.scale_1
    and c_at.reflect /= c_at.scale_2 and c_at.reflect /= c_at.narrow
    report "shared_multiplier: clock " & integer'image(c_at.reflect) & " would compute k I and another product"
    severity failure;

  spot <= light(light_axes_header(c_exact).spot.low) when c_shape.spots else '0';

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
    if (c_shape.first and cycle = c_at.square_1) or (c_shape.second and cycle = c_at.square_2) then
      a <= widened(shifted, c_a);
      b <= widened(shifted, c_b);
    elsif (c_shape.first and cycle = c_at.scale_1) or (c_shape.second and cycle = c_at.scale_2) then
      a <= widened(shifted, c_a);
      b <= widened(repeated('0' & root), c_b);
    elsif c_shape.far and cycle < c_at.sum_1 then
      a <= widened(light_place(c_exact, light), c_a);
      b <= widened(repeated(distance_of(g_config, token)), c_b);
    elsif c_shape.spots and cycle = c_at.narrow then
      a <= std_logic_vector(resize(unsigned(weight), a'length));
      b <= std_logic_vector(resize(unsigned(factor), b'length));
    elsif c_shape.spots and cycle = c_at.axis and spot = '1' then
      a <= widened(to_light, c_a);
      b <= widened(light_axis(c_exact, light), c_b);
    elsif (g_kind = c_diffuse and cycle = c_at.cosine)
      or (g_kind = c_specular and c_exact and cycle = c_at.sum_2) then
      a <= widened(normal, c_a);
      b <= widened(to_light, c_b);
    elsif g_kind = c_specular and cycle = c_at.cosine then
      a <= widened(normal, c_a);
      b <= widened(half, c_b);
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

  dots : if has_dot_product(g_config, g_kind, g_light) generate

    signal sum : signed(dot'range);

  begin

    add : process (all)
      variable v : signed(dot'range);
    begin
      v := (others => '0');
      for axis in 0 to c_axes - 1 loop
        v := v + signed(products(axis * c_product + c_square - 1 downto axis * c_product));
      end loop;
      sum <= v;
    end process;

    registered : if dot_product_latency(c_exact, false) > vector_multiply_latency(c_exact) generate

      hold : process (clk)
      begin
        if rising_edge(clk) then
          dot <= std_logic_vector(sum);
        end if;
      end process;

    else generate

      dot <= std_logic_vector(sum);

    end generate;

  else generate

    dot <= (others => '0');

  end generate;

end architecture;
