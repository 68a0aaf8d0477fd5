-- SPDX-License-Identifier: Apache-2.0
-- Strips of triangles that overlap and cross, with 1, 4 and 16 subpixels, both presets and both forms, by shader_checker.
-- Lights are defined, redefined and deleted between strips; there are several frames, with other backgrounds. In a set with
-- a fault, a line needs more processors than there are.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity objects_shader_tb is
  generic (g_folder : string := "objects_shader");
end entity;

architecture sim of objects_shader_tb is
  -- The configurations are those of tb/vectors/objects.cpp.
  constant c_hardware : hardwares_t := (
    hardware(processors, objects => 4),
    hardware(processors, positional => 1, objects => 4, subpixels => 16),
    hardware(processors, exact => false, channels => 1, unrolled => false, objects => 4, subpixels => 4));

  constant c_names : string := "plain filtered published_folded";
begin
  hardwares : for i in c_hardware'range generate
    checker : entity work.shader_checker
      generic map (
        g_hardware => c_hardware(i),
        g_timed    => false,
        g_gapless  => false,
        g_one_side => false,
        g_resets   => 5,
        g_faults   => true,
        g_stem     => g_folder & "/" & nth_word(c_names, i) & "_");
  end generate;

  report_end(finished, "objects_shader_tb");
end architecture;
