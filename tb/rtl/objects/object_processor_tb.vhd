-- SPDX-License-Identifier: Apache-2.0
-- Words of strips, as they come from another processor: heads, elements, loads, and parts of triangles for this processor
-- and for the next ones. Every word is compared.
library ieee;
use ieee.std_logic_1164.all;
use work.objects_pkg.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity object_processor_tb is
  generic (g_folder : string := "object_processor");
end entity;

architecture sim of object_processor_tb is
begin
  fronts : for i in c_fronts'range generate
    constant c_config : config_t := c_fronts(i);
    constant c_n      : positive := c_subpixels(i);

    signal clk, reset, in_valid, in_ready, out_valid, out_ready, busy : std_logic;
    signal in_word, out_word : std_logic_vector(word_bits(c_config, c_n) - 1 downto 0);
  begin
    dut : entity work.object_processor
      generic map (g_config => c_config, g_subpixels => c_n)
      port map (
        clk       => clk,
        reset     => reset,
        in_valid  => in_valid,
        in_ready  => in_ready,
        in_word   => in_word,
        out_valid => out_valid,
        out_ready => out_ready,
        out_word  => out_word,
        busy      => busy);

    check : entity work.stream_checker
      generic map (g_file => g_folder & "/" & front_name(i))
      port map (clk, reset, in_valid, in_ready, in_word, out_valid, out_ready, out_word, busy, '0');
  end generate;

  report_end(finished, "object_processor_tb");
end architecture;
