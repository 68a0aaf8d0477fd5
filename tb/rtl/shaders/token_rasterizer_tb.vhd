-- SPDX-License-Identifier: Apache-2.0
-- Triangles of all kinds, piles of objects, and loads. Every token is compared completely: at full speed, with a slow
-- source, with a slow sink, and with both. At the end comes a vector with a command that no vector has.
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
  -- Numbers of triangles and of tokens between changes of the pace.
  constant c_triangles : positive := 3;
  constant c_tokens    : positive := 120;
begin
  shaders : for i in c_shaders'range generate
    constant c_config : config_t := c_shaders(i);
    constant c_file   : string   := g_folder & "/" & config_name(c_config);

    signal ended                         : boolean := false;
    signal clk                           : std_logic := '0';
    signal reset, in_valid, in_ready     : std_logic;
    signal in_vector                     : std_logic_vector(init_bits(c_config) - 1 downto 0);
    signal file_valid                    : std_logic;
    signal file_vector                   : std_logic_vector(in_vector'range);
    signal refused                       : std_logic := '0'; -- offer a vector that is refused
    signal token_valid, token_ready      : std_logic;
    signal token                         : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal busy, fault                   : std_logic;
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

    clk <= not clk after c_half_period when not ended;

    source : entity work.stream_source
      generic map (g_file => c_file & "_in.txt", g_pace => c_triangles, g_pause => 4)
      port map (clk => clk, reset => reset, valid => file_valid, ready => in_ready, word => file_vector, fed => open);

    in_valid  <= file_valid or refused;
    in_vector <= file_vector when refused = '0' else (in_vector'range => '0');

    sink : entity work.stream_sink
      generic map (g_name => c_file, g_pace => c_tokens, g_pause => 1)
      port map (clk => clk, reset => reset, valid => token_valid, ready => token_ready, word => token);

    check : process is
      variable vectors : vectors_t;
    begin
      vectors.open_file(c_file & "_tokens.txt");
      while vectors.next_vector loop
        wait until rising_edge(clk) and token_valid = '1' and token_ready = '1' and reset = '0';
        if busy /= is_object(command_of(c_config.exact, token)) or fault /= '0' then
          vectors.fail("a token is offered, but busy is " & to_string(busy) & ", fault " & to_string(fault));
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
      refused <= '1';
      wait until rising_edge(clk);
      assert in_ready = '1' and token_valid = '0' report c_file & ": command 0 is not dropped" severity failure;
      refused <= '0';
      wait until rising_edge(clk);
      wait until rising_edge(clk);
      assert fault = '1' report c_file & ": no fault after command 0" severity failure;
      ended <= true;
      finish(finished);
    end process;

    -- A load is output in the clock in which it is offered, if no triangle is inside. The first triangle's first token is
    -- output 3 clocks after the triangle is offered.
    latency : process is
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

  report_end(finished, "token_rasterizer_tb");
end architecture;
