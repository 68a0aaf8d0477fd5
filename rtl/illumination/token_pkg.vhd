-- SPDX-License-Identifier: Apache-2.0
--
-- The fields of a token and of a light, read from and written to their flat words. A vector is three components, x
-- lowest. A field that this hardware does not have reads as 0. processors_pkg gives the layout.
-- Golden twin model/golden/shading_token.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

package token_pkg is

  subtype command_t is natural range 0 to c_shadow;

  function command_of (exact : boolean; token : std_logic_vector) return command_t;

  function is_object (command : command_t) return std_logic;

  -- The start of a pixel.
  function is_head (command : command_t) return std_logic;

  -- Only the processors use such a token.
  function is_load (command : command_t) return std_logic;

  -- A field of a header.
  function field_of (word : std_logic_vector; field : slice_t) return std_logic_vector;

  -- N as interpolated: format vector.
  function normal_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- N after the ambient processor: format direction.
  function direction_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- P, or the view ray: format vector.
  function place_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- 1/w: format vector, one word.
  function distance_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- The view vector: format direction.
  function view_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  function exponent_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- k of one kind of processor, one word per channel.
  function coefficients_of (c : config_t; kind : natural; token : std_logic_vector) return std_logic_vector;

  -- The sum of the colours so far, one word per channel.
  function radiance_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- The colour with which the ambient processor starts: the half for the final rounding, if the colour has a fraction.
  function first_radiance (c : config_t) return std_logic_vector;

  -- The token with another N (directions, sign extended), view vector or colour.
  function with_direction (c : config_t; token, directions : std_logic_vector) return std_logic_vector;

  function with_view (c : config_t; token, view : std_logic_vector) return std_logic_vector;

  function with_radiance (c : config_t; token, radiance : std_logic_vector) return std_logic_vector;

  -- A light is the part of a loading token after its header.
  function light_bits (c : config_t) return positive;

  function light_of (c : config_t; token : std_logic_vector) return std_logic_vector;

  -- Place, or direction: format light_place.
  function light_place (exact : boolean; light : std_logic_vector) return std_logic_vector;

  -- Axis of a spot's cone: format direction.
  function light_axis (exact : boolean; light : std_logic_vector) return std_logic_vector;

  -- Preset published, format direction: H of a directional light, E of a positional one.
  function light_half (exact : boolean; light : std_logic_vector) return std_logic_vector;

  -- Number of bits by which the points' places are shifted: at least one bit, 0 in preset published.
  function shift_bits (exact : boolean) return positive;

  function light_shift (exact : boolean; light : std_logic_vector) return std_logic_vector;

  -- I, one word per channel.
  function intensities_of (c : config_t; light : std_logic_vector) return std_logic_vector;

  -- Sign-extends a word to more bits.
  function extended (word : std_logic_vector; bits : positive) return std_logic_vector;

end package;

package body token_pkg is

  -- `count` words of `bits` bits. The first one is at `low`; they are `distance` bits apart.
  function words_of (word : std_logic_vector; low, distance : natural; count, bits : positive) return std_logic_vector is
    alias flat : std_logic_vector(word'length - 1 downto 0) is word;

    variable words : std_logic_vector(count * bits - 1 downto 0);
  begin
    for i in 0 to count - 1 loop
      words((i + 1) * bits - 1 downto i * bits) := flat(low + i * distance + bits - 1 downto low + i * distance);
    end loop;
    return words;
  end function;

  -- The same, 0 where this hardware has no such field.
  function words_if (present : boolean; word : std_logic_vector; low, distance : natural; count, bits : positive)
    return std_logic_vector is
    constant c_none : std_logic_vector(count * bits - 1 downto 0) := (others => '0');
  begin
    if present then
      return words_of(word, low, distance, count, bits);
    end if;
    return c_none;
  end function;

  -- Replaces the bits of `word` from `low` on.
  function replaced (word, bits : std_logic_vector; low : natural) return std_logic_vector is
    variable changed : std_logic_vector(word'length - 1 downto 0) := word;
  begin
    changed(low + bits'length - 1 downto low) := bits;
    return changed;
  end function;

  function command_of (exact : boolean; token : std_logic_vector) return command_t is
  begin
    return to_integer(unsigned(field_of(token, pixel_header(exact).command)));
  end function;

  function is_object (command : command_t) return std_logic is
  begin
    return flag(command = c_new_object);
  end function;

  function is_head (command : command_t) return std_logic is
  begin
    return flag(command = c_new_pixel or command = c_new_scanline);
  end function;

  function is_load (command : command_t) return std_logic is
  begin
    return flag(command = c_new_frame or command = c_define or command = c_redefine or command = c_delete);
  end function;

  function field_of (word : std_logic_vector; field : slice_t) return std_logic_vector is
    alias flat : std_logic_vector(word'length - 1 downto 0) is word;
  begin
    return flat(field.high downto field.low);
  end function;

  function normal_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).vector.bits;
  begin
    return words_of(token, normal_low(c, 0), c_bits, c_axes, c_bits);
  end function;

  function direction_of (c : config_t; token : std_logic_vector) return std_logic_vector is
  begin
    return words_of(token, normal_low(c, 0), formats(c.exact).vector.bits, c_axes, formats(c.exact).direction.bits);
  end function;

  function place_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).vector.bits;
  begin
    return words_if(has_place(c), token, place_low(c, 0), c_bits, c_axes, c_bits);
  end function;

  function distance_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).vector.bits;
  begin
    return words_if(has_distance(c), token, distance_low(c), c_bits, 1, c_bits);
  end function;

  function view_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).direction.bits;
  begin
    return words_if(has_view(c), token, view_low(c, 0), c_bits, c_axes, c_bits);
  end function;

  function exponent_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).exponent.bits;
  begin
    return words_if(c.specular, token, material_low(c) + exponent_low(c), c_bits, 1, c_bits);
  end function;

  function coefficients_of (c : config_t; kind : natural; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).coefficient.bits;

    variable low : natural := material_low(c);
  begin
    if kind = c_ambient then
      low := low + ambient_low(c, 0);
    elsif kind = c_diffuse then
      low := low + diffuse_low(c, 0);
    else
      low := low + specular_low(c, 0);
    end if;
    return words_of(token, low, c_bits, c.channels, c_bits);
  end function;

  function radiance_of (c : config_t; token : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).radiance.bits;
  begin
    return words_of(token, radiance_low(c, 0), c_bits, c.channels, c_bits);
  end function;

  function first_radiance (c : config_t) return std_logic_vector is
    constant c_format : format_t := formats(c.exact).radiance;

    variable radiance : std_logic_vector(c.channels * c_format.bits - 1 downto 0) := (others => '0');
  begin
    for channel in 0 to c.channels - 1 loop
      if c_format.fraction > 0 then
        radiance(channel * c_format.bits + c_format.fraction - 1) := '1';
      end if;
    end loop;
    return radiance;
  end function;

  function with_direction (c : config_t; token, directions : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).vector.bits;

    variable vector : std_logic_vector(c_axes * c_bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      vector((axis + 1) * c_bits - 1 downto axis * c_bits) :=
        extended(std_logic_vector(axis_of(directions, axis)), c_bits);
    end loop;
    return replaced(token, vector, normal_low(c, 0));
  end function;

  function with_view (c : config_t; token, view : std_logic_vector) return std_logic_vector is
  begin
    return replaced(token, view, view_low(c, 0));
  end function;

  function with_radiance (c : config_t; token, radiance : std_logic_vector) return std_logic_vector is
  begin
    return replaced(token, radiance, radiance_low(c, 0));
  end function;

  function light_bits (c : config_t) return positive is
  begin
    return light_axes_bits(c.exact, c_axes) + light_colour_bits(c.exact, c.channels);
  end function;

  function light_of (c : config_t; token : std_logic_vector) return std_logic_vector is
  begin
    return words_of(token, light_axes_low(c), light_bits(c), 1, light_bits(c));
  end function;

  -- A vector of the light. Its components are at `field` of the light's blocks, one block per axis.
  function light_vector_of (exact : boolean; light : std_logic_vector; field : slice_t) return std_logic_vector is
  begin
    return words_of(light, light_axes_bits(exact, 0) + field.low,
      light_axes_bits(exact, 1) - light_axes_bits(exact, 0), c_axes, field.high - field.low + 1);
  end function;

  function light_place (exact : boolean; light : std_logic_vector) return std_logic_vector is
  begin
    return light_vector_of(exact, light, light_axes_channel(exact).place);
  end function;

  function light_axis (exact : boolean; light : std_logic_vector) return std_logic_vector is
  begin
    return light_vector_of(exact, light, light_axes_channel(exact).axis);
  end function;

  function light_half (exact : boolean; light : std_logic_vector) return std_logic_vector is
    constant c_none : std_logic_vector(c_axes * formats(exact).direction.bits - 1 downto 0) := (others => '0');
  begin
    if exact then
      return c_none;
    end if;
    return light_vector_of(exact, light, light_axes_channel(exact).half);
  end function;

  function shift_bits (exact : boolean) return positive is
  begin
    if exact then
      return formats(exact).light_shift.bits;
    end if;
    return 1;
  end function;

  function light_shift (exact : boolean; light : std_logic_vector) return std_logic_vector is
  begin
    if exact then
      return field_of(light, light_axes_header(exact).shift);
    end if;
    return "0";
  end function;

  function intensities_of (c : config_t; light : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(c.exact).light_intensity.bits;
  begin
    return words_of(light, light_axes_bits(c.exact, c_axes) + light_colour_bits(c.exact, 0), c_bits,
      c.channels, c_bits);
  end function;

  function extended (word : std_logic_vector; bits : positive) return std_logic_vector is
  begin
    return std_logic_vector(resize(signed(word), bits));
  end function;

end package body;
