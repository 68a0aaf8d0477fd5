-- SPDX-License-Identifier: Apache-2.0
-- Colour and grey planes in preset exact, by axi_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity quadratic_axi_tb is
  generic (g_folder : string := "quadratic_axi");
end entity;

architecture sim of quadratic_axi_tb is
begin
  exact_colour : entity work.axi_checker
    generic map (g_hardware => hardware(quadratic), g_stem => g_folder & "/exact3_");

  exact_grey_planes : entity work.axi_checker
    generic map (g_hardware => hardware(quadratic, channels => 1, degree => 1), g_stem => g_folder & "/exact1_planes_");

  report_end(finished, "quadratic_axi_tb");
end architecture;
