-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of seven pipelines against the golden model, by processor_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity shading_processor_tb is
  generic (g_folder : string := "shading_processor");
end entity;

architecture sim of shading_processor_tb is
begin
  checker : entity work.processor_checker
    generic map (g_unrolled => false, g_folder => g_folder);

  report_end(finished, "shading_processor_tb");
end architecture;
