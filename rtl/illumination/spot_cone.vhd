-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The factor of a spot light's cone, from the cosine of the angle to the cone's axis: 0 outside the outer
--             edge, 1 inside the inner edge, t**2 (3 - 2 t) between them, where t is linear in the cosine.
--               clock 1     over = -axis_sum - outer, cut to 28 fraction bits; 0 if negative
--               clock 2, 3  over * slope
--               clock 4     t, at most 1, cut to weight's fraction bits
--               clock 5     t**2
--               clock 6, 7  t**2 (3 - 2 t)
--               clock 8     rounded half up
-- Formats     axis_sum: exact dot product of the direction *to* the light and the axis; outer: direction; slope:
--             spot_slope; factor: weight
-- Latency     8 clocks (shading_pkg)
-- Throughput  1 factor per clock
-- Error       3.5 * 2**-16 exact, 2 * 2**-8 published, for slopes up to 2**12: the cuts of over and t, and rounding.
--             1.5 * 2**-28 * slope more for steeper slopes, where the errors of the directions are larger
-- Source      ours: the processors paper has no spot lights
-- Golden twin model/golden/spot_cone.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.shading_pkg.all;

entity spot_cone is
  generic (
    g_exact : boolean := true
  );
  port (
    clk      : in  std_logic;
    axis_sum : in  std_logic_vector(2 * formats(g_exact).direction.bits downto 0);
    outer    : in  std_logic_vector(formats(g_exact).direction.bits - 1 downto 0);
    slope    : in  std_logic_vector(formats(g_exact).spot_slope.bits - 1 downto 0);
    factor   : out std_logic_vector(formats(g_exact).weight.bits - 1 downto 0)
  );
end entity;

architecture rtl of spot_cone is

  constant c_formats       : formats_t := formats(g_exact);
  constant c_direction     : positive  := c_formats.direction.bits;
  constant c_fraction      : positive  := c_formats.direction.fraction;
  constant c_slope         : positive  := c_formats.spot_slope.bits;
  constant c_weight        : positive  := c_formats.weight.bits;
  constant c_over_fraction : positive  := 28;
  -- axis_sum plus outer has one bit more than axis_sum. `over` has its bits that are not cut, without the sign.
  constant c_sum_high  : positive := 2 * c_direction + 1;
  constant c_over_low  : natural  := 2 * c_fraction - c_over_fraction;
  constant c_over_bits : positive := c_sum_high - c_over_low;
  constant c_t_low     : positive := c_over_fraction + c_formats.spot_slope.fraction - c_formats.weight.fraction;

  subtype weight_t is unsigned(c_weight - 1 downto 0);

  type reg_t is record
    over     : unsigned(c_over_bits - 1 downto 0);
    slope    : unsigned(c_slope - 1 downto 0);
    t        : weight_t;
    t_late   : weight_t; -- in the clock of its square
    factor   : std_logic_vector(c_weight - 1 downto 0);
  end record;

  signal r : reg_t;

  signal wide_t : std_logic_vector(c_over_bits + c_slope + 1 downto 0);
  signal square : std_logic_vector(2 * c_weight + 1 downto 0);
  signal rest   : unsigned(c_weight downto 0); -- 3 - 2 t
  signal cubic  : std_logic_vector(3 * c_weight + 2 downto 0);

  function one return weight_t is
    variable word : weight_t := (others => '0');
  begin
    word(word'high) := '1';
    return word;
  end function;

begin

  multiply_slope : entity work.signed_multiplier
    generic map (
      g_a_bits => c_over_bits + 1,
      g_b_bits => c_slope + 1,
      g_clocks => 2
      )
    port map (
      clk     => clk,
      a       => '0' & std_logic_vector(r.over),
      b       => '0' & std_logic_vector(r.slope),
      product => wide_t
      );

  square_t : entity work.signed_multiplier
    generic map (
      g_a_bits => c_weight + 1,
      g_b_bits => c_weight + 1,
      g_clocks => 1
      )
    port map (
      clk     => clk,
      a       => '0' & std_logic_vector(r.t),
      b       => '0' & std_logic_vector(r.t),
      product => square
      );

  rest <= (one & '0') + one - (r.t_late & '0');

  multiply_rest : entity work.signed_multiplier
    generic map (
      g_a_bits => 2 * c_weight + 1,
      g_b_bits => c_weight + 2,
      g_clocks => 2
      )
    port map (
      clk     => clk,
      a       => square(2 * c_weight downto 0),
      b       => '0' & std_logic_vector(rest),
      product => cubic
      );

  registers : process (clk)
    variable over  : signed(c_sum_high downto 0);
    variable t     : unsigned(c_over_bits + c_slope - c_t_low - 1 downto 0);
    variable share : unsigned(3 * c_weight + 1 - 2 * c_formats.weight.fraction downto 0);
  begin
    if rising_edge(clk) then
      over   := resize(-resize(signed(axis_sum), c_sum_high + 1)
        - (signed(outer) & (c_fraction - 1 downto 0 => '0')), c_sum_high + 1);
      r.over <= (others => '0');
      if over(over'high) = '0' then
        r.over <= unsigned(over(c_sum_high - 1 downto c_over_low));
      end if;
      r.slope <= unsigned(slope);

      t   := unsigned(wide_t(c_over_bits + c_slope - 1 downto c_t_low));
      r.t <= one;
      if t(t'high downto c_weight - 1) = (t'high downto c_weight - 1 => '0') then
        r.t <= t(c_weight - 1 downto 0);
      end if;

      r.t_late <= r.t;

      share    := round_half_up(unsigned(cubic(3 * c_weight downto 0)), 2 * c_formats.weight.fraction);
      r.factor <= std_logic_vector(share(c_weight - 1 downto 0));
    end if;
  end process;

  factor <= r.factor;

end architecture;
