-- SPDX-License-Identifier: Apache-2.0
-- Random cones; points in the rim, at its edges and at random: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity spot_cone_run is
  generic (
    g_exact       : boolean;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of spot_cone_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal axis_sum   : std_logic_vector((2 * formats(g_exact).direction.bits + 1) - 1 downto 0) := (others => '0');
  signal outer      : std_logic_vector(formats(g_exact).direction.bits - 1 downto 0) := (others => '0');
  signal slope      : std_logic_vector(formats(g_exact).spot_slope.bits - 1 downto 0) := (others => '0');
  signal factor     : std_logic_vector(formats(g_exact).weight.bits - 1 downto 0);
begin
  dut : entity work.spot_cone
    generic map (g_exact => g_exact)
    port map (clk => clk, enable => enable, axis_sum => axis_sum, outer => outer, slope => slope, factor => factor);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt", c_spot_cone_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(axis_sum);
      vectors.drive(outer);
      vectors.drive(slope);
      wait until rising_edge(clk);
      vectors.check_if(checked, "factor", factor);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity spot_cone_tb is
  generic (
    g_folder : string := "spot_cone"
  );
end entity;

architecture sim of spot_cone_tb is
  signal finished : boolean_vector(0 to 1);
begin
  run_0 : entity work.spot_cone_run
    generic map (g_exact => true, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.spot_cone_run
    generic map (g_exact => false, g_folder => g_folder)
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "spot_cone_tb: passed" severity note;
    wait;
  end process;
end architecture;
