-- SPDX-License-Identifier: Apache-2.0
--
-- The words of the chain of object processors. From its lowest bit a word has an item, a mask with one bit per subpixel,
-- and a kind. An item is laid out as a token without its colour. It is one of these, by its command:
--   new_scanline, new_pixel                the head of a pixel's list, with the pixel. new_scanline: the first of a line
--   new_object, shadow                     an element of the list: an object or a shadow polygon at that pixel
--   new_frame, define, redefine, delete    a load of the shading processors
-- A mask has g_subpixels bits: bit side * row + column, row 0 on top, column 0 on the left.
-- Golden twin model/golden/object_word.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

package objects_pkg is

  constant c_item      : natural := 0;
  constant c_part      : natural := 1; -- 64 bits of an object that enters the chain
  constant c_last_part : natural := 2; -- the last of them
  constant c_strip_end : natural := 3; -- no pixel follows in this strip

  constant c_part_bits : positive := 64;

  subtype kind_t is std_logic_vector(1 downto 0);

  function kind_word (kind : natural) return kind_t;

  -- Subpixels per row and per column: 1, 2 or 4.
  function side_of (subpixels : positive) return positive;

  function side_bits (subpixels : positive) return natural;

  -- Pixels with several subpixels are filtered.
  function has_filter (subpixels : positive) return boolean;

  -- Limits of a strip, in pixels: the ends of spans must fit span_x in subpixels, and the first lines of triangles pixel_y.
  function most_columns (exact : boolean; subpixels : positive) return positive;

  function most_lines (exact : boolean; subpixels : positive) return positive;

  -- Number of parts of a host's vector: of one with an object, of one with a shadow polygon.
  function object_parts (c : config_t) return positive;

  function shadow_parts (c : config_t) return positive;

  -- Bits of an item, and of a word.
  function item_bits (c : config_t) return positive;

  function word_bits (c : config_t; subpixels : positive) return positive;

  function kind_of (word : std_logic_vector) return kind_t;

  function mask_of (word : std_logic_vector; subpixels : positive) return std_logic_vector;

  function with_mask (word, mask : std_logic_vector) return std_logic_vector;

  -- A word without a mask.
  function word_of (c : config_t; subpixels : positive; kind : natural; item : std_logic_vector) return std_logic_vector;

  function is_element (exact : boolean; word : std_logic_vector) return std_logic;

  -- Position of an element in its list: depth, objects before shadow polygons, triangle. The formats are the same in both
  -- presets.
  subtype key_t is unsigned(formats(true).depth.bits + formats(true).triangle.bits downto 0);

  function key_of (exact : boolean; word : std_logic_vector) return key_t;

end package;

package body objects_pkg is

  function kind_word (kind : natural) return kind_t is
  begin
    return std_logic_vector(to_unsigned(kind, kind_t'length));
  end function;

  function side_bits (subpixels : positive) return natural is
  begin
    return boolean'pos(subpixels >= 4) + boolean'pos(subpixels >= 16);
  end function;

  function side_of (subpixels : positive) return positive is
  begin
    return 2 ** side_bits(subpixels);
  end function;

  function has_filter (subpixels : positive) return boolean is
  begin
    return subpixels > 1;
  end function;

  function most_columns (exact : boolean; subpixels : positive) return positive is
    constant c_in_a_span : positive :=
      (2 ** (formats(true).span_x.bits - 1) - 1) / side_of(subpixels); -- evaluated at elaboration
    constant c_in_a_frame : positive := 2 ** formats(exact).pixel_x.bits;
  begin
    if c_in_a_span < c_in_a_frame then
      return c_in_a_span;
    end if;
    return c_in_a_frame;
  end function;

  function most_lines (exact : boolean; subpixels : positive) return positive is
  begin
    return 2 ** (formats(exact).pixel_y.bits - side_bits(subpixels));
  end function;

  function parts_of (bits : positive) return positive is
  begin
    return (bits + c_part_bits - 1) / c_part_bits; -- evaluated at elaboration
  end function;

  function object_parts (c : config_t) return positive is
  begin
    return parts_of(init_bits(c));
  end function;

  function shadow_parts (c : config_t) return positive is
  begin
    return parts_of(plane_low(c, 0));
  end function;

  function item_bits (c : config_t) return positive is
    variable bits : positive := c_part_bits;
  begin
    if load_bits(c) > bits then
      bits := load_bits(c);
    end if;
    if radiance_low(c, 0) > bits then
      bits := radiance_low(c, 0);
    end if;
    return bits;
  end function;

  function word_bits (c : config_t; subpixels : positive) return positive is
  begin
    return item_bits(c) + subpixels + kind_t'length;
  end function;

  function kind_of (word : std_logic_vector) return kind_t is
    alias flat : std_logic_vector(word'length - 1 downto 0) is word;
  begin
    return flat(flat'high downto flat'high - kind_t'length + 1);
  end function;

  function mask_of (word : std_logic_vector; subpixels : positive) return std_logic_vector is
    alias flat : std_logic_vector(word'length - 1 downto 0) is word;

    constant c_high : natural := flat'high - kind_t'length;
  begin
    return flat(c_high downto c_high - subpixels + 1);
  end function;

  function with_mask (word, mask : std_logic_vector) return std_logic_vector is
    constant c_high  : natural := word'length - 1 - kind_t'length;
    variable changed : std_logic_vector(word'length - 1 downto 0) := word;
  begin
    changed(c_high downto c_high - mask'length + 1) := mask;
    return changed;
  end function;

  function word_of (c : config_t; subpixels : positive; kind : natural; item : std_logic_vector)
    return std_logic_vector is
    variable word : std_logic_vector(word_bits(c, subpixels) - 1 downto 0) := (others => '0');
  begin
    word(item'length - 1 downto 0)                     := item;
    word(word'high downto word'high - kind_t'length + 1) := kind_word(kind);
    return word;
  end function;

  function is_element (exact : boolean; word : std_logic_vector) return std_logic is
    constant c_command : command_t := command_of(exact, word);
  begin
    if kind_of(word) = kind_word(c_item) and (c_command = c_new_object or c_command = c_shadow) then
      return '1';
    end if;
    return '0';
  end function;

  function key_of (exact : boolean; word : std_logic_vector) return key_t is
    constant c_pixel : pixel_header_t := pixel_header(exact);

    variable shadow : std_logic := '0';
  begin
    if command_of(exact, word) = c_shadow then
      shadow := '1';
    end if;
    return unsigned(field_of(word, c_pixel.z) & shadow & field_of(word, c_pixel.triangle));
  end function;

end package body;
