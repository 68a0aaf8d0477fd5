-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one channel and three, one term per channel and several. Sums around the largest colour and above.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity colour_sum_run is
  generic (
    g_exact     : boolean;
    g_channels  : positive;
    g_terms     : positive;
    g_data_bits : positive;
    g_folder    : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of colour_sum_run is
  signal clk     : std_logic := '0';
  signal enable  : std_logic := '0';
  signal terms   : std_logic_vector(g_terms * g_channels * term_bits(g_exact, g_data_bits) - 1 downto 0) :=
    (others => '0');
  signal colours : std_logic_vector(3 * formats(g_exact).colour.bits - 1 downto 0);
begin
  dut : entity work.colour_sum
    generic map (g_exact => g_exact, g_channels => g_channels, g_terms => g_terms, g_data_bits => g_data_bits)
    port map (clk => clk, enable => enable, terms => terms, colours => colours);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels) & "_"
      & to_string(g_terms) & "_" & to_string(g_data_bits) & ".txt", 1);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(terms);
      wait until rising_edge(clk);
      vectors.check_if(checked, "colours", colours);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity colour_sum_tb is
  generic (
    g_folder : string := "colour_sum"
  );
end entity;

architecture sim of colour_sum_tb is
  signal finished : boolean_vector(0 to 4);
begin
  ambient_only : entity work.colour_sum_run
    generic map (g_exact => true, g_channels => 3, g_terms => 1, g_data_bits => 8, g_folder => g_folder)
    port map (finished => finished(0));

  one_light : entity work.colour_sum_run
    generic map (g_exact => true, g_channels => 3, g_terms => 3, g_data_bits => 8, g_folder => g_folder)
    port map (finished => finished(1));

  two_lights : entity work.colour_sum_run
    generic map (g_exact => true, g_channels => 3, g_terms => 5, g_data_bits => 8, g_folder => g_folder)
    port map (finished => finished(2));

  grey : entity work.colour_sum_run
    generic map (g_exact => true, g_channels => 1, g_terms => 3, g_data_bits => 8, g_folder => g_folder)
    port map (finished => finished(3));

  published : entity work.colour_sum_run
    generic map (g_exact => false, g_channels => 3, g_terms => 3, g_data_bits => 6, g_folder => g_folder)
    port map (finished => finished(4));

  done : process is
  begin
    wait until and finished;
    report "colour_sum_tb: passed" severity note;
    wait;
  end process;
end architecture;
