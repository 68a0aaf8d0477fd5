-- SPDX-License-Identifier: Apache-2.0
-- Sorted lists, heads without elements, and loads; and parts of triangles for which no processor was free. Every token is
-- compared.
library ieee;
use ieee.std_logic_1164.all;
use work.objects_pkg.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity object_output_tb is
  generic (g_folder : string := "object_output");
end entity;

architecture sim of object_output_tb is
begin
  fronts : for i in c_fronts'range generate
    constant c_config : config_t := c_fronts(i);
    constant c_n      : positive := c_subpixels(i);
  begin
    sets : for wrong in boolean generate
      constant c_set : string := front_name(i, wrong, "crowded");

      signal clk, reset, in_valid, in_ready, out_valid, out_ready, busy, fault : std_logic;
      signal in_word  : std_logic_vector(word_bits(c_config, c_n) - 1 downto 0);
      signal out_word : std_logic_vector(token_bits(c_config) + c_n downto 0);
    begin
      dut : entity work.object_output
        generic map (g_config => c_config, g_subpixels => c_n)
        port map (
          clk         => clk,
          reset       => reset,
          in_valid    => in_valid,
          in_ready    => in_ready,
          in_word     => in_word,
          token_valid => out_valid,
          token_ready => out_ready,
          token       => out_word(token_bits(c_config) - 1 downto 0),
          token_mask  => out_word(out_word'high - 1 downto token_bits(c_config)),
          token_ends  => out_word(out_word'high),
          busy        => busy,
          fault       => fault);

      check : entity work.stream_checker
        generic map (g_file => g_folder & "/" & c_set, g_fault => to_flag(wrong), g_first => (token_bits(c_config), c_n))
        port map (clk, reset, in_valid, in_ready, in_word, out_valid, out_ready, out_word, busy, fault);
    end generate;
  end generate;

  report_end(finished, "object_output_tb");
end architecture;
