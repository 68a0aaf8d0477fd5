-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A value that is linear on the screen, at each pixel of a strip in raster order. The value is stepped at every
--             pixel, covered or not. A register holds the value at the strip's first column of the next line.
-- Contract    load: the next line is the first one, with `start` at its first column. line_step: go to the first pixel of
--             the next line. pixel_step: go to the next pixel. At most one of the three is '1'. dx and dy are stable
--             from load to the last step.
--             value is that of the pixel's centre where centre = '1', otherwise that of subpixel `row`, `column`.
-- Formats     g_bits of any format, signed; sums wrap: only the value at a covered pixel has to fit. dx and dy have three
--             bits more, of which only subpixels use: their eighths then wrap as the value does
-- Latency     1 clock from a step to value
-- Throughput  1 pixel per clock
-- Error       each word half a unit off, so the value (1 + lines + pixels)/2 units at most; at a subpixel 5/4 units more:
--             3/8 pixels and 3/8 lines of half a unit each, and a cut of 7/8
-- Source      processors paper, section 2: the object processors interpolate N and P linearly; the order is ours
-- Golden twin model/golden/raster_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity raster_interpolator is
  generic (
    g_bits : positive;
    g_side : positive range 1 to 4 := 1 -- subpixels per row and per column: 1, 2 or 4
  );
  port (
    clk        : in  std_logic;
    load       : in  std_logic;
    line_step  : in  std_logic;
    pixel_step : in  std_logic;
    start      : in  std_logic_vector(g_bits - 1 downto 0);
    dx         : in  std_logic_vector(g_bits + 2 downto 0); -- change per pixel
    dy         : in  std_logic_vector(g_bits + 2 downto 0); -- change per line
    centre     : in  std_logic;
    row        : in  std_logic_vector(1 downto 0);
    column     : in  std_logic_vector(1 downto 0);
    value      : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of raster_interpolator is

  subtype word_t is signed(g_bits - 1 downto 0);
  subtype eighths_t is signed(g_bits + 2 downto 0); -- in 1/8 units

  type reg_t is record
    next_line : word_t; -- value at the first column of the next line
    value     : word_t;
  end record;

  signal r, r_next : reg_t;

  -- Change of the value from the centre to the subpixel with this index, along one axis. Of 4 subpixels they are -3, -1, 1
  -- and 3 eighths away, of 2 subpixels -2 and 2.
  function from_centre (change : eighths_t; index : std_logic_vector(1 downto 0)) return eighths_t is
    variable distance : eighths_t := shift_left(change, 1);
    variable negative : std_logic := not index(0);
  begin
    if g_side = 4 then
      negative := not index(1);
      if (index(1) xor index(0)) = '1' then
        distance := change;
      else
        distance := distance + change;
      end if;
    end if;
    if negative = '1' then
      distance := to_signed(0, eighths_t'length) - distance;
    end if;
    return distance;
  end function;

begin

  assert g_side /= 3
    report "raster_interpolator: g_side is " & integer'image(g_side) & ", not 1, 2 or 4"
    severity failure;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if load = '1' then
      v.next_line := signed(start);
    elsif line_step = '1' then
      v.value     := r.next_line;
      v.next_line := r.next_line + signed(dy(word_t'range));
    elsif pixel_step = '1' then
      v.value := r.value + signed(dx(word_t'range));
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  whole_pixels : if g_side = 1 generate

    value <= std_logic_vector(r.value);

  else generate

    select_value : process (all)
      variable sampled : eighths_t;
    begin
      sampled := (r.value & "000") + from_centre(signed(dx), column) + from_centre(signed(dy), row);
      value   <= std_logic_vector(sampled(sampled'high downto 3));
      if centre = '1' then
        value <= std_logic_vector(r.value);
      end if;
    end process;

  end generate;

end architecture;
