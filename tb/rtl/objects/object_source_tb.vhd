-- SPDX-License-Identifier: Apache-2.0
-- Strips with triangles, and loads; and vectors that are refused. Every word is compared.
library ieee;
use ieee.std_logic_1164.all;
use work.objects_pkg.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity object_source_tb is
  generic (g_folder : string := "object_source");
end entity;

architecture sim of object_source_tb is
begin
  fronts : for i in c_fronts'range generate
    constant c_config : config_t := c_fronts(i);
    constant c_n      : positive := c_subpixels(i);
  begin
    sets : for wrong in boolean generate
      constant c_set : string := front_name(i, wrong, "refused");

      signal clk, reset, in_valid, in_ready, out_valid, out_ready, busy, fault : std_logic;
      signal in_word  : std_logic_vector(init_bits(c_config) - 1 downto 0);
      signal out_word : std_logic_vector(word_bits(c_config, c_n) - 1 downto 0);
    begin
      dut : entity work.object_source
        generic map (g_config => c_config, g_subpixels => c_n)
        port map (
          clk         => clk,
          reset       => reset,
          in_valid    => in_valid,
          in_ready    => in_ready,
          in_vector   => in_word,
          out_valid   => out_valid,
          out_ready   => out_ready,
          out_word    => out_word,
          busy        => busy,
          fault       => fault);

      check : entity work.stream_checker
        generic map (g_file => g_folder & "/" & c_set, g_fault => to_flag(wrong))
        port map (clk, reset, in_valid, in_ready, in_word, out_valid, out_ready, out_word, busy, fault);
    end generate;
  end generate;

  report_end(finished, "object_source_tb");
end architecture;
