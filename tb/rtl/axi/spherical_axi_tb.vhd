-- SPDX-License-Identifier: Apache-2.0
-- With and without line records, by axi_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity spherical_axi_tb is
  generic (g_folder : string := "spherical_axi");
end entity;

architecture sim of spherical_axi_tb is
begin
  two_lights : entity work.axi_checker
    generic map (
      g_hardware => hardware(spherical, lights => 2, highlight_channels => 3, powers => 22),
      g_stem     => g_folder & "/two_lights_");

  no_light : entity work.axi_checker
    generic map (g_hardware => hardware(spherical, lights => 0), g_stem => g_folder & "/no_light_");

  report_end(finished, "spherical_axi_tb");
end architecture;
