-- SPDX-License-Identifier: Apache-2.0
--
-- The configuration of the shading processors, and the positions of the blocks in their flat vectors.
--
-- The host's vector is a request (command, light, flags) followed by
--  new_object, shadow    the walk (header of init); for new_object also the planes of N, P (or the view ray) and 1/w,
--                        and the material
--  new_scanline          a strip, in the walk's fields; only with object processors
--  define, redefine      the light: axes, colour
--  new_frame             the background, as a light's colour; only for the filter
--  delete                nothing
-- A token between processors is a pixel header, N, P, 1/w, the view vector, the material, and the sum of the colours so
-- far. A token that loads has the light after command and flags, at the same position as in the host's vector.
-- Golden twin model/words/processors_layout.hpp

use work.formats_pkg.all;

package processors_pkg is

  -- Commands of the host's vectors and of tokens. Only tokens have new_pixel.
  constant c_new_pixel    : natural := 0;
  constant c_new_object   : natural := 1;
  constant c_new_scanline : natural := 2;
  constant c_new_frame    : natural := 3;
  constant c_define       : natural := 4;
  constant c_redefine     : natural := 5;
  constant c_delete       : natural := 6;
  constant c_shadow       : natural := 7;

  -- Kinds of processors.
  constant c_ambient  : natural := 0;
  constant c_diffuse  : natural := 1;
  constant c_specular : natural := 2;

  -- Most lights of all kinds. The bounds of formats_pkg are derived for as many; the set-up's limit has the same name.
  constant c_most_lights : positive := 16;

  -- Components x, y and z of a vector.
  constant c_axes : positive := 3;

  type config_t is record
    exact       : boolean;
    channels    : positive;
    directional : natural; -- lights of each kind; numbered from 1: directional, positional, spots
    positional  : natural;
    spots       : natural;
    diffuse     : boolean; -- each light has a diffuse processor
    specular    : boolean;
    normalize   : boolean; -- the ambient processor can normalize N
    shadows     : boolean;
  end record;

  function config (exact : boolean; channels : positive; directional, positional, spots : natural;
    diffuse, specular, normalize, shadows : boolean) return config_t;

  -- One directional light.
  constant c_default_config : config_t := (
    exact => true, channels => 3, directional => 1, positional => 0, spots => 0, diffuse => true, specular => true,
    normalize => true, shadows => false
    );

  function lights (c : config_t) return natural;

  -- Number of processors: one ambient, and for each light a diffuse and a specular one.
  function processors (c : config_t) return positive;

  -- P is interpolated: the surface point (preset published) or the view ray through the pixel (preset exact).
  function has_place (c : config_t) return boolean;

  -- 1/w is interpolated: it gives the point on the view ray.
  function has_distance (c : config_t) return boolean;

  -- The ambient processor computes the unit vector to the eye.
  function has_view (c : config_t) return boolean;

  -- Number of planes in a vector that draws.
  function planes (c : config_t) return positive;

  -- Lowest bits of the blocks of the host's vector.
  function walk_low (c : config_t) return natural;

  function plane_low (c : config_t; plane : natural) return natural;

  function init_material_low (c : config_t) return natural;

  -- After the request, in the host's vector and in a token.
  function light_axes_low (c : config_t) return natural;

  function light_colour_low (c : config_t) return natural;

  -- Bits of a vector or token that loads.
  function load_bits (c : config_t) return positive;

  function init_bits (c : config_t) return positive;

  -- Positions within a material.
  function exponent_low (c : config_t) return natural;

  function ambient_low (c : config_t; channel : natural) return natural;

  function diffuse_low (c : config_t; channel : natural) return natural;

  function specular_low (c : config_t; channel : natural) return natural;

  function material_bits (c : config_t) return positive;

  -- Lowest bits of the blocks of a token. N has format vector up to the ambient processor, and is a sign-extended
  -- direction after it.
  function normal_low (c : config_t; axis : natural) return natural;

  function place_low (c : config_t; axis : natural) return natural;

  function distance_low (c : config_t) return natural;

  function view_low (c : config_t; axis : natural) return natural;

  function material_low (c : config_t) return natural;

  function radiance_low (c : config_t; channel : natural) return natural;

  function token_bits (c : config_t) return positive;

end package;

package body processors_pkg is

  function config (exact : boolean; channels : positive; directional, positional, spots : natural;
    diffuse, specular, normalize, shadows : boolean) return config_t is
  begin
    return (exact, channels, directional, positional, spots, diffuse, specular, normalize, shadows);
  end function;

  function lights (c : config_t) return natural is
  begin
    return c.directional + c.positional + c.spots;
  end function;

  function processors (c : config_t) return positive is
  begin
    return 1 + lights(c) * (boolean'pos(c.diffuse) + boolean'pos(c.specular));
  end function;

  function has_place (c : config_t) return boolean is
  begin
    return c.positional + c.spots > 0 or has_view(c);
  end function;

  function has_distance (c : config_t) return boolean is
  begin
    return c.exact and c.positional + c.spots > 0;
  end function;

  function has_view (c : config_t) return boolean is
  begin
    return c.exact and c.specular and lights(c) > 0;
  end function;

  function planes (c : config_t) return positive is
  begin
    return c_axes * (1 + boolean'pos(has_place(c))) + boolean'pos(has_distance(c));
  end function;

  function walk_low (c : config_t) return natural is
  begin
    return request_bits(c.exact);
  end function;

  -- The walk is that of preset exact in both presets.
  function plane_low (c : config_t; plane : natural) return natural is
  begin
    return walk_low(c) + init_bits(true, 0) + plane * plane_bits(c.exact);
  end function;

  function init_material_low (c : config_t) return natural is
  begin
    return plane_low(c, planes(c));
  end function;

  function light_axes_low (c : config_t) return natural is
  begin
    return request_bits(c.exact);
  end function;

  function light_colour_low (c : config_t) return natural is
  begin
    return light_axes_low(c) + light_axes_bits(c.exact, c_axes);
  end function;

  function load_bits (c : config_t) return positive is
  begin
    return light_colour_low(c) + light_colour_bits(c.exact, c.channels);
  end function;

  function init_bits (c : config_t) return positive is
    constant c_draw_bits : positive := init_material_low(c) + material_bits(c);
  begin
    if load_bits(c) > c_draw_bits then
      return load_bits(c);
    end if;
    return c_draw_bits;
  end function;

  function exponent_low (c : config_t) return natural is
  begin
    return 0;
  end function;

  function ambient_low (c : config_t; channel : natural) return natural is
    variable low : natural;
  begin
    low := channel * formats(c.exact).coefficient.bits;
    if c.specular then
      low := low + formats(c.exact).exponent.bits;
    end if;
    return low;
  end function;

  function diffuse_low (c : config_t; channel : natural) return natural is
  begin
    return ambient_low(c, c.channels + channel);
  end function;

  function specular_low (c : config_t; channel : natural) return natural is
  begin
    return diffuse_low(c, c.channels * boolean'pos(c.diffuse) + channel);
  end function;

  function material_bits (c : config_t) return positive is
  begin
    return specular_low(c, c.channels * boolean'pos(c.specular));
  end function;

  function normal_low (c : config_t; axis : natural) return natural is
  begin
    return pixel_bits(c.exact) + axis * formats(c.exact).vector.bits;
  end function;

  function place_low (c : config_t; axis : natural) return natural is
  begin
    return normal_low(c, c_axes + axis);
  end function;

  function distance_low (c : config_t) return natural is
  begin
    return place_low(c, c_axes * boolean'pos(has_place(c)));
  end function;

  function view_low (c : config_t; axis : natural) return natural is
    variable low : natural;
  begin
    low := distance_low(c) + axis * formats(c.exact).direction.bits;
    if has_distance(c) then
      low := low + formats(c.exact).vector.bits;
    end if;
    return low;
  end function;

  function material_low (c : config_t) return natural is
  begin
    return view_low(c, c_axes * boolean'pos(has_view(c)));
  end function;

  function radiance_low (c : config_t; channel : natural) return natural is
  begin
    return material_low(c) + material_bits(c) + channel * formats(c.exact).radiance.bits;
  end function;

  function token_bits (c : config_t) return positive is
    constant c_pixel_bits : positive := radiance_low(c, c.channels);
  begin
    if load_bits(c) > c_pixel_bits then
      return load_bits(c);
    end if;
    return c_pixel_bits;
  end function;

end package body;
