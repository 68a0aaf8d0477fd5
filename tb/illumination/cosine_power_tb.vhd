-- SPDX-License-Identifier: Apache-2.0
-- Directions at angles of any size: one pair per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity cosine_power_run is
  generic (
    g_exact    : boolean;
    g_highlight : boolean;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of cosine_power_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := cosine_power_latency(g_exact, g_highlight);

  signal clk       : std_logic := '0';
  signal enable    : std_logic := '0';
  signal normal    : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal direction : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal exponent  : std_logic_vector(c_formats.exponent.bits - 1 downto 0) := (others => '0');
  signal result    : std_logic_vector(c_formats.weight.bits - 1 downto 0);
begin
  dut : entity work.cosine_power
    generic map (g_exact => g_exact, g_highlight => g_highlight)
    port map (
      clk       => clk,
      enable    => enable,
      normal    => normal,
      direction => direction,
      exponent  => exponent,
      result    => result);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(boolean'pos(g_highlight)) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(normal);
      vectors.drive(direction);
      vectors.drive(exponent);
      wait until rising_edge(clk);
      vectors.check_if(checked, "result", result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity cosine_power_tb is
  generic (
    g_folder : string := "cosine_power"
  );
end entity;

architecture sim of cosine_power_tb is
  signal finished : boolean_vector(0 to 3);
begin
  presets : for preset in 0 to 1 generate
    diffuse : entity work.cosine_power_run
      generic map (preset = 0, false, g_folder)
      port map (finished(2 * preset + 0));

    highlight : entity work.cosine_power_run
      generic map (preset = 0, true, g_folder)
      port map (finished(2 * preset + 1));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "cosine_power_tb: passed" severity note;
    wait;
  end process;
end architecture;
