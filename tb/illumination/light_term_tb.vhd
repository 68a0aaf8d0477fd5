-- SPDX-License-Identifier: Apache-2.0
-- Both terms of a directional light, a positional light and a spot: one object per clock, then with pauses. A light is
-- constant for 60 objects.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_term_run is
  generic (
    g_exact  : boolean;
    g_kind   : natural;
    g_light  : positive;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of light_term_run is
  constant c_config  : config_t := config(g_exact, 3, 1, 1, 1, true, true, true, true);
  constant c_latency : positive := times(c_config, g_kind, g_light).term;

  signal clk    : std_logic := '0';
  signal enable : std_logic := '0';
  signal light  : std_logic_vector(light_bits(c_config) - 1 downto 0) := (others => '0');
  signal token  : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal terms  : std_logic_vector(3 * product_bits(g_exact) - 1 downto 0);
  signal above  : std_logic;
begin
  dut : entity work.light_term
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk    => clk,
      enable => enable,
      light  => light,
      token  => token,
      terms  => terms,
      above  => above);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
    variable result  : std_logic_vector(terms'length downto 0);
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_kind) & to_string(g_light) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(light);
      vectors.drive(token);
      wait until rising_edge(clk);
      result := (others => '0');
      if above /= '0' then
        result := terms & above;
      end if;
      vectors.check_if(checked, "terms, above", result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity light_term_tb is
  generic (
    g_folder : string := "light_term"
  );
end entity;

architecture sim of light_term_tb is
  signal finished : boolean_vector(0 to 11);
begin
  presets : for preset in 0 to 1 generate
    lights : for light in 1 to 3 generate
      diffuse : entity work.light_term_run
        generic map (preset = 0, 1, light, g_folder)
        port map (finished(6 * preset + 2 * light - 2));

      specular : entity work.light_term_run
        generic map (preset = 0, 2, light, g_folder)
        port map (finished(6 * preset + 2 * light - 1));
    end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "light_term_tb: passed" severity note;
    wait;
  end process;
end architecture;
