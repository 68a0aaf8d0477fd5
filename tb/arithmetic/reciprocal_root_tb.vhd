-- SPDX-License-Identifier: Apache-2.0
-- All squares of small widths; otherwise squares around both ends of each cell, and random ones. One per clock, then
-- with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity reciprocal_root_run is
  generic (
    g_exact       : boolean;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of reciprocal_root_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal square     : std_logic_vector(formats(g_exact).square.bits - 1 downto 0) := (others => '0');
  signal reciprocal : std_logic_vector((formats(g_exact).root.bits + 1) - 1 downto 0);
begin
  dut : entity work.reciprocal_root
    generic map (g_exact => g_exact)
    port map (clk => clk, enable => enable, square => square, reciprocal => reciprocal);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt");
    vectors.expect_latency(reciprocal_root_latency(g_exact));
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(square);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "reciprocal", reciprocal);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity reciprocal_root_tb is
  generic (
    g_folder : string := "reciprocal_root"
  );
end entity;

architecture sim of reciprocal_root_tb is
  signal finished : boolean_vector(0 to 1);
begin
  run_0 : entity work.reciprocal_root_run
    generic map (g_exact => true, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.reciprocal_root_run
    generic map (g_exact => false, g_folder => g_folder)
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "reciprocal_root_tb: passed" severity note;
    wait;
  end process;
end architecture;
