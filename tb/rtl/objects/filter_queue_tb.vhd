-- SPDX-License-Identifier: Apache-2.0
-- Lists of objects past a queue instead of the pipeline, which keeps objects and drops other tokens: every token into the
-- pipeline, and every token, weight and background to the filter. The filter is busy for some clocks after a token.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.filter_pkg.all;
use work.token_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity filter_queue_tb is
  generic (g_folder : string := "filter_queue");
end entity;

architecture sim of filter_queue_tb is
  constant c_busy_clocks : positive := 7;
begin
  fronts : for i in 0 to 1 generate
    constant c_config : config_t := c_fronts(i);
    constant c_n      : positive := c_subpixels(i);
    constant c_bits   : positive := token_bits(c_config);
    constant c_file   : string   := g_folder & "/" & front_name(i);

    signal clk, reset, in_valid, in_ready, out_valid, out_ready, busy : std_logic;
    signal in_word                                         : std_logic_vector(c_bits + c_n downto 0);
    signal out_word                                        : std_logic_vector(c_bits + weight_bits(c_n) + 23 downto 0);
    signal pipeline_valid, pipeline_ready, pipeline_object : std_logic;
    signal pipeline_token, shaded_token                    : std_logic_vector(c_bits - 1 downto 0);
    signal shaded_valid, shaded_ready                      : std_logic;
    signal filter_busy                                     : std_logic := '0';
  begin
    dut : entity work.filter_queue
      generic map (g_config => c_config, g_subpixels => c_n, g_index_bits => 4)
      port map (
        clk            => clk,
        reset          => reset,
        front_valid    => in_valid,
        front_ready    => in_ready,
        front_token    => in_word(c_bits - 1 downto 0),
        front_mask     => in_word(c_bits + c_n - 1 downto c_bits),
        front_ends     => in_word(c_bits + c_n),
        pipeline_valid => pipeline_valid,
        pipeline_ready => pipeline_ready,
        pipeline_token => pipeline_token,
        shaded_valid   => shaded_valid,
        shaded_ready   => shaded_ready,
        shaded_token   => shaded_token,
        filter_valid   => out_valid,
        filter_ready   => out_ready,
        filter_token   => out_word(c_bits - 1 downto 0),
        filter_weight  => out_word(c_bits + weight_bits(c_n) - 1 downto c_bits),
        filter_busy    => filter_busy,
        background     => out_word(out_word'high downto out_word'high - 23),
        busy           => busy);

    pipeline_object <= pipeline_valid and pipeline_ready when command_of(c_config.exact, pipeline_token) = c_new_object
      else '0';

    pipeline : entity work.stream_queue
      generic map (g_bits => c_bits)
      port map (
        clk       => clk,
        reset     => reset,
        claim     => pipeline_object,
        room      => pipeline_ready,
        pending   => open,
        in_valid  => pipeline_object,
        in_data   => pipeline_token,
        out_valid => shaded_valid,
        out_ready => shaded_ready,
        out_data  => shaded_token);

    filter : process is
    begin
      wait until rising_edge(clk) and out_valid = '1' and out_ready = '1';
      filter_busy <= '1';
      for clock in 1 to c_busy_clocks loop
        wait until rising_edge(clk);
      end loop;
      filter_busy <= '0';
    end process;

    enter : process is
      variable vectors : vectors_t;
    begin
      vectors.open_file(c_file & "_pipeline.txt");
      loop
        wait until rising_edge(clk) and reset = '0' and pipeline_valid = '1' and pipeline_ready = '1';
        vectors.expect_vector("a token for the pipeline");
        vectors.check("token", pipeline_token);
      end loop;
    end process;

    check : entity work.stream_checker
      generic map (g_file => c_file, g_widths => (0 => out_word'length))
      port map (clk, reset, in_valid, in_ready, in_word, out_valid, out_ready, out_word, busy, '0');
  end generate;

  report_end(finished, "filter_queue_tb");
end architecture;
