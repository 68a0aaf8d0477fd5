-- SPDX-License-Identifier: Apache-2.0
-- Reads every entry of every table: in order, one per clock, then at random with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.function_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity function_rom_run is
  generic (
    g_exact       : boolean;
    g_which       : natural;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of function_rom_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal address    : std_logic_vector(function_format(g_exact, g_which).address_bits - 1 downto 0) := (others => '0');
  signal sample     : std_logic_vector(sample_bits(g_exact, g_which) - 1 downto 0);
begin
  dut : entity work.function_rom
    generic map (g_exact => g_exact, g_which => g_which)
    port map (clk => clk, enable => enable, address => address, sample => sample);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_which) & ".txt");
    vectors.expect_latency(1);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(address);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "sample", sample);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.function_pkg.all;

entity function_rom_tb is
  generic (
    g_folder : string := "function_rom"
  );
end entity;

architecture sim of function_rom_tb is
  signal finished : boolean_vector(0 to 5);
begin
  functions : for which in c_reciprocal_root to c_decay generate
    exact : entity work.function_rom_run
      generic map (g_exact => true, g_which => which, g_folder => g_folder)
      port map (finished => finished(which));

    published : entity work.function_rom_run
      generic map (g_exact => false, g_which => which, g_folder => g_folder)
      port map (finished => finished(c_decay + 1 + which));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "function_rom_tb: passed" severity note;
    wait;
  end process;
end architecture;
