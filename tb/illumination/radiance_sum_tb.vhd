-- SPDX-License-Identifier: Apache-2.0
-- Colours and terms of any size, sums below and above the largest colour: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity radiance_sum_run is
  generic (
    g_exact    : boolean;
    g_channels : positive;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of radiance_sum_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := 1;

  signal clk      : std_logic := '0';
  signal enable   : std_logic := '0';
  signal add      : std_logic := '0';
  signal radiance : std_logic_vector(g_channels * c_formats.radiance.bits - 1 downto 0) := (others => '0');
  signal terms    : std_logic_vector(g_channels * product_bits(g_exact) - 1 downto 0) := (others => '0');
  signal result   : std_logic_vector(g_channels * c_formats.radiance.bits - 1 downto 0);
begin
  dut : entity work.radiance_sum
    generic map (g_exact => g_exact, g_channels => g_channels)
    port map (
      clk      => clk,
      enable   => enable,
      add      => add,
      radiance => radiance,
      terms    => terms,
      result   => result);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(add);
      vectors.drive(radiance);
      vectors.drive(terms);
      wait until rising_edge(clk);
      vectors.check_if(checked, "result", result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity radiance_sum_tb is
  generic (
    g_folder : string := "radiance_sum"
  );
end entity;

architecture sim of radiance_sum_tb is
  signal finished : boolean_vector(0 to 3);
begin
  presets : for preset in 0 to 1 generate
    grey : entity work.radiance_sum_run
      generic map (preset = 0, 1, g_folder)
      port map (finished(2 * preset + 0));

    colour : entity work.radiance_sum_run
      generic map (preset = 0, 3, g_folder)
      port map (finished(2 * preset + 1));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "radiance_sum_tb: passed" severity note;
    wait;
  end process;
end architecture;
