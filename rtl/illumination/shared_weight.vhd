-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The weight of k I in the folded processor: (N.A)**x from the dot product; for a spot, times the factor of
--             its cone. shared_multiplier computes the product of weight and factor. Clocks of schedule_pkg:
--               angle         the dot product is N.A: a diffuse weight is this cosine, rounded; a highlight's weight
--                             leaves the power in weigh_in
--               cone          the dot product is that of L and the cone's axis; the factor is valid in clock `factor`
--               narrowed      the product becomes the weight
-- Formats     dot: dot_product; exponent: exponent; outer: direction; slope: spot_slope; products: shared_multiplier;
--             weight, factor: weight
-- Latency     that of schedule_pkg
-- Throughput  that of schedule_pkg
-- Error       that of power and spot_cone, and (-1, 0] steps of weight of a spot
-- Source      processors paper, figures 1 and 2: the power by a table; ours: spots
-- Golden twin model/golden/cosine_power.hpp, model/golden/light_weight.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity shared_weight is
  generic (
    g_config : config_t;
    g_kind   : natural range c_diffuse to c_specular;
    g_light  : natural
  );
  port (
    clk      : in  std_logic;
    cycle    : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    spot     : in  std_logic;
    outer    : in  std_logic_vector(formats(g_config.exact).direction.bits - 1 downto 0);
    slope    : in  std_logic_vector(formats(g_config.exact).spot_slope.bits - 1 downto 0);
    exponent : in  std_logic_vector(formats(g_config.exact).exponent.bits - 1 downto 0);
    dot      : in  std_logic_vector(2 * formats(g_config.exact).direction.bits downto 0);
    products : in  std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0);
    weight   : out std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0);
    factor   : out std_logic_vector(formats(g_config.exact).weight.bits - 1 downto 0)
  );
end entity;

architecture rtl of shared_weight is

  constant c_exact : boolean    := g_config.exact;
  constant c_shape : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at    : schedule_t := schedule(g_config, g_kind, g_light);

  subtype weight_t is std_logic_vector(weight'range);

  signal angle      : unsigned(formats(c_exact).direction.fraction downto 0); -- the cosine
  signal weight_now : weight_t; -- (N.A)**x, in weigh_in
  signal held       : weight_t; -- the same from then on, and the product with the factor

begin

  angle <= cosine(c_exact, signed(dot));

  highlight : if g_kind = c_specular generate

    power : entity work.power
      generic map (
        g_exact     => c_exact,
        g_pipelined => false
        )
      port map (
        clk      => clk,
        base     => std_logic_vector(angle),
        exponent => exponent,
        result   => weight_now
        );

  else generate

    weight_now <= held;

  end generate;

  hold : process (clk)
  begin
    if rising_edge(clk) then
      if g_kind = c_diffuse and cycle = c_at.angle then
        held <= cosine_weight(c_exact, angle);
      end if;
      if c_shape.spots and g_kind = c_specular and cycle = c_at.weigh_in then
        held <= weight_now;
      end if;
      if c_shape.spots and cycle = c_at.narrowed then
        held <= coned_weight(c_exact, unsigned(products(2 * held'length - 1 downto 0)));
      end if;
    end if;
  end process;

  cones : if c_shape.spots generate

    signal factor_now  : weight_t;
    signal factor_held : weight_t;

  begin

    spot_cone : entity work.spot_cone
      generic map (
        g_exact => c_exact
        )
      port map (
        clk      => clk,
        axis_sum => dot,
        outer    => outer,
        slope    => slope,
        factor   => factor_now
        );

    hold_factor : process (clk)
    begin
      if rising_edge(clk) then
        if cycle = c_at.factor then
          factor_held <= factor_now;
        end if;
      end if;
    end process;

    factor <= factor_now when c_at.narrow = c_at.factor else factor_held;
    weight <= weight_now when spot = '0' or (c_at.narrow = c_at.weigh_in and cycle = c_at.narrow) else held;

  else generate

    factor <= (others => '0');
    weight <= weight_now;

  end generate;

end architecture;
