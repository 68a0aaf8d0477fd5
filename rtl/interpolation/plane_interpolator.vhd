-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A value that is linear on the screen, at every pixel, by first differences: along the start edge a line a
--             step, along the line a pixel a step.
--               v(x + q,     y + 1) = v(x, y) + de0    where the edge's remainder does not carry
--               v(x + q + 1, y + 1) = v(x, y) + de1    where it does
--               v(x +- 1,    y)     = v(x, y) + dx     the sign is the span's direction
-- Formats     plane: value, dx, de0 and, with g_carries, de1, the first lowest, g_bits each, signed; sums wrap, the value
--             at a covered pixel fits
-- Latency     1 clock from a load or step to its value
-- Throughput  1 line and 1 pixel a clock
-- Error       each word half a unit off, so the value (1 + lines + steps)/2 units at most: see plane_sum and depth_sum
--             in formats_pkg
-- Source      linear interpolation as in Gouraud's shading; processors paper: N and P arrive interpolated linearly
-- Golden twin model/golden/plane_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;

entity plane_interpolator is
  generic (
    g_bits    : positive;
    g_carries : boolean := true -- false: edges step by a real slope, and de1 does not exist
  );
  port (
    clk        : in  std_logic;
    plane      : in  std_logic_vector((3 + boolean'pos(g_carries)) * g_bits - 1 downto 0);
    line_load  : in  std_logic; -- take the plane
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step goes a pixel further
    span_load  : in  std_logic; -- begin the line
    span_step  : in  std_logic; -- go to the next pixel
    line_value : out std_logic_vector(g_bits - 1 downto 0);
    value      : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of plane_interpolator is

  subtype word_t is std_logic_vector(g_bits - 1 downto 0);

  signal dx, de0, de, span_dx : word_t;

begin

  dx_register : entity work.parameter_register
    generic map (
      g_bits => g_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => plane(2 * g_bits - 1 downto g_bits),
      value => dx
      );

  de0_register : entity work.parameter_register
    generic map (
      g_bits => g_bits
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => plane(3 * g_bits - 1 downto 2 * g_bits),
      value => de0
      );

  carried : if g_carries generate

    signal de1 : word_t;

    begin

      de1_register : entity work.parameter_register
        generic map (
          g_bits => g_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => plane(4 * g_bits - 1 downto 3 * g_bits),
          value => de1
          );

      de <= de1 when line_carry = '1' else de0;

  else generate

    de <= de0;

  end generate;

  along_edge : entity work.line_interpolator
    generic map (
      g_bits => g_bits
      )
    port map (
      clk       => clk,
      load      => line_load,
      start     => plane(g_bits - 1 downto 0),
      step      => line_step,
      increment => de,
      value     => line_value
      );

    -- The line stage may hold the next triangle already, so the span keeps its own step.
  span_dx_register : entity work.parameter_register
    generic map (
      g_bits => g_bits
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => dx,
      value => span_dx
      );

  along_line : entity work.line_interpolator
    generic map (
      g_bits => g_bits
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
