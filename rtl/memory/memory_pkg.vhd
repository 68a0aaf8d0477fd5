-- SPDX-License-Identifier: Apache-2.0
--
-- Words of fragments_to_memory: the parameters of a frame, and pixels in memory. A block is a group of 2**g_block_bits
-- neighbouring pixels of one row, at an address that is a multiple of its bytes. It has beats, words of the bus; a beat
-- has lanes, one per pixel.
-- Golden twin model/golden/frame_memory.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;

package memory_pkg is

  constant c_place_bits   : positive := 12; -- of x and y
  constant c_stride_bits  : positive := 16;
  constant c_channel_bits : positive := 8;
  constant c_depth_bits   : positive := 24; -- of a fragment

  constant c_incr       : std_logic_vector(1 downto 0) := "01"; -- AXI4: a burst with ascending addresses
  constant c_bufferable : std_logic_vector(3 downto 0) := "0011"; -- AXI4: normal memory, not cached

  subtype place_t is unsigned(c_place_bits - 1 downto 0);
  subtype side_t is unsigned(c_place_bits downto 0); -- 0 to 4096
  subtype address_t is unsigned(31 downto 0); -- of a byte
  subtype stride_t is unsigned(c_stride_bits - 1 downto 0);
  subtype channel_t is std_logic_vector(c_channel_bits - 1 downto 0);
  subtype pixel_count_t is unsigned(2 downto 0); -- of a beat's pixels: 0 to 4

  -- Bases and strides are multiples of a block's bytes. Only pixels inside width, height and the scissor
  -- [left, right) x [top, bottom) are written.
  type frame_t is record
    colour_base   : address_t;
    colour_stride : stride_t;
    depth_base    : address_t;
    depth_stride  : stride_t;
    width         : side_t;
    height        : side_t;
    left          : side_t;
    right         : side_t;
    top           : side_t;
    bottom        : side_t;
    clear         : std_logic; -- write clear colour and farthest depth first
    red           : channel_t; -- of the clear colour
    green         : channel_t;
    blue          : channel_t;
  end record;

  -- The position and the channels of a fragment.
  type fragment_t is record
    y     : place_t;
    x     : place_t;
    z     : std_logic_vector(c_depth_bits - 1 downto 0);
    red   : channel_t;
    green : channel_t;
    blue  : channel_t;
  end record;

  function fragment_of (data : fragment_data_t) return fragment_t;

  -- Bits of a pixel's depth or colour in memory: RGB565 and 16, or XRGB8888 and 32. The upper 8 of 32 are 0.
  function pixel_bits (true_colour : boolean) return positive;
  function pixel_bytes (true_colour : boolean) return positive;

  -- The same without the bits that are 0.
  function stored_bits (true_colour : boolean) return positive;

  function log2 (number : positive) return natural;

  -- Bytes in a word of the bus.
  function bytes (data_bits : positive) return positive;

  -- log2 of the pixels in a beat.
  function lane_bits (data_bits : positive; true_colour : boolean) return natural;

  -- Depth: the upper bits. Colour: red highest, the upper bits of each channel.
  function depth_of (z : std_logic_vector(c_depth_bits - 1 downto 0); true_colour : boolean) return std_logic_vector;
  function colour_of (red, green, blue : channel_t; true_colour : boolean) return std_logic_vector;

  -- '1' in the lane of a pixel of this number.
  function one_hot (pixel : unsigned; bits : natural) return std_logic_vector;

  -- Number of the bits that are '1', of at most 4.
  function count_of (bits : std_logic_vector) return pixel_count_t;

  function lesser (a, b : side_t) return side_t;

end package;

package body memory_pkg is

  function fragment_of (data : fragment_data_t) return fragment_t is
    constant c_y     : natural := 16; -- lowest bits, as in axi_pkg
    constant c_z     : natural := 32;
    constant c_red   : natural := 96;
    constant c_green : natural := 104;
    constant c_blue  : natural := 112;
    variable fragment : fragment_t;
  begin
    fragment.x     := unsigned(data(c_place_bits - 1 downto 0));
    fragment.y     := unsigned(data(c_y + c_place_bits - 1 downto c_y));
    fragment.z     := data(c_z + c_depth_bits - 1 downto c_z);
    fragment.red   := data(c_red + c_channel_bits - 1 downto c_red);
    fragment.green := data(c_green + c_channel_bits - 1 downto c_green);
    fragment.blue  := data(c_blue + c_channel_bits - 1 downto c_blue);
    return fragment;
  end function;

  function pixel_bits (true_colour : boolean) return positive is
  begin
    if true_colour then
      return 32;
    end if;
    return 16;
  end function;

  function pixel_bytes (true_colour : boolean) return positive is
  begin
    return pixel_bits(true_colour) / c_byte_bits; -- evaluated at elaboration
  end function;

  function stored_bits (true_colour : boolean) return positive is
  begin
    if true_colour then
      return 24;
    end if;
    return 16;
  end function;

  function log2 (number : positive) return natural is
    variable bits : natural := 0;
  begin
    while 2 ** bits < number loop
      bits := bits + 1;
    end loop;
    return bits;
  end function;

  function bytes (data_bits : positive) return positive is
  begin
    return data_bits / c_byte_bits; -- evaluated at elaboration
  end function;

  function lane_bits (data_bits : positive; true_colour : boolean) return natural is
  begin
    return log2(data_bits / pixel_bits(true_colour)); -- evaluated at elaboration
  end function;

  function depth_of (z : std_logic_vector(c_depth_bits - 1 downto 0); true_colour : boolean) return std_logic_vector is
  begin
    return z(c_depth_bits - 1 downto c_depth_bits - stored_bits(true_colour));
  end function;

  function colour_of (red, green, blue : channel_t; true_colour : boolean) return std_logic_vector is
  begin
    if true_colour then
      return red & green & blue;
    end if;
    return red(7 downto 3) & green(7 downto 2) & blue(7 downto 3);
  end function;

  function one_hot (pixel : unsigned; bits : natural) return std_logic_vector is
    alias number : unsigned(pixel'length - 1 downto 0) is pixel;

    variable lanes : std_logic_vector(2 ** bits - 1 downto 0);
  begin
    lanes := (others => '1');
    for lane in lanes'range loop
      for i in 0 to bits - 1 loop
        if (number(i) = '1') /= (lane / 2 ** i mod 2 = 1) then -- evaluated at elaboration
          lanes(lane) := '0';
        end if;
      end loop;
    end loop;
    return lanes;
  end function;

  function count_of (bits : std_logic_vector) return pixel_count_t is
    variable count : pixel_count_t;
  begin
    count := (others => '0');
    for i in bits'range loop
      if bits(i) = '1' then
        count := count + 1;
      end if;
    end loop;
    return count;
  end function;

  function lesser (a, b : side_t) return side_t is
  begin
    if a < b then
      return a;
    end if;
    return b;
  end function;

end package body;
