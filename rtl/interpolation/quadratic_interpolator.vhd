-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One colour channel of a quadratic over the triangle, by second-order forward differences. With e0 = (q, 1)
--             and e1 = (q + 1, 1) the two steps of the start edge and x = (+-1, 0) the step of a span:
--               line   value += de0    dx += dxe0    de0 += de0e0    de1 += de0e1    where the remainder does not carry
--                      value += de1    dx += dxe1    de0 += de0e1    de1 += de1e1    where it does
--               pixel  value += dx     dx += dxx
--             In preset published the edge steps by its real slope: e0 = (A, 1), and there is no e1.
-- Formats     formats_pkg: intensity; sums wrap, the value at a covered pixel fits
-- Latency     1 clock from a load or step to its value
-- Throughput  1 line and 1 pixel a clock
-- Error       0.15 of a colour step at most in preset exact, 16 in published: see intensity in formats_pkg
-- Source      quadratic paper, section 5 (the nested loops) and figure 6
-- Golden twin model/golden/quadratic_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity quadratic_interpolator is
  generic (
    g_exact : boolean := true
  );
  port (
    clk        : in  std_logic;
    init       : in  std_logic_vector(init_channel_low(g_exact, 1) - init_channel_low(g_exact, 0) - 1 downto 0);
    line_load  : in  std_logic; -- take the channel's part of the init vector
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step goes a pixel further
    span_load  : in  std_logic; -- begin the line
    span_step  : in  std_logic; -- go to the next pixel
    line_value : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);
    line_dx    : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);
    line_de0   : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);
    line_de1   : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0); -- zero in preset published
    value      : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);
    dx         : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0)
  );
end entity;

architecture rtl of quadratic_interpolator is

  constant c_bits : positive       := formats(g_exact).intensity.bits;
  constant c_init : init_channel_t := init_channel(g_exact);

  subtype word_t is std_logic_vector(c_bits - 1 downto 0);

  -- Constant over the triangle, and over the span.
  signal dxx, dxe0, de0e0 : word_t;
  signal span_dxx         : word_t;

  -- What the next step along the edge adds.
  signal value_step, dx_step, de0_step : word_t;

begin

  dxx_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_init.dxx.high downto c_init.dxx.low),
      value => dxx
      );

  dxe0_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_init.dxe0.high downto c_init.dxe0.low),
      value => dxe0
      );

  de0e0_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_init.de0e0.high downto c_init.de0e0.low),
      value => de0e0
      );

  carried : if g_exact generate

    signal dxe1, de0e1, de1e1 : word_t;
    signal de1_step           : word_t;

    begin

      dxe1_register : entity work.parameter_register
        generic map (
          g_bits => c_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.dxe1.high downto c_init.dxe1.low),
          value => dxe1
          );

      de0e1_register : entity work.parameter_register
        generic map (
          g_bits => c_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.de0e1.high downto c_init.de0e1.low),
          value => de0e1
          );

      de1e1_register : entity work.parameter_register
        generic map (
          g_bits => c_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.de1e1.high downto c_init.de1e1.low),
          value => de1e1
          );

      de1_along_edge : entity work.line_interpolator
        generic map (
          g_bits => c_bits
          )
        port map (
          clk       => clk,
          load      => line_load,
          start     => init(c_init.de1.high downto c_init.de1.low),
          step      => line_step,
          increment => de1_step,
          value     => line_de1
          );

      value_step <= line_de1 when line_carry = '1' else line_de0;
      dx_step    <= dxe1 when line_carry = '1' else dxe0;
      de0_step   <= de0e1 when line_carry = '1' else de0e0;
      de1_step   <= de1e1 when line_carry = '1' else de0e1;

  else generate

    line_de1   <= (others => '0');
    value_step <= line_de0;
    dx_step    <= dxe0;
    de0_step   <= de0e0;

  end generate;

  value_along_edge : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.value.high downto c_init.value.low),
      step      => line_step,
      increment => value_step,
      value     => line_value
      );

  dx_along_edge : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.dx.high downto c_init.dx.low),
      step      => line_step,
      increment => dx_step,
      value     => line_dx
      );

  de0_along_edge : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.de0.high downto c_init.de0.low),
      step      => line_step,
      increment => de0_step,
      value     => line_de0
      );

    -- The line stage may hold the next triangle already, so the span keeps its own second difference.
  span_dxx_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => dxx,
      value => span_dxx
      );

  value_along_line : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => span_load,
      start     => line_value,
      step      => span_step,
      increment => dx,
      value     => value
      );

  dx_along_line : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => span_load,
      start     => line_dx,
      step      => span_step,
      increment => span_dxx,
      value     => dx
      );

end architecture;
