-- SPDX-License-Identifier: Apache-2.0
-- Random skewed words, checked in every clock: the whole word is output with its last part.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity deskew_run is
  generic (
    g_bits   : positive;
    g_parts  : positive;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of deskew_run is
  signal clk    : std_logic := '0';
  signal skewed : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal word   : std_logic_vector(g_bits - 1 downto 0);
begin
  dut : entity work.deskew
    generic map (g_bits => g_bits, g_parts => g_parts)
    port map (clk => clk, skewed => skewed, word => word);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & "_" & to_string(g_parts) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(skewed);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "word", word);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity deskew_tb is
  generic (
    g_folder : string := "deskew"
  );
end entity;

architecture sim of deskew_tb is
  signal finished : boolean_vector(0 to 2);
begin
  two_parts : entity work.deskew_run
    generic map (g_bits => 40, g_parts => 2, g_folder => g_folder)
    port map (finished => finished(0));

  one_part : entity work.deskew_run
    generic map (g_bits => 32, g_parts => 1, g_folder => g_folder)
    port map (finished => finished(1));

  three_parts : entity work.deskew_run
    generic map (g_bits => 7, g_parts => 3, g_folder => g_folder)
    port map (finished => finished(2));

  done : process is
  begin
    wait until and finished;
    report "deskew_tb: passed" severity note;
    wait;
  end process;
end architecture;
