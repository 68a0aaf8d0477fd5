-- SPDX-License-Identifier: Apache-2.0
-- Both presets and both forms, lights of each kind, with and without each effect, by shader_checker: triangles for the
-- rasterizer; strips of triangles and shadow polygons that overlap and cross for object processors, with 1, 4 and 16
-- subpixels. Lights are defined, redefined and deleted between them; there are several frames. All outputs of the golden
-- model are compared. Clocks are only compared if the processors accept one token per clock. A set with a fault has a light
-- that does not exist, an unknown command, or a line that needs more object processors than there are.
library ieee;
use ieee.std_logic_1164.all;
use work.shader_pkg.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity processors_shader_tb is
  generic (g_folder : string := "processors_shader");
end entity;

architecture sim of processors_shader_tb is
  -- The configurations are those of tb/vectors/processors_shader.cpp, then of tb/vectors/objects.cpp.
  constant c_hardware : hardwares_t := (
    hardware(processors),
    hardware(processors, positional => 1, spots => 1),
    hardware(processors, channels => 1, directional => 2, specular => false, normalize => false),
    hardware(processors, directional => 0, diffuse => false, specular => false),
    hardware(processors, directional => 0, positional => 1, unrolled => false),
    hardware(processors, exact => false, positional => 1, spots => 1, unrolled => false),
    hardware(processors, exact => false, channels => 1, normalize => false),
    hardware(processors, objects => 4),
    hardware(processors, positional => 1, shadows => true, objects => 4),
    hardware(processors, positional => 1, shadows => true, objects => 4, subpixels => 16),
    hardware(processors, exact => false, directional => 0, positional => 1, diffuse => false, shadows => true,
    unrolled => false, objects => 4, subpixels => 4));

  constant c_names : string := "directional all_kinds grey no_light folded published published_unrolled"
    & " objects shadows filtered published_shadows";
begin
  hardwares : for i in c_hardware'range generate
    constant c_objects : boolean := c_hardware(i).objects > 0;
  begin
    checker : entity work.shader_checker
      generic map (
        g_hardware => c_hardware(i),
        g_timed    => false,
        g_gapless  => c_hardware(i).unrolled and not c_objects,
        g_one_side => not c_objects and nth_word(c_names, i) /= "all_kinds",
        g_resets   => 10 - 5 * boolean'pos(c_objects),
        g_faults   => nth_word(c_names, i) /= "no_light",
        g_stem     => g_folder & "/" & nth_word(c_names, i) & "_");
  end generate;

  report_end(finished, "processors_shader_tb");
end architecture;
