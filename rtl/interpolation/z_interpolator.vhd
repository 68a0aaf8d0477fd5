-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Depth at every pixel by first differences: along the start edge a line a step, along the line a pixel a
--             step.
--               z(x + q,     y + 1) = z(x, y) + de0    where the edge's remainder does not carry
--               z(x + q + 1, y + 1) = z(x, y) + de1    where it does
--               z(x +- 1,    y)     = z(x, y) + dx     the sign is the span's direction
-- Formats     formats_pkg: depth_sum; sums wrap, the value at a covered pixel fits
-- Latency     1 clock from a load or step to its value
-- Throughput  1 line and 1 pixel a clock
-- Error       0.19 of a depth step at most: see depth_sum in formats_pkg
-- Source      linear interpolation as in Gouraud's shading; the papers leave depth to the host
-- Golden twin model/golden/z_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity z_interpolator is
  generic (
    g_exact : boolean := true -- false: edges step by a real slope, and de1 does not exist
  );
  port (
    clk        : in  std_logic;
    init       : in  std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0); -- header of the init vector
    line_load  : in  std_logic;                                                   -- take the init vector
    line_step  : in  std_logic;                                                   -- go to the next line
    line_carry : in  std_logic;                                                   -- that step goes a pixel further
    span_load  : in  std_logic;                                                   -- begin the line
    span_step  : in  std_logic;                                                   -- go to the next pixel
    line_value : out std_logic_vector(formats(g_exact).depth_sum.bits - 1 downto 0);
    value      : out std_logic_vector(formats(g_exact).depth_sum.bits - 1 downto 0)
  );
end entity;

architecture rtl of z_interpolator is

  constant c_bits : positive      := formats(g_exact).depth_sum.bits;
  constant c_init : init_header_t := init_header(g_exact);

  subtype word_t is std_logic_vector(c_bits - 1 downto 0);

  signal dx, de0, de, span_dx : word_t;

begin

  dx_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_init.z_dx.high downto c_init.z_dx.low),
      value => dx
      );

  de0_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_init.z_de0.high downto c_init.z_de0.low),
      value => de0
      );

  carried : if g_exact generate

    signal de1 : word_t;

    begin

      de1_register : entity work.parameter_register
        generic map (
          g_bits => c_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.z_de1.high downto c_init.z_de1.low),
          value => de1
          );

      de <= de1 when line_carry = '1' else de0;

  else generate

    de <= de0;

  end generate;

  along_edge : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.z.high downto c_init.z.low),
      step      => line_step,
      increment => de,
      value     => line_value
      );

    -- The line stage may hold the next triangle already, so the span keeps its own step.
  span_dx_register : entity work.parameter_register
    generic map (
      g_bits => c_bits
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => dx,
      value => span_dx
      );

  along_line : entity work.line_interpolator
    generic map (
      g_bits => c_bits
      )
    port map (
      clk       => clk,
      load      => span_load,
      start     => line_value,
      step      => span_step,
      increment => span_dx,
      value     => value
      );

end architecture;
