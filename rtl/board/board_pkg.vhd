-- SPDX-License-Identifier: Apache-2.0
--
-- Sizes and words of the board: the frame, its place in the SRAM, and the colours of memory and pins.
-- Golden twin model/golden/board_pixel.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package board_pkg is

  -- The frame in memory. On the monitor each pixel is 2x2 dots.
  constant c_width  : positive := 320;
  constant c_height : positive := 240;
  constant c_pixels : positive := c_width * c_height;

  -- The SRAM: two colour buffers, then the depths.
  constant c_depth_base : positive := 2 * c_pixels;
  constant c_words      : positive := 3 * c_pixels; -- in use

  subtype address_t is unsigned(17 downto 0); -- of a word in the SRAM
  subtype place_t is unsigned(16 downto 0); -- in a buffer, below c_pixels
  subtype word_t is std_logic_vector(15 downto 0);
  subtype level_t is std_logic_vector(2 downto 0); -- of a colour at the pins
  subtype frame_x_t is unsigned(8 downto 0);
  subtype frame_y_t is unsigned(7 downto 0);

  -- The depth of an empty pixel: no fragment of this depth is drawn.
  constant c_farthest : word_t := (others => '1');

  -- First address of a colour buffer.
  function colour_base (buffer_index : std_logic) return address_t;

  -- A pixel's place in each buffer.
  function pixel_place_of (y : frame_y_t; x : frame_x_t) return place_t;

  -- RGB565: the upper bits of each colour.
  function rgb565 (red, green, blue : std_logic_vector(7 downto 0)) return word_t;

  -- The upper five bits of a colour as three bits of one of the pixel's 2x2 dots: the lower two bits of the five are
  -- the number of dots that get the next brighter level. Levels above the brightest are the brightest.
  function dithered (colour : std_logic_vector(4 downto 0); dot_y, dot_x : std_logic) return level_t;

end package;

package body board_pkg is

  function colour_base (buffer_index : std_logic) return address_t is
    variable base : address_t;
  begin
    base := to_unsigned(0, address_t'length);
    if buffer_index = '1' then
      base := to_unsigned(c_pixels, address_t'length);
    end if;
    return base;
  end function;

  function pixel_place_of (y : frame_y_t; x : frame_x_t) return place_t is
    -- 320 = 5 * 64
    variable five_lines : unsigned(y'length + 2 downto 0);
  begin
    five_lines := resize(y, y'length + 3) + resize(y & "00", y'length + 3);
    return (five_lines & "000000") + resize(x, place_t'length);
  end function;

  function rgb565 (red, green, blue : std_logic_vector(7 downto 0)) return word_t is
  begin
    return red(7 downto 3) & green(7 downto 2) & blue(7 downto 3);
  end function;

  function dithered (colour : std_logic_vector(4 downto 0); dot_y, dot_x : std_logic) return level_t is
    variable brighter : std_logic;
    variable level    : unsigned(level_t'range);
  begin
    -- Number the dots 1 to 4 in the order in which they get brighter: (y, x) = (0, 0), (1, 1), (0, 1); (1, 0) never does.
    brighter := '0';
    if dot_y = '0' and dot_x = '0' then
      brighter := colour(1) or colour(0);
    elsif dot_y = '1' and dot_x = '1' then
      brighter := colour(1);
    elsif dot_y = '0' and dot_x = '1' then
      brighter := colour(1) and colour(0);
    end if;
    level := unsigned(colour(4 downto 2));
    if brighter = '1' and level /= 7 then
      level := level + 1;
    end if;
    return std_logic_vector(level);
  end function;

end package body;
