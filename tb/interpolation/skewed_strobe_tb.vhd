-- SPDX-License-Identifier: Apache-2.0
-- Random strobes, checked in every clock: each part's strobe is that of the part below, one clock later.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_strobe_run is
  generic (
    g_parts  : positive;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of skewed_strobe_run is
  signal clk     : std_logic := '0';
  signal strobe  : std_logic := '0';
  signal strobes : std_logic_vector(g_parts - 1 downto 0);
begin
  dut : entity work.skewed_strobe
    generic map (g_parts => g_parts)
    port map (clk => clk, strobe => strobe, strobes => strobes);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/1_" & to_string(g_parts) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(strobe);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "strobes", strobes);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity skewed_strobe_tb is
  generic (
    g_folder : string := "skewed_strobe"
  );
end entity;

architecture sim of skewed_strobe_tb is
  signal finished : boolean_vector(0 to 2);
begin
  two_parts : entity work.skewed_strobe_run
    generic map (g_parts => 2, g_folder => g_folder)
    port map (finished => finished(0));

  one_part : entity work.skewed_strobe_run
    generic map (g_parts => 1, g_folder => g_folder)
    port map (finished => finished(1));

  three_parts : entity work.skewed_strobe_run
    generic map (g_parts => 3, g_folder => g_folder)
    port map (finished => finished(2));

  done : process is
  begin
    wait until and finished;
    report "skewed_strobe_tb: passed" severity note;
    wait;
  end process;
end architecture;
