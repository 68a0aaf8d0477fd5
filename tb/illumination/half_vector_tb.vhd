-- SPDX-License-Identifier: Apache-2.0
-- Directions to light and eye at angles of any size: one pair per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity half_vector_run is
  generic (
    g_exact    : boolean;
    g_normalize : boolean;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of half_vector_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := half_vector_latency(g_exact, g_normalize);

  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal positional : std_logic := '0';
  signal to_light   : std_logic_vector(3 * half_light_bits(g_exact) - 1 downto 0) := (others => '0');
  signal to_eye     : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal half       : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0);
begin
  dut : entity work.half_vector
    generic map (g_exact => g_exact, g_normalize => g_normalize)
    port map (
      clk        => clk,
      enable     => enable,
      positional => positional,
      to_light   => to_light,
      to_eye     => to_eye,
      half       => half);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(boolean'pos(g_normalize)) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(positional);
      vectors.drive(to_light);
      vectors.drive(to_eye);
      wait until rising_edge(clk);
      vectors.check_if(checked, "half", half);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity half_vector_tb is
  generic (
    g_folder : string := "half_vector"
  );
end entity;

architecture sim of half_vector_tb is
  signal finished : boolean_vector(0 to 3);
begin
  presets : for preset in 0 to 1 generate
    constant_half : entity work.half_vector_run
      generic map (preset = 0, false, g_folder)
      port map (finished(2 * preset + 0));

    normalized : entity work.half_vector_run
      generic map (preset = 0, true, g_folder)
      port map (finished(2 * preset + 1));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "half_vector_tb: passed" severity note;
    wait;
  end process;
end architecture;
