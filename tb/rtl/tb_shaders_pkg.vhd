-- SPDX-License-Identifier: Apache-2.0
-- A shader and its generics as one value, for the testbenches that all shaders share.
library ieee;
use ieee.std_logic_1164.all;
use work.cosine_pkg.all;
use work.processors_pkg.all;
use work.quadratic_pkg.all;
use work.shader_pkg.all;
use work.spherical_pkg.all;

package tb_shaders_pkg is

  -- The generics of all shaders. Each shader has some of them.
  type hardware_t is record
    shader                         : shader_t;
    exact                          : boolean;
    channels                       : positive;
    diffuse, specular              : boolean;
    degree                         : positive;
    lights                         : natural;
    highlight_channels             : positive;
    powers                         : natural;
    cosine                         : cosine_t;
    directional, positional, spots : natural;
    normalize, shadows, unrolled   : boolean;
    objects                        : natural; -- object processors; 0: the rasterizer
    subpixels                      : positive;
  end record;

  type hardwares_t is array (natural range <>) of hardware_t;

  function hardware (shader : shader_t; exact : boolean := true; channels : positive := 3;
    diffuse, specular : boolean := true; degree : positive := 2; lights : natural := 1;
    highlight_channels : positive := 1; powers : natural := 2; cosine : cosine_t := default_cosine(true);
    directional : natural := 1; positional, spots : natural := 0; normalize : boolean := true;
    shadows : boolean := false; unrolled : boolean := true; objects : natural := 0; subpixels : positive := 1)
    return hardware_t;

  -- Their scene is grey. tb/vectors/packets.cpp has the same list.
  constant c_packet_names : string := "quadratic spherical no_light processors objects";
  function packet_hardware (index : natural) return hardware_t;

  function processors_config (h : hardware_t) return config_t;

  function init_bits (h : hardware_t) return positive;

  -- Line records of the spherical shader follow a triangle's vector.
  function has_records (h : hardware_t) return boolean;

end package;

package body tb_shaders_pkg is

  function hardware (shader : shader_t; exact : boolean := true; channels : positive := 3;
    diffuse, specular : boolean := true; degree : positive := 2; lights : natural := 1;
    highlight_channels : positive := 1; powers : natural := 2; cosine : cosine_t := default_cosine(true);
    directional : natural := 1; positional, spots : natural := 0; normalize : boolean := true;
    shadows : boolean := false; unrolled : boolean := true; objects : natural := 0; subpixels : positive := 1)
    return hardware_t is
  begin
    return (shader, exact, channels, diffuse, specular, degree, lights, highlight_channels, powers, cosine, directional,
      positional, spots, normalize, shadows, unrolled, objects, subpixels);
  end function;

  function packet_hardware (index : natural) return hardware_t is
    constant c_hardware : hardwares_t := (
      hardware(quadratic, channels => 1),
      hardware(spherical, exact => false, channels => 1, cosine => rom6x6),
      hardware(spherical, channels => 1, lights => 0, diffuse => false, specular => false),
      hardware(processors, channels => 1),
      hardware(processors, exact => false, channels => 1, shadows => true, objects => 4)
      );
  begin
    return c_hardware(index);
  end function;

  function processors_config (h : hardware_t) return config_t is
  begin
    return config(h.exact, h.channels, h.directional, h.positional, h.spots, h.diffuse, h.specular, h.normalize, h.shadows);
  end function;

  function init_bits (h : hardware_t) return positive is
  begin
    case h.shader is
      when quadratic =>
        return init_bits(h.exact, h.degree, h.channels);
      when spherical =>
        return init_bits(h.exact, h.channels, h.lights, h.diffuse, h.specular, h.highlight_channels);
      when processors =>
        return init_bits(processors_config(h));
    end case;
  end function;

  function has_records (h : hardware_t) return boolean is
  begin
    return h.shader = spherical
      and record_bits(h.exact, h.channels, h.lights, h.diffuse, h.specular, h.highlight_channels) > 0;
  end function;

end package body;
