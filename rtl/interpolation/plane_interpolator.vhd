-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A value that is linear on the screen, by first differences. edge_value and span_value are interpolators:
--             registers that load a word and add the value of the arrow. a | b: b where the edge carries
--
--               along the edge, one step per line      along the span, one step per pixel
--
--               de0 | de1 --> edge_value --start-----> span_value --> deskew --> value
--                                                          ^
--                                                          |
--               dx -----------------------start-----> span_dx, a register
--
--             value  the plane at a pixel
--             dx     its change per pixel of the span, x + 1 or x - 1
--             de0    its change per line where the edge steps by (q, 1)
--             de1    its change per line where it carries: by (q + 1, 1)
-- Contract    line_load and line_step are never both '1', nor span_load and span_step. The words of plane are skewed words
--             (skew_pkg), part 0 in the clock of line_load
-- Formats     plane: value, dx, de0 and, with g_carries, de1, the first lowest, g_bits each, signed; sums wrap, the value
--             at a covered pixel fits
-- Latency     g_parts clocks from span_load or span_step to value
-- Throughput  1 line and 1 pixel per clock
-- Error       each word half a unit off, so the value (1 + lines + steps)/2 units at most: see plane_sum and depth_sum
--             in formats_pkg
-- Source      linear interpolation as in Gouraud's shading; processors paper: N and P arrive interpolated linearly
-- Golden twin model/golden/plane_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;

entity plane_interpolator is
  generic (
    g_bits    : positive;
    g_carries : boolean  := true; -- false: edges step by a real slope, and de1 does not exist
    g_parts   : positive := 1
  );
  port (
    clk        : in  std_logic;
    plane      : in  std_logic_vector((3 + boolean'pos(g_carries)) * g_bits - 1 downto 0);
    line_load  : in  std_logic; -- take the plane
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step ends one pixel further right
    span_load  : in  std_logic; -- start the span at the edge
    span_step  : in  std_logic; -- go to the next pixel
    value      : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of plane_interpolator is

  subtype word_t is std_logic_vector(g_bits - 1 downto 0);

  -- The steps of the triangle: all but the plane's value.
  signal steps : std_logic_vector(plane'high downto g_bits);

  -- Skewed words.
  signal edge_value : word_t;
  signal edge_step  : word_t; -- de0 or de1
  signal span_value : word_t;
  signal span_dx    : word_t; -- the span's own: the edge may have loaded the next triangle

begin

  steps_register : entity work.skewed_register
    generic map (g_bits => g_bits, g_words => steps'length / g_bits, g_parts => g_parts) -- evaluated at elaboration
    port map (clk => clk, load => line_load, start => plane(steps'range), value => steps);

  carried : if g_carries generate

    step_multiplexer : entity work.skewed_multiplexer
      generic map (g_bits => g_bits, g_parts => g_parts)
      port map (
        clk      => clk,
        select_b => line_carry,
        a        => steps(3 * g_bits - 1 downto 2 * g_bits),
        b        => steps(4 * g_bits - 1 downto 3 * g_bits),
        value    => edge_step);

  else generate

    edge_step <= steps(3 * g_bits - 1 downto 2 * g_bits);

  end generate;

  value_along_edge : entity work.skewed_interpolator
    generic map (g_bits => g_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => line_load,
      start     => plane(g_bits - 1 downto 0),
      step      => line_step,
      increment => edge_step,
      value     => edge_value);

  span_dx_register : entity work.skewed_register
    generic map (g_bits => g_bits, g_parts => g_parts)
    port map (clk => clk, load => span_load, start => steps(2 * g_bits - 1 downto g_bits), value => span_dx);

  value_along_span : entity work.skewed_interpolator
    generic map (g_bits => g_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => span_load,
      start     => edge_value,
      step      => span_step,
      increment => span_dx,
      value     => span_value);

  align_value : entity work.deskew
    generic map (g_bits => g_bits, g_parts => g_parts)
    port map (clk => clk, skewed => span_value, word => value);

end architecture;
