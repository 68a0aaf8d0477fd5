-- SPDX-License-Identifier: Apache-2.0
-- All bases of small widths. For other widths bases around each power of two, and random bases; for powers that are 0
-- or 1 almost everywhere, random bases between. One per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity power_run is
  generic (
    g_exact       : boolean;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of power_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal base       : std_logic_vector((formats(g_exact).direction.fraction + 1) - 1 downto 0) := (others => '0');
  signal exponent   : std_logic_vector(formats(g_exact).exponent.bits - 1 downto 0) := (others => '0');
  signal result     : std_logic_vector(formats(g_exact).weight.bits - 1 downto 0);
begin
  dut : entity work.power
    generic map (g_exact => g_exact)
    port map (clk => clk, enable => enable, base => base, exponent => exponent, result => result);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt");
    vectors.expect_latency(power_latency(g_exact));
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(base);
      vectors.drive(exponent);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "result", result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity power_tb is
  generic (
    g_folder : string := "power"
  );
end entity;

architecture sim of power_tb is
  signal finished : boolean_vector(0 to 1);
begin
  run_0 : entity work.power_run
    generic map (g_exact => true, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.power_run
    generic map (g_exact => false, g_folder => g_folder)
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "power_tb: passed" severity note;
    wait;
  end process;
end architecture;
