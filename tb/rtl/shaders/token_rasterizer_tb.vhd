-- SPDX-License-Identifier: Apache-2.0
-- Triangles of all kinds, lines and piles of objects. Every token is compared completely: at full speed, with a slow
-- source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity token_rasterizer_tb is
  generic (g_folder : string := "token_rasterizer");
end entity;

architecture sim of token_rasterizer_tb is
  -- Numbers of triangles and of tokens between changes of the pace.
  constant c_triangles : positive := 3;
  constant c_tokens    : positive := 120;
begin
  shaders : for i in c_shaders'range generate
    constant c_config : config_t := c_shaders(i);
    constant c_file   : string   := g_folder & "/" & config_name(c_config);

    signal ended                         : boolean := false;
    signal clk                           : std_logic := '0';
    signal reset, init_valid, init_ready : std_logic;
    signal init                          : std_logic_vector(init_bits(c_config) - 1 downto 0);
    signal token_valid, token_ready      : std_logic;
    signal token                         : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal busy                          : std_logic;
  begin
    dut : entity work.token_rasterizer
      generic map (g_config => c_config)
      port map (
        clk         => clk,
        reset       => reset,
        init_valid  => init_valid,
        init_ready  => init_ready,
        init        => init,
        token_valid => token_valid,
        token_ready => token_ready,
        token       => token,
        busy        => busy);

    clk <= not clk after c_half_period when not ended;

    source : entity work.stream_source
      generic map (g_file => c_file & "_init.txt", g_pace => c_triangles, g_pause => 4)
      port map (clk => clk, reset => reset, valid => init_valid, ready => init_ready, word => init, fed => open);

    sink : entity work.stream_sink
      generic map (g_name => c_file, g_pace => c_tokens, g_pause => 1)
      port map (clk => clk, reset => reset, valid => token_valid, ready => token_ready, word => token);

    check : process is
      variable vectors : vectors_t;
    begin
      vectors.open_file(c_file & "_tokens.txt");
      while vectors.next_vector loop
        wait until rising_edge(clk) and token_valid = '1' and token_ready = '1' and reset = '0';
        if busy /= '1' then
          vectors.fail("a token is offered, but busy is " & to_string(busy));
        end if;
        vectors.check("token", token);
      end loop;
      for clock in 1 to 100 loop
        wait until rising_edge(clk);
        if token_valid /= '0' then
          vectors.fail("a token more than there are");
        end if;
      end loop;
      if busy /= '0' then
        vectors.fail("busy after the last token");
      end if;
      ended <= true;
      finish(finished);
    end process;

    -- The first token of a file is output 3 clocks after its triangle is offered.
    latency : process is
      variable clocks : natural := 0;
    begin
      wait until rising_edge(clk) and init_valid = '1';
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

  report_end(finished, "token_rasterizer_tb");
end architecture;
