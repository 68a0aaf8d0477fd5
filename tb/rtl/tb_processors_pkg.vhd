-- SPDX-License-Identifier: Apache-2.0
-- The configurations of shading processors that the testbenches run, and the names of their files of vectors.
-- tb/vectors/processor_list.hpp and tb/vectors/processors_shader.cpp have the same lists.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

package tb_processors_pkg is

  type configs_t is array (natural range <>) of config_t;

  type processor_t is record
    config : config_t;
    kind   : natural;
    light  : natural;
  end record;

  type processors_t is array (natural range <>) of processor_t;

  -- Preset, channels, lights of each kind and effects, such as exact_31111111.
  function config_name (c : config_t) return string;

  -- The same with the kind of processor and the light, such as exact_31111111_12.
  function processor_name (p : processor_t) return string;

  -- Both presets, every processor of seven pipelines: one with all effects, the paper's version I, one with only a
  -- positional light, one with only a spot, and three with single effects.
  constant c_processors : processors_t;

  -- The three words of a vector as words of `bits` bits. The bits above a word are 'X'.
  function spaced (words : std_logic_vector; bits : positive) return std_logic_vector;

  -- For the parts of processors_shader: a directional light, all kinds of light, grey without highlights, preset published.
  constant c_shaders : configs_t(0 to 3) := (
    config(true, 3, 1, 0, 0, true, true, true, false), config(true, 3, 1, 1, 1, true, true, true, false),
    config(true, 1, 2, 0, 0, true, false, false, false), config(false, 3, 1, 1, 1, true, true, true, false));

  -- The hardware with object processors that the testbenches of rtl/objects run (tb/vectors/object_scene.hpp).
  constant c_fronts : configs_t(0 to 3) := (
    config(true, 3, 1, 1, 0, true, true, true, true), c_shaders(3), c_shaders(0),
    config(true, 3, 1, 1, 0, true, true, true, true));
  constant c_subpixels : integer_vector(0 to 3) := (16, 4, 1, 1);

  function front_name (front : natural) return string;

end package;

package body tb_processors_pkg is

  function digit (flag : boolean) return string is
  begin
    return to_string(boolean'pos(flag));
  end function;

  function config_name (c : config_t) return string is
  begin
    return preset_name(c.exact) & "_" & to_string(c.channels) & to_string(c.directional) & to_string(c.positional)
      & to_string(c.spots) & digit(c.diffuse) & digit(c.specular) & digit(c.normalize) & digit(c.shadows);
  end function;

  function front_name (front : natural) return string is
  begin
    return config_name(c_fronts(front)) & "_" & to_string(c_subpixels(front));
  end function;

  function processor_name (p : processor_t) return string is
  begin
    return config_name(p.config) & "_" & to_string(p.kind) & to_string(p.light);
  end function;

  function spaced (words : std_logic_vector; bits : positive) return std_logic_vector is
    constant c_bits : positive := words'length / c_axes;
    alias flat      : std_logic_vector(words'length - 1 downto 0) is words;

    variable result : std_logic_vector(c_axes * bits - 1 downto 0) := (others => 'X');
  begin
    for i in 0 to c_axes - 1 loop
      result(i * bits + c_bits - 1 downto i * bits) := flat((i + 1) * c_bits - 1 downto i * c_bits);
    end loop;
    return result;
  end function;

  function processors_of (c : config_t) return processors_t is
    variable all_of : processors_t(1 to processors(c));
    variable count  : natural := 1;
  begin
    all_of(1) := (c, c_ambient, 0);
    for light in 1 to lights(c) loop
      if c.diffuse then
        count         := count + 1;
        all_of(count) := (c, c_diffuse, light);
      end if;
      if c.specular then
        count         := count + 1;
        all_of(count) := (c, c_specular, light);
      end if;
    end loop;
    return all_of;
  end function;

  function processors_of (exact : boolean) return processors_t is
  begin
    return processors_of(config(exact, 3, 1, 1, 1, true, true, true, true))
      & processors_of(config(exact, 3, 1, 0, 0, true, true, false, false))
      & processors_of(config(exact, 3, 0, 1, 0, true, true, true, false))
      & processors_of(config(exact, 1, 0, 0, 1, true, false, false, false))
      & processors_of(config(exact, 1, 1, 0, 0, true, false, false, false))
      & processors_of(config(exact, 1, 0, 1, 1, false, true, false, false))
      & processors_of(config(exact, 1, 1, 0, 0, true, false, true, false));
  end function;

  constant c_processors : processors_t := processors_of(true) & processors_of(false);

end package body;
