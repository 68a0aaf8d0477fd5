-- SPDX-License-Identifier: Apache-2.0
-- Random loads and waits. Every clock is compared with the golden model of parameter_register, with its two words
-- skewed.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_register_run is
  generic (
    g_bits   : positive;
    g_parts  : positive;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of skewed_register_run is
  constant c_words : positive := 2;

  signal clk   : std_logic := '0';
  signal load  : std_logic := '0';
  signal start : std_logic_vector(c_words * g_bits - 1 downto 0) := (others => '0');
  signal value : std_logic_vector(c_words * g_bits - 1 downto 0);
begin
  dut : entity work.skewed_register
    generic map (g_bits => g_bits, g_parts => g_parts, g_words => c_words)
    port map (clk => clk, load => load, start => start, value => value);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & "_" & to_string(g_parts) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(load);
      vectors.drive(start);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "value", value);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity skewed_register_tb is
  generic (
    g_folder : string := "skewed_register"
  );
end entity;

architecture sim of skewed_register_tb is
  signal finished : boolean_vector(0 to 2);
begin
  two_parts : entity work.skewed_register_run
    generic map (g_bits => 20, g_parts => 2, g_folder => g_folder)
    port map (finished => finished(0));

  one_part : entity work.skewed_register_run
    generic map (g_bits => 32, g_parts => 1, g_folder => g_folder)
    port map (finished => finished(1));

  three_parts : entity work.skewed_register_run
    generic map (g_bits => 7, g_parts => 3, g_folder => g_folder)
    port map (finished => finished(2));

  done : process is
  begin
    wait until and finished;
    report "skewed_register_tb: passed" severity note;
    wait;
  end process;
end architecture;
