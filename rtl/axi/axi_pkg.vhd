-- SPDX-License-Identifier: Apache-2.0
--
-- Layout of the words of the AXI4-Stream tops. An init vector is a row of 32-bit words, lowest first, as a program holds
-- it in memory. A fragment is 16 bytes, in memory of a little-endian processor:
--
--   struct { uint16_t x, y; uint32_t z, triangle; uint8_t red, green, blue, zero; };

library ieee;
use ieee.std_logic_1164.all;

package axi_pkg is

  constant c_byte_bits     : positive := 8;
  constant c_word_bits     : positive := 32;
  constant c_fragment_bits : positive := 128;

  subtype fragment_data_t is std_logic_vector(c_fragment_bits - 1 downto 0);
  subtype fragment_keep_t is std_logic_vector(c_fragment_bits / c_byte_bits - 1 downto 0); -- evaluated at elaboration

  -- Bits of the whole 32-bit words that hold this number of bits.
  function whole_words (bits : positive) return positive;

  -- A fragment's fields at the positions of tdata; the bits between them are zero.
  function fragment_data (triangle, y, x, z, red, green, blue : std_logic_vector) return fragment_data_t;

end package;

package body axi_pkg is

  function whole_words (bits : positive) return positive is
  begin
    return (bits + c_word_bits - 1) / c_word_bits * c_word_bits; -- evaluated at elaboration
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
