-- SPDX-License-Identifier: Apache-2.0
-- Both presets and both forms, lights of each kind, with and without each effect, by shader_checker. Lights are
-- defined, redefined and deleted between triangles; there are several frames; with shadows lines are drawn in three
-- rounds. All outputs of the golden model are compared. Clocks are only compared if the processors accept one token per
-- clock.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity processors_shader_tb is
  generic (
    g_folder : string  := "processors_shader";
    g_whole  : boolean := true -- false: with shadows, where a new frame takes 4096 clocks, only some of the passes
  );
end entity;

architecture sim of processors_shader_tb is
  -- The configurations are those of tb/vectors/processors_shader.cpp.
  constant c_hardware : hardwares_t := (
    hardware(processors),
    hardware(processors, positional => 1, spots => 1),
    hardware(processors, channels => 1, directional => 2, specular => false, normalize => false),
    hardware(processors, directional => 0, diffuse => false, specular => false),
    hardware(processors, positional => 1, shadows => true),
    hardware(processors, directional => 0, positional => 1, unrolled => false),
    hardware(processors, exact => false, positional => 1, spots => 1, unrolled => false),
    hardware(processors, exact => false, channels => 1, normalize => false),
    hardware(processors, exact => false, directional => 0, positional => 1, diffuse => false, shadows => true,
    unrolled => false));

  constant c_names : string := "directional all_kinds grey no_light shadows folded published published_unrolled"
    & " published_shadows";
begin
  hardwares : for i in c_hardware'range generate
    constant c_shadows : boolean := c_hardware(i).shadows;
  begin
    checker : entity work.shader_checker
      generic map (
        g_hardware => c_hardware(i),
        g_timed    => false,
        g_gapless  => c_hardware(i).unrolled and not c_shadows,
        g_one_side => g_whole or not c_shadows,
        g_resets   => 10 - 8 * boolean'pos(c_shadows) - boolean'pos(c_shadows and not g_whole),
        g_faults   => c_shadows and g_whole,
        g_stem     => g_folder & "/" & nth_word(c_names, i) & "_");
  end generate;

  report_end(finished, "processors_shader_tb");
end architecture;
