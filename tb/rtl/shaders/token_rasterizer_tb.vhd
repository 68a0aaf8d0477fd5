-- SPDX-License-Identifier: Apache-2.0
-- Triangles of all kinds, piles of objects, and loads; and a vector with a command that no vector has. Every token is
-- compared completely.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity token_rasterizer_tb is
  generic (g_folder : string := "token_rasterizer");
end entity;

architecture sim of token_rasterizer_tb is
begin
  shaders : for i in 0 to 2 * c_shaders'length - 1 generate
    constant c_config : config_t := c_shaders(i / 2);
    constant c_wrong  : boolean  := i mod 2 = 1;
    constant c_file   : string   := g_folder & "/" & set_name(config_name(c_config), c_wrong, "refused");

    signal clk, reset, in_valid, in_ready, token_valid, token_ready, busy, fault : std_logic;
    signal in_vector : std_logic_vector(init_bits(c_config) - 1 downto 0);
    signal token     : std_logic_vector(token_bits(c_config) - 1 downto 0);
  begin
    dut : entity work.token_rasterizer
      generic map (g_config => c_config)
      port map (
        clk         => clk,
        reset       => reset,
        in_valid    => in_valid,
        in_ready    => in_ready,
        in_vector   => in_vector,
        token_valid => token_valid,
        token_ready => token_ready,
        token       => token,
        busy        => busy,
        fault       => fault);

    check : entity work.stream_checker
      generic map (g_file => c_file, g_fault => to_flag(c_wrong), g_passes => true, g_pace => 3, g_widths => (0 => token'length))
      port map (clk, reset, in_valid, in_ready, in_vector, token_valid, token_ready, token, busy, fault);

      -- A load is output in the clock in which it is offered, if no triangle is inside. The first triangle's first token is
      -- output 3 clocks after the triangle is offered.
    latency : if not c_wrong generate
      measure : process is
        variable clocks : natural := 0;
      begin
        loop
          wait until rising_edge(clk) and in_valid = '1';
          exit when is_load(command_of(c_config.exact, in_vector)) = '0';
          assert token_valid = '1' report c_file & ": a load waits" severity failure;
        end loop;
        loop
          wait until rising_edge(clk);
          clocks := clocks + 1;
          exit when token_valid = '1' or clocks > 3;
        end loop;
        assert clocks = 3 or not (c_config.exact and c_config.channels = 3)
          report c_file & ": the first token comes after " & to_string(clocks) & " clocks, expected 3" severity failure;
        wait;
      end process;
    end generate;
  end generate;

  report_end(finished, "token_rasterizer_tb");
end architecture;
