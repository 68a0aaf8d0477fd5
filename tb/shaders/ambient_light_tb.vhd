-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one channel and three, several depths. Random words and strobes.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity ambient_light_run is
  generic (
    g_exact     : boolean;
    g_channels  : positive;
    g_data_bits : positive;
    g_depth     : natural;
    g_folder    : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of ambient_light_run is
  constant c_term_bits : positive := term_bits(g_exact, g_data_bits);

  signal clk       : std_logic := '0';
  signal ambient   : std_logic_vector(ambient_bits(g_exact, g_channels) - 1 downto 0) := (others => '0');
  signal span_load : std_logic := '0';
  signal terms     : std_logic_vector(g_channels * c_term_bits - 1 downto 0);
begin
  dut : entity work.ambient_light
    generic map (g_exact => g_exact, g_channels => g_channels, g_data_bits => g_data_bits, g_depth => g_depth)
    port map (clk => clk, ambient => ambient, span_load => span_load, terms => terms);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels) & "_"
      & to_string(g_data_bits) & "_" & to_string(g_depth) & ".txt");
    while vectors.next_clock loop
      vectors.drive(ambient);
      vectors.drive(span_load);
      wait until rising_edge(clk);
      vectors.check_words("term of channel", c_term_bits, terms);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity ambient_light_tb is
  generic (
    g_folder : string := "ambient_light"
  );
end entity;

architecture sim of ambient_light_tb is
  signal finished : boolean_vector(0 to 2);
begin
  colour : entity work.ambient_light_run
    generic map (g_exact => true, g_channels => 3, g_data_bits => 8, g_depth => 4, g_folder => g_folder)
    port map (finished => finished(0));

  grey : entity work.ambient_light_run
    generic map (g_exact => true, g_channels => 1, g_data_bits => 8, g_depth => 4, g_folder => g_folder)
    port map (finished => finished(1));

  published : entity work.ambient_light_run
    generic map (g_exact => false, g_channels => 3, g_data_bits => 6, g_depth => 2, g_folder => g_folder)
    port map (finished => finished(2));

  done : process is
  begin
    wait until and finished;
    report "ambient_light_tb: passed" severity note;
    wait;
  end process;
end architecture;
