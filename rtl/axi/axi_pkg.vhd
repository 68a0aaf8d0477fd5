-- SPDX-License-Identifier: Apache-2.0
--
-- Layout of the words at the AXI4-Stream ports.
--
-- Input: packets. A packet is a header word, the words of one vector, lowest first, and a zero word if the vector has an
-- even number of words: it is a whole number of 64-bit words on both widths of the bus. The header word is
--   15 to 0   kind of the packet, below
--   31 to 16  number of the vector's 32-bit words
-- Golden twin model/golden_run/packets.hpp
--
-- Output: a fragment is 16 bytes, in memory of a little-endian processor:
--   struct { uint16_t x, y; uint32_t z, triangle; uint8_t red, green, blue, zero; };

library ieee;
use ieee.std_logic_1164.all;

package axi_pkg is

  constant c_byte_bits     : positive := 8;
  constant c_word_bits     : positive := 32;
  constant c_fragment_bits : positive := 128;

  subtype fragment_data_t is std_logic_vector(c_fragment_bits - 1 downto 0);
  subtype fragment_keep_t is std_logic_vector(c_fragment_bits / c_byte_bits - 1 downto 0); -- evaluated at elaboration

  -- Kinds of packets.
  constant c_end_packet      : natural := 0; -- the end of a frame: no vector
  constant c_triangle_packet : natural := 1; -- a triangle; in the processors new_object
  constant c_record_packet   : natural := 2; -- of the spherical shader: a line
  constant c_load_packet     : natural := 3; -- of the processors: new_frame, define, redefine, delete
  constant c_walk_packet     : natural := 4; -- of the processors: new_scanline, shadow

  -- For each kind with a vector its number of words. 0: the hardware does not take this kind.
  type packet_lengths_t is array (c_triangle_packet to c_walk_packet) of natural;

  -- Cause of a fault.
  subtype cause_t is std_logic_vector(2 downto 0);

  constant c_no_fault      : cause_t := "000";
  constant c_wrong_kind    : cause_t := "001"; -- a packet of a kind that the hardware does not take
  constant c_wrong_length  : cause_t := "010"; -- a packet with another number of words than its kind has
  constant c_shader_fault  : cause_t := "011"; -- the shader reports a fault
  constant c_limit_reached : cause_t := "100"; -- the shader does not go on

  -- Number of 32-bit words that hold this number of bits.
  function words_of (bits : natural) return natural;

  -- A fragment's fields at the positions of tdata; the bits between them are zero.
  function fragment_data (triangle, y, x, z, red, green, blue : std_logic_vector) return fragment_data_t;

end package;

package body axi_pkg is

  function words_of (bits : natural) return natural is
  begin
    return (bits + c_word_bits - 1) / c_word_bits; -- evaluated at elaboration
  end function;

  function fragment_data (triangle, y, x, z, red, green, blue : std_logic_vector) return fragment_data_t is
    constant c_x        : natural := 0;
    constant c_y        : natural := 16;
    constant c_z        : natural := 32;
    constant c_triangle : natural := 64;
    constant c_red      : natural := 96;
    constant c_green    : natural := 104;
    constant c_blue     : natural := 112;
    variable data       : fragment_data_t;
  begin
    data := (others => '0');
    data(c_x + x'length - 1 downto c_x) := x;
    data(c_y + y'length - 1 downto c_y) := y;
    data(c_z + z'length - 1 downto c_z) := z;
    data(c_triangle + triangle'length - 1 downto c_triangle) := triangle;
    data(c_red + red'length - 1 downto c_red) := red;
    data(c_green + green'length - 1 downto c_green) := green;
    data(c_blue + blue'length - 1 downto c_blue) := blue;
    return data;
  end function;

end package body;
