-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The steps of a normalization that are not products: the block shift (shift left until the largest
--             component fills the word), 1/sqrt of the shifted vector's square, and rounding of the scaled vector to a
--             direction. The square and the scaled vector come from shared_multiplier.
-- Contract    vector is valid in shift_1 and shift_2 of schedule_pkg; shifted does not change until the next of them
-- Formats     vector: normalized_bits of schedule_pkg per component; dot: dot_product; products: shared_multiplier;
--             shifted, unit: direction; root: reciprocal_root. A vector is three components, x lowest.
-- Latency     vector to shifted 1 clock, dot to root reciprocal_root_latency, products to unit 0
-- Throughput  that of schedule_pkg
-- Error       that of unit_vector
-- Source      processors paper, figure 2: 1/sqrt by a table; ours: the block shift
-- Golden twin model/golden/unit_vector.hpp (normalized)

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity shared_normalizer is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk      : in  std_logic;
    cycle    : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    vector   : in  std_logic_vector(c_axes * normalized_bits(g_config, g_kind, g_light) - 1 downto 0);
    dot      : in  std_logic_vector(2 * formats(g_config.exact).direction.bits downto 0);
    products : in  std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0);
    shifted  : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    root     : out std_logic_vector(formats(g_config.exact).root.bits downto 0);
    unit     : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of shared_normalizer is

  constant c_exact      : boolean    := g_config.exact;
  constant c_formats    : formats_t  := formats(c_exact);
  constant c_direction  : positive   := c_formats.direction.bits;
  constant c_shape      : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at         : schedule_t := schedule(g_config, g_kind, g_light);
  constant c_product    : positive   := shared_product_bits(g_config, g_kind, g_light);
  constant c_scaled     : positive   := c_direction + root'length + 1;
  constant c_square_low : natural    := 2 * (c_direction - 1) - c_formats.square.fraction;

  signal shift : std_logic;

begin

  shift <= '1' when (c_shape.first and cycle = c_at.shift_1) or (c_shape.second and cycle = c_at.shift_2) else '0';

  block_shift : entity work.vector_shift
    generic map (
      g_vector_bits => normalized_bits(g_config, g_kind, g_light),
      g_result_bits => c_direction,
      g_clocks      => vector_shift_latency(false)
      )
    port map (
      clk        => clk,
      enable     => shift,
      components => vector,
      shifted    => shifted
      );

  reciprocal_root : entity work.reciprocal_root
    generic map (
      g_exact => c_exact
      )
    port map (
      clk        => clk,
      square     => dot(c_square_low + c_formats.square.bits - 1 downto c_square_low),
      reciprocal => root
      );

  round : process (all)
  begin
    for axis in 0 to c_axes - 1 loop
      unit((axis + 1) * c_direction - 1 downto axis * c_direction) <=
        unit_direction(c_exact, signed(products(axis * c_product + c_scaled - 1 downto axis * c_product)));
    end loop;
  end process;

end architecture;
