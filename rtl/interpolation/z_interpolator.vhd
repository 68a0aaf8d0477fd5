-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Depth at every pixel: the plane that the header of the init vector holds.
-- Formats     formats_pkg: depth_sum; sums wrap, the value at a covered pixel fits
-- Contract    line_load and line_step are never both '1', nor span_load and span_step. The plane's words are skewed words
--             (skew_pkg), part 0 in the clock of line_load
-- Latency     g_parts clocks from span_load or span_step to value
-- Throughput  1 line and 1 pixel per clock
-- Error       0.19 of a depth step at most: see depth_sum in formats_pkg
-- Source      plane_interpolator; the papers leave depth to the host
-- Golden twin model/golden/z_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity z_interpolator is
  generic (
    g_exact : boolean  := true; -- false: edges step by a real slope, and de1 does not exist
    g_parts : positive := 1
  );
  port (
    clk        : in  std_logic;
    init       : in  std_logic_vector(init_bits(g_exact, 0) - 1 downto 0); -- header of the init vector
    line_load  : in  std_logic;                                                   -- take the init vector
    line_step  : in  std_logic;                                                   -- go to the next line
    line_carry : in  std_logic;                                                   -- that step ends one pixel further right
    span_load  : in  std_logic;                                                   -- start the span at the edge
    span_step  : in  std_logic;                                                   -- go to the next pixel
    value      : out std_logic_vector(formats(g_exact).depth_sum.bits - 1 downto 0)
  );
end entity;

architecture rtl of z_interpolator is

  constant c_bits : positive      := formats(g_exact).depth_sum.bits;
  constant c_init : init_header_t := init_header(g_exact);

  -- z, z_dx, z_de0 and z_de1 follow one another.
  constant c_words : positive := 3 + boolean'pos(g_exact);

begin

  depth : entity work.plane_interpolator
    generic map (
      g_bits    => c_bits,
      g_carries => g_exact,
      g_parts   => g_parts
      )
    port map (
      clk        => clk,
      plane      => init(c_init.z.low + c_words * c_bits - 1 downto c_init.z.low),
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      value      => value
      );

end architecture;
