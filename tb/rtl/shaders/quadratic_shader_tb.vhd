-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one and three channels, both degrees, by shader_checker. Without empty lines the shader outputs one
-- fragment per clock; only a triangle of a single pixel takes two clocks.
library ieee;
use ieee.std_logic_1164.all;
use work.shader_pkg.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity quadratic_shader_tb is
  generic (g_folder : string := "quadratic_shader");
end entity;

architecture sim of quadratic_shader_tb is
  constant c_hardware : hardwares_t := (
    hardware(quadratic),
    hardware(quadratic, channels => 1),
    hardware(quadratic, exact => false),
    hardware(quadratic, exact => false, channels => 1),
    hardware(quadratic, degree => 1),
    hardware(quadratic, channels => 1, degree => 1),
    hardware(quadratic, exact => false, degree => 1));

  constant c_names : string := "exact3 exact1 published3 published1 exact3_planes exact1_planes published3_planes";
begin
  hardwares : for i in c_hardware'range generate
    checker : entity work.shader_checker
      generic map (
        g_hardware => c_hardware(i),
        g_latency  => 8,
        g_gapless  => true,
        g_stem     => g_folder & "/" & nth_word(c_names, i) & "_");
  end generate;

  report_end(finished, "quadratic_shader_tb");
end architecture;
