-- SPDX-License-Identifier: Apache-2.0
-- Triangles of all kinds, lines and piles of objects. Every token is compared completely: at full speed, with a slow
-- source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity token_rasterizer_run is
  generic (
    g_exact       : boolean;
    g_channels    : positive;
    g_directional : natural;
    g_positional  : natural;
    g_spots       : natural;
    g_specular    : boolean;
    g_normalize   : boolean;
    g_shadows     : boolean;
    g_file        : string -- file name, or its start
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of token_rasterizer_run is
  constant c_config : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, true, g_specular,
    g_normalize, g_shadows);
  -- Number of words between changes of the pace.
  constant c_pace : positive := 60;

  signal clk         : std_logic := '0';
  signal reset       : std_logic := '1';
  signal init_valid  : std_logic := '0';
  signal init_ready  : std_logic;
  signal init        : std_logic_vector(init_bits(c_config) - 1 downto 0) := (others => '0');
  signal token_valid : std_logic;
  signal token_ready : std_logic := '0';
  signal token       : std_logic_vector(token_bits(c_config) - 1 downto 0);
  signal busy        : std_logic;
  signal slow_source : boolean := false;

  impure function slow (part, count : natural) return boolean is
  begin
    return (count / c_pace / part) mod 2 = 1;
  end function;
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

  clk <= not clk after c_half_period when not finished;

  source : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(init'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(token_bits(c_config), 32);
  begin
    vectors.open_file(g_file & "_init.txt");
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    while vectors.next_vector loop
      vectors.read_word(word);
      if slow_source then
        for i in 1 to to_integer(random(3 downto 0)) loop
          wait until rising_edge(clk);
        end loop;
        random := next_random(random);
      end if;
      init       <= word;
      init_valid <= '1';
      wait until rising_edge(clk) and init_ready = '1';
      init_valid <= '0';
      init       <= (others => 'X');
    end loop;
    wait;
  end process;

  sink : process is
    variable vectors : vectors_t;
    variable random  : unsigned(31 downto 0) := to_unsigned(3 * token_bits(c_config), 32);
    variable count   : natural := 0;
  begin
    vectors.open_file(g_file & "_tokens.txt");
    while vectors.next_vector loop
      slow_source <= slow(2, count);
      if slow(1, count) then
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 1);
          wait until rising_edge(clk);
        end loop;
      end if;
      token_ready <= '1';
      wait until rising_edge(clk) and token_valid = '1' and reset = '0';
      token_ready <= '0';
      if busy /= '1' then
        vectors.fail("a token is offered, but busy is " & to_string(busy));
      end if;
      vectors.check_word("token", token);
      count := count + 1;
    end loop;
    token_ready <= '1';
    for i in 1 to 100 loop
      wait until rising_edge(clk);
      if token_valid /= '0' then
        vectors.fail("a token more than there are");
      end if;
    end loop;
    if busy /= '0' then
      vectors.fail("busy after the last token");
    end if;
    finished <= true;
    wait;
  end process;

  steady : process (clk) is
    variable waiting : boolean := false;
    variable before  : std_logic_vector(token'range);
  begin
    if rising_edge(clk) then
      assert not waiting or (token_valid = '1' and token = before)
        report g_file & ": a token changes while it waits" severity failure;
      waiting := token_valid = '1' and token_ready = '0' and reset = '0';
      before  := token;
    end if;
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
    assert clocks = 3 or not (g_exact and g_channels = 3)
      report g_file & ": the first token comes after " & to_string(clocks) & " clocks, expected 3" severity failure;
    wait;
  end process;
end architecture;

entity token_rasterizer_tb is
  generic (
    g_folder : string := "token_rasterizer"
  );
end entity;

-- The configurations are those of write_parts in tb/vectors/processors_shader.cpp.
architecture sim of token_rasterizer_tb is
  signal finished : boolean_vector(0 to 3);
begin
  directional : entity work.token_rasterizer_run
    generic map (true, 3, 1, 0, 0, true, true, false, g_folder & "/directional")
    port map (finished(0));

  grey : entity work.token_rasterizer_run
    generic map (true, 1, 2, 0, 0, false, false, false, g_folder & "/grey")
    port map (finished(1));

  shadows : entity work.token_rasterizer_run
    generic map (true, 3, 1, 1, 0, true, true, true, g_folder & "/shadows")
    port map (finished(2));

  published : entity work.token_rasterizer_run
    generic map (false, 3, 1, 1, 1, true, true, false, g_folder & "/published")
    port map (finished(3));

  done : process is
  begin
    wait until and finished;
    report "token_rasterizer_tb: passed" severity note;
    wait;
  end process;
end architecture;
