-- SPDX-License-Identifier: Apache-2.0
-- Random words through lines of several depths: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity delay_line_run is
  generic (
    g_bits        : positive;
    g_depth       : natural;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of delay_line_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal word       : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal delayed    : std_logic_vector(g_bits - 1 downto 0);
begin
  dut : entity work.delay_line
    generic map (g_bits => g_bits, g_depth => g_depth)
    port map (clk => clk, enable => enable, word => word, delayed => delayed);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & "_" & to_string(g_depth) & ".txt");
    vectors.expect_latency(g_depth);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(word);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "delayed", delayed);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity delay_line_tb is
  generic (
    g_folder : string := "delay_line"
  );
end entity;

architecture sim of delay_line_tb is
  signal finished : boolean_vector(0 to 5);
begin
  run_0 : entity work.delay_line_run
    generic map (g_bits => 8, g_depth => 1, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.delay_line_run
    generic map (g_bits => 70, g_depth => 2, g_folder => g_folder)
    port map (finished => finished(1));

  run_2 : entity work.delay_line_run
    generic map (g_bits => 1, g_depth => 3, g_folder => g_folder)
    port map (finished => finished(2));

  run_3 : entity work.delay_line_run
    generic map (g_bits => 33, g_depth => 4, g_folder => g_folder)
    port map (finished => finished(3));

  run_4 : entity work.delay_line_run
    generic map (g_bits => 100, g_depth => 13, g_folder => g_folder)
    port map (finished => finished(4));

  run_5 : entity work.delay_line_run
    generic map (g_bits => 8, g_depth => 0, g_folder => g_folder)
    port map (finished => finished(5));

  done : process is
  begin
    wait until and finished;
    report "delay_line_tb: passed" severity note;
    wait;
  end process;
end architecture;
