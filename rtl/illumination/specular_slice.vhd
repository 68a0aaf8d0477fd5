-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One light's highlight, one product per channel: factor * cos(angle) ** power, where the angle is linear
--             along the span, in units of half a bell.
--               span stage     the angle, from a line_interpolator
--               sample stage   the samples of all tables, read together, with in_range (inside the bell, and lit),
--                              the factors and the power
--               product stage  factor * the power's sample, or zero if in_range = '0'
-- Contract    span_load takes the light's part of the line record. span_step passes the pixel, lit or not, to the
--             sample stage and advances the span to the next pixel. sample_step passes the pixel from the sample stage
--             to the product stage.
--             Bit i of g_powers: the slice has the table of cosine to the power 2**i. With one table the record's power
--             is not read. With several, the sample of a power without a table is zero.
-- Formats     formats_pkg: angle, power, factor; product: bits of factor plus those of a sample
-- Latency     1 clock from span_load to the span stage, 1 from span_step to the sample stage, 3 from sample_step to
--             products
-- Throughput  1 pixel per clock
-- Error       angle: see formats_pkg; sample: see cosine_rom
-- Source      spherical paper, section 4 and figure 12 (specular part): preset published has only cosine squared, and
--             its bells have no ends. Other powers and in_range are ours
-- Golden twin model/golden/specular_slice.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.cosine_pkg.all;
use work.formats_pkg.all;

entity specular_slice is
  generic (
    g_exact           : boolean              := true;
    g_channels        : natural range 1 to 3 := 3; -- of the highlight
    g_powers          : natural              := 2;
    g_cosine          : cosine_t;
    g_multiplier_bits : natural := 0 -- of multiplier
  );
  port (
    clk         : in  std_logic;
    part        : in  std_logic_vector(specular_bits(g_exact, g_channels) - 1 downto 0); -- of the line record
    span_load   : in  std_logic;                                                         -- start the line
    span_step   : in  std_logic;                                                         -- go to the next pixel
    sample_step : in  std_logic;
    lit         : in  std_logic; -- at the span stage: the pixel is above the light's horizon
    products    : out std_logic_vector(g_channels * (formats(g_exact).factor.bits + data_bits(g_cosine)) - 1 downto 0)
  );
end entity;

architecture rtl of specular_slice is

  constant c_largest_power : natural := 4; -- cosine to the power 16

  function has_table (power : natural) return boolean is
  begin
    return (g_powers / 2 ** power) mod 2 = 1; -- evaluated at elaboration
  end function;

  function tables return natural is
    variable count : natural := 0;
  begin
    for power in 0 to c_largest_power loop
      if has_table(power) then
        count := count + 1;
      end if;
    end loop;
    return count;
  end function;

  -- The only table's power.
  function only_power return natural is
    variable found : natural := 0;
  begin
    for power in 0 to c_largest_power loop
      if has_table(power) then
        found := power;
      end if;
    end loop;
    return found;
  end function;

  constant c_part         : specular_header_t := specular_header(g_exact);
  constant c_angle_bits   : positive          := formats(g_exact).angle.bits;
  constant c_factors_low  : positive          := specular_bits(g_exact, 0);
  constant c_factors_bits : positive          := part'length - c_factors_low;
  constant c_channel_bits : positive          := specular_bits(g_exact, 1) - c_factors_low;
  constant c_product_bits : positive          := formats(g_exact).factor.bits + data_bits(g_cosine);
  constant c_factor       : slice_t           := specular_channel(g_exact).factor;

  subtype sample_t is std_logic_vector(data_bits(g_cosine) - 1 downto 0);

  type samples_t is array (0 to c_largest_power) of sample_t;

  signal slope, angle  : std_logic_vector(c_angle_bits - 1 downto 0);
  signal address       : std_logic_vector(address_bits(g_cosine) - 1 downto 0);
  signal in_bell       : std_logic; -- inside the bell
  signal carried_in    : std_logic_vector(c_factors_bits downto 0); -- in_range lowest
  signal carried       : std_logic_vector(carried_in'range);
  signal in_range      : std_logic;
  signal samples       : samples_t;
  signal sample, gated : sample_t;

begin

  assert g_powers > 0 and g_powers < 2 ** (c_largest_power + 1)
    report "specular_slice: g_powers is " & integer'image(g_powers) & ", not a set of the powers 1, 2, 4, 8 and 16"
    severity failure;
  assert g_exact or tables = 1
    report "specular_slice: g_powers is " & integer'image(g_powers) & ", but preset published has no power to select by"
    severity failure;

  -- Keep the slope and factors of the span: the init buffer already holds the next line's record.
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
      in_range => in_bell
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

  carried_in(0) <= in_bell and lit;
  in_range      <= carried(0);

  roms : for power in 0 to c_largest_power generate

    present : if has_table(power) generate

      rom : entity work.cosine_rom
        generic map (
          g_exact        => g_exact,
          g_power        => 2 ** power,
          g_cosine => g_cosine
          )
        port map (
          clk     => clk,
          enable  => span_step,
          address => address,
          sample  => samples(power)
          );

    else generate

      samples(power) <= (others => '0');

    end generate;

  end generate;

  selected : if tables > 1 generate

    signal span_power, power : std_logic_vector(c_part.power.high - c_part.power.low downto 0);

  begin

    span_power_register : entity work.parameter_register
      generic map (
        g_bits => power'length
        )
      port map (
        clk   => clk,
        load  => span_load,
        start => part(c_part.power.high downto c_part.power.low),
        value => span_power
        );

    power_register : entity work.parameter_register
      generic map (
        g_bits => power'length
        )
      port map (
        clk   => clk,
        load  => span_step,
        start => span_power,
        value => power
        );

    select_sample : process (all)
    begin
      sample <= (others => '0');
      for i in samples_t'range loop
        if unsigned(power) = i then
          sample <= samples(i);
        end if;
      end loop;
    end process;

  else generate

    sample <= samples(only_power);

  end generate;

  gated <= sample when in_range = '1' else (others => '0');

  channels : for channel in 0 to g_channels - 1 generate

    constant c_low : natural := 1 + channel * c_channel_bits;

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

end architecture;
