-- SPDX-License-Identifier: Apache-2.0
-- Both presets, with and without each effect, one light and several, by shader_checker. With line records one clock is
-- lost between triangles if the last span has a single pixel. halfway_vectors checks this rule in the clocks that it
-- writes.
library ieee;
use ieee.std_logic_1164.all;
use work.cosine_pkg.all;
use work.shader_pkg.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity spherical_shader_tb is
  generic (g_folder : string := "spherical_shader");
end entity;

architecture sim of spherical_shader_tb is
  -- The configurations are those of tb/vectors/shaders.cpp.
  constant c_hardware : hardwares_t := (
    hardware(spherical),
    hardware(spherical, lights => 2, highlight_channels => 3, powers => 22),
    hardware(spherical, channels => 1, powers => 16),
    hardware(spherical, lights => 0),
    hardware(spherical, diffuse => false, highlight_channels => 3, powers => 9),
    hardware(spherical, specular => false),
    hardware(spherical, lights => 16, powers => 3),
    hardware(spherical, exact => false, highlight_channels => 3, cosine => rom6x6),
    hardware(spherical, exact => false, lights => 2, cosine => rom4x4),
    hardware(spherical, exact => false, channels => 1, diffuse => false, cosine => rom6x6),
    hardware(spherical, lights => 2, diffuse => false, specular => false));

  constant c_names : string := "white_highlights two_lights grey no_light highlights matte sixteen_lights published"
    & " published_4_4 published_highlights no_effect";
begin
  hardwares : for i in c_hardware'range generate
    checker : entity work.shader_checker
      generic map (
        g_hardware => c_hardware(i),
        g_latency  => 11,
        g_gapless  => not has_records(c_hardware(i)),
        g_stem     => g_folder & "/" & nth_word(c_names, i) & "_");
  end generate;

  report_end(finished, "spherical_shader_tb");
end architecture;
