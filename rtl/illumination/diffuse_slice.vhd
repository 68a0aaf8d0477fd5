-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One light's diffuse term, one product per channel: factor * cos(angle), where the angle is linear along
--             the span.
--               span stage     the angle, from a line_interpolator; lit is '1' if the pixel is above the light's horizon
--               sample stage   the cosine_rom's sample, with in_range and the factors
--               product stage  factor * sample, or zero if in_range = '0'
--             g_channels = 0: there are no factors and no table. The slice only computes the horizon, at which the
--             light's highlight ends. products is as wide as one product and zero.
-- Contract    span_load takes the light's part of the line record. span_step passes the pixel to the sample stage and
--             advances the span to the next pixel. sample_step passes the pixel from the sample stage to the product
--             stage.
-- Formats     formats_pkg: angle in units of half a bell (preset published: of a whole bell), factor; product: bits of
--             factor plus those of a sample
-- Latency     1 clock from span_load to lit, 1 from span_step to the sample stage, 3 from sample_step to products
-- Throughput  1 pixel per clock
-- Error       angle: see formats_pkg; sample: see cosine_rom
-- Source      spherical paper, section 4 and figure 12 (diffuse part)
-- Golden twin model/golden/diffuse_slice.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.cosine_pkg.all;
use work.formats_pkg.all;

entity diffuse_slice is
  generic (
    g_exact           : boolean              := true;
    g_channels        : natural range 0 to 3 := 3;
    g_cosine          : cosine_t;
    g_multiplier_bits : natural := 0 -- of multiplier
  );
  port (
    clk         : in  std_logic;
    part        : in  std_logic_vector(diffuse_bits(g_exact, g_channels) - 1 downto 0); -- of the line record
    span_load   : in  std_logic;                                                        -- start the line
    span_step   : in  std_logic;                                                        -- go to the next pixel
    sample_step : in  std_logic;
    lit         : out std_logic; -- preset published: always '1'
    products    : out std_logic_vector((g_channels + boolean'pos(g_channels = 0))
      * (formats(g_exact).factor.bits + data_bits(g_cosine)) - 1 downto 0)
  );
end entity;

architecture rtl of diffuse_slice is

  constant c_part         : diffuse_header_t := diffuse_header(g_exact);
  constant c_angle_bits   : positive         := formats(g_exact).angle.bits;
  constant c_factors_low  : positive         := diffuse_bits(g_exact, 0);
  constant c_factors_bits : natural          := part'length - c_factors_low;

  signal slope, angle : std_logic_vector(c_angle_bits - 1 downto 0);
  signal address      : std_logic_vector(address_bits(g_cosine) - 1 downto 0);
  signal carried_in   : std_logic_vector(c_factors_bits downto 0); -- in_range lowest
  signal carried      : std_logic_vector(carried_in'range);
  signal in_range     : std_logic;

begin

  -- Keep the slope of the span: the init buffer already holds the next line's record.
  slope_register : entity work.parameter_register
    generic map (
      g_bits => c_angle_bits
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => part(c_part.slope.high downto c_part.slope.low),
      value => slope
      );

  along_line : entity work.line_interpolator
    generic map (
      g_bits => c_angle_bits
      )
    port map (
      clk       => clk,
      load      => span_load,
      start     => part(c_part.angle.high downto c_part.angle.low),
      step      => span_step,
      increment => slope,
      value     => angle
      );

  to_address : entity work.angle_address
    generic map (
      g_exact        => g_exact,
      g_cosine => g_cosine
      )
    port map (
      angle    => angle,
      address  => address,
      in_range => lit
      );

  sample_stage_register : entity work.parameter_register
    generic map (
      g_bits => carried'length
      )
    port map (
      clk   => clk,
      load  => span_step,
      start => carried_in,
      value => carried
      );

  carried_in(0) <= lit;
  in_range      <= carried(0);

  cosines : if g_channels > 0 generate

    constant c_channel_bits : positive := diffuse_bits(g_exact, 1) - c_factors_low;
    constant c_product_bits : positive := formats(g_exact).factor.bits + data_bits(g_cosine);

    signal sample, gated : std_logic_vector(data_bits(g_cosine) - 1 downto 0);

  begin

    factors_register : entity work.parameter_register
      generic map (
        g_bits => c_factors_bits
        )
      port map (
        clk   => clk,
        load  => span_load,
        start => part(part'high downto c_factors_low),
        value => carried_in(c_factors_bits downto 1)
        );

    rom : entity work.cosine_rom
      generic map (
        g_exact        => g_exact,
        g_power        => 1,
        g_cosine => g_cosine
        )
      port map (
        clk     => clk,
        enable  => span_step,
        address => address,
        sample  => sample
        );

    gated <= sample when in_range = '1' else (others => '0');

    channels : for channel in 0 to g_channels - 1 generate

      constant c_factor : slice_t := diffuse_channel(g_exact).factor;
      constant c_low    : natural := 1 + channel * c_channel_bits;

    begin

      -- The sample is the first operand: numeric_std's product adds one sum per bit of its left operand.
      product : entity work.multiplier
        generic map (
          g_a_bits          => data_bits(g_cosine),
          g_b_bits          => formats(g_exact).factor.bits,
          g_multiplier_bits => g_multiplier_bits,
          g_gated           => g_exact -- in preset published no angle is out of range
          )
        port map (
          clk     => clk,
          enable  => sample_step,
          a       => gated,
          b       => carried(c_low + c_factor.high downto c_low + c_factor.low),
          product => products((channel + 1) * c_product_bits - 1 downto channel * c_product_bits)
          );

    end generate;

  else generate

    products <= (others => '0');

  end generate;

end architecture;
