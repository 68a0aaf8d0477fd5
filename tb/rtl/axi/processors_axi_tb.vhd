-- SPDX-License-Identifier: Apache-2.0
-- The rasterizer, and object processors with shadows, by axi_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_shaders_pkg.all;
use work.tb_pkg.all;

entity processors_axi_tb is
  generic (g_folder : string := "processors_axi");
end entity;

architecture sim of processors_axi_tb is
begin
  directional : entity work.axi_checker
    generic map (
      g_hardware   => hardware(processors),
      g_timed      => false,
      g_limit_bits => 10,
      g_stem       => g_folder & "/directional_");

  shadows : entity work.axi_checker
    generic map (
      g_hardware => hardware(processors, positional => 1, shadows => true, objects => 4),
      g_timed    => false,
      g_faults   => true,
      g_stem     => g_folder & "/shadows_");

  report_end(finished, "processors_axi_tb");
end architecture;
