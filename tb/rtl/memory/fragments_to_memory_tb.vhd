-- SPDX-License-Identifier: Apache-2.0
-- Both formats on buses of 32 and 64 bits, short blocks with few in flight, and more blocks in flight, by memory_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity fragments_to_memory_tb is
  generic (g_folder : string := "fragments_to_memory");
end entity;

architecture sim of fragments_to_memory_tb is
begin
  rgb565_64 : entity work.memory_checker
    generic map (g_number => 0, g_true_colour => false, g_data_bits => 64, g_file => g_folder & "/rgb565.txt", g_least => 0.9);

  xrgb8888_64 : entity work.memory_checker
    generic map (g_number => 1, g_true_colour => true, g_data_bits => 64, g_file => g_folder & "/xrgb8888.txt", g_least => 0.75);

  xrgb8888_32 : entity work.memory_checker
    generic map (g_number => 2, g_true_colour => true, g_data_bits => 32, g_file => g_folder & "/xrgb8888.txt");

  short_blocks : entity work.memory_checker
    generic map (g_number => 3, g_true_colour => false, g_data_bits => 32, g_block_bits => 4, g_slot_bits => 1,
      g_file => g_folder & "/rgb565.txt");

  at_port : entity work.memory_checker
    generic map (g_number => 6, g_true_colour => false, g_data_bits => 64, g_port_clocks => 2, g_file => g_folder & "/rgb565.txt");

    -- Measured only.
  more_blocks : entity work.memory_checker
    generic map (g_number => 4, g_true_colour => false, g_data_bits => 64, g_slot_bits => 4, g_file => "", g_least => 0.9);

  rgb565_32 : entity work.memory_checker
    generic map (g_number => 5, g_true_colour => false, g_data_bits => 32, g_file => "", g_least => 0.9);

  report_end(finished, "fragments_to_memory_tb");
end architecture;
