-- SPDX-License-Identifier: Apache-2.0
-- Coefficients and intensities of any size: one product per clock, then with pauses. The weight follows its
-- coefficients after one clock.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity reflected_term_run is
  generic (
    g_exact    : boolean;
    g_channels : positive;
    g_weighted : boolean;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of reflected_term_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := 1 + boolean'pos(g_weighted);

  signal clk          : std_logic := '0';
  signal enable       : std_logic := '0';
  signal coefficients : std_logic_vector(g_channels * c_formats.coefficient.bits - 1 downto 0) := (others => '0');
  signal intensities  : std_logic_vector(g_channels * c_formats.light_intensity.bits - 1 downto 0) := (others => '0');
  signal weight       : std_logic_vector(c_formats.weight.bits - 1 downto 0) := (others => '0');
  signal terms        : std_logic_vector(g_channels * product_bits(g_exact) - 1 downto 0);
  signal weight_late  : std_logic_vector(weight'range);
begin
  dut : entity work.reflected_term
    generic map (g_exact => g_exact, g_channels => g_channels, g_weighted => g_weighted)
    port map (
      clk          => clk,
      enable       => enable,
      coefficients => coefficients,
      intensities  => intensities,
      weight       => weight_late,
      terms        => terms);

  late : entity work.delay_line
    generic map (weight'length, 1)
    port map (clk, enable, weight, weight_late);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels) & "_" & to_string(boolean'pos(g_weighted)) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(coefficients);
      vectors.drive(intensities);
      vectors.drive(weight);
      wait until rising_edge(clk);
      vectors.check_if(checked, "terms", terms);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity reflected_term_tb is
  generic (
    g_folder : string := "reflected_term"
  );
end entity;

architecture sim of reflected_term_tb is
  signal finished : boolean_vector(0 to 7);
begin
  presets : for preset in 0 to 1 generate
    ambient_1 : entity work.reflected_term_run
      generic map (preset = 0, 1, false, g_folder)
      port map (finished(4 * preset + 0));

    ambient_3 : entity work.reflected_term_run
      generic map (preset = 0, 3, false, g_folder)
      port map (finished(4 * preset + 1));

    light_1 : entity work.reflected_term_run
      generic map (preset = 0, 1, true, g_folder)
      port map (finished(4 * preset + 2));

    light_3 : entity work.reflected_term_run
      generic map (preset = 0, 3, true, g_folder)
      port map (finished(4 * preset + 3));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "reflected_term_tb: passed" severity note;
    wait;
  end process;
end architecture;
