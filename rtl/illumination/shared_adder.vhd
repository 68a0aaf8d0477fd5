-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The folded processor's vector adder, and the registers of the vectors L and H. In these clocks of
--             schedule_pkg it adds
--               sum_1         the vector to the light, P_p - P
--               sum_2         L + V; in preset published the vector to the light + E, as printed
--             and loads L and H in round_1 and round_2. Of a directional light L, and in preset published H, is a
--             constant in the light's registers.
-- Formats     products: shared_multiplier, in sum_1 the light's position on the point's scale (preset exact); sum:
--             normalized_bits of schedule_pkg per component; unit, to_light, half: direction. A vector is three
--             components, x lowest.
-- Latency     1 clock
-- Throughput  1 sum per clock
-- Error       half a step of offset in each component of the vector to the light
-- Source      processors paper, figure 2: the vector adders
-- Golden twin model/golden/light_vector.hpp (light_offset), model/golden/half_vector.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.vector_pkg.all;

entity shared_adder is
  generic (
    g_config : config_t;
    g_kind   : natural range c_diffuse to c_specular;
    g_light  : natural
  );
  port (
    clk        : in  std_logic;
    cycle      : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    positional : in  std_logic;
    token      : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    light      : in  std_logic_vector(light_bits(g_config) - 1 downto 0);
    products   : in  std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0);
    unit       : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    sum        : out std_logic_vector(c_axes * normalized_bits(g_config, g_kind, g_light) - 1 downto 0);
    to_light   : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    half       : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of shared_adder is

  constant c_exact : boolean    := g_config.exact;
  constant c_shape : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at    : schedule_t := schedule(g_config, g_kind, g_light);
  constant c_sum   : positive   := normalized_bits(g_config, g_kind, g_light);
  constant c_place : positive   := formats(c_exact).light_place.bits + formats(c_exact).vector.bits;

  signal way    : std_logic_vector(c_axes * formats(c_exact).offset.bits - 1 downto 0); -- P_p - P
  signal unit_1 : std_logic_vector(unit'range);
  signal unit_2 : std_logic_vector(unit'range);

begin

  ways : if c_exact and c_shape.positional generate

    way <= offsets(c_exact, low_words(products, c_place), place_of(g_config, token), light_shift(c_exact, light));

  elsif c_shape.positional generate

    way <= offsets(c_exact, light_place(c_exact, light), place_of(g_config, token), light_shift(c_exact, light));

  else generate

    way <= (others => '0');

  end generate;

  vectors : if c_shape.first or c_shape.second generate

    add : process (clk)
    begin
      if rising_edge(clk) then
        if c_shape.first and cycle = c_at.sum_1 then
          sum <= way;
        end if;
        if c_shape.second and cycle = c_at.sum_2 then
          if c_exact then
            sum <= sums(to_light, view_of(g_config, token), c_sum);
          else
            sum <= sums(way, light_half(c_exact, light), c_sum);
          end if;
        end if;
      end if;
    end process;

    hold : process (clk)
    begin
      if rising_edge(clk) then
        if c_shape.first and cycle = c_at.round_1 then
          unit_1 <= unit;
        end if;
        if c_shape.second and cycle = c_at.round_2 then
          unit_2 <= unit;
        end if;
      end if;
    end process;

  else generate

    sum    <= (others => '0');
    unit_1 <= (others => '0');
    unit_2 <= (others => '0');

  end generate;

  choose : process (all)
  begin
    to_light <= light_directions(c_exact, light_place(c_exact, light));
    if c_shape.first and positional = '1' then
      to_light <= unit_1;
    end if;
    half <= light_half(c_exact, light);
    if c_shape.second and (c_exact or positional = '1') then
      half <= unit_2;
    end if;
  end process;

end architecture;
