-- SPDX-License-Identifier: Apache-2.0
-- Lights at any place and distance. One point per clock, then with pauses. A light is constant for 100 points.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_vector_run is
  generic (
    g_exact    : boolean;
    g_positional : boolean;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of light_vector_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := light_vector_latency(g_exact, g_positional);

  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal positional : std_logic := '0';
  signal place      : std_logic_vector(3 * c_formats.light_place.bits - 1 downto 0) := (others => '0');
  signal shift      : std_logic_vector(shift_bits(g_exact) - 1 downto 0) := (others => '0');
  signal point      : std_logic_vector(3 * c_formats.vector.bits - 1 downto 0) := (others => '0');
  signal distance   : std_logic_vector(c_formats.vector.bits - 1 downto 0) := (others => '0');
  signal to_light   : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0);
begin
  dut : entity work.light_vector
    generic map (g_exact => g_exact, g_positional => g_positional)
    port map (
      clk        => clk,
      enable     => enable,
      positional => positional,
      place      => place,
      shift      => shift,
      point      => point,
      distance   => distance,
      to_light   => to_light);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(boolean'pos(g_positional)) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(positional);
      vectors.drive(place);
      vectors.drive(shift);
      vectors.drive(point);
      vectors.drive(distance);
      wait until rising_edge(clk);
      vectors.check_if(checked, "to_light", to_light);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity light_vector_tb is
  generic (
    g_folder : string := "light_vector"
  );
end entity;

architecture sim of light_vector_tb is
  signal finished : boolean_vector(0 to 3);
begin
  presets : for preset in 0 to 1 generate
    directional : entity work.light_vector_run
      generic map (preset = 0, false, g_folder)
      port map (finished(2 * preset + 0));

    positional : entity work.light_vector_run
      generic map (preset = 0, true, g_folder)
      port map (finished(2 * preset + 1));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "light_vector_tb: passed" severity note;
    wait;
  end process;
end architecture;
