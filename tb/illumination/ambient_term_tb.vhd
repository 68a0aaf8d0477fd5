-- SPDX-License-Identifier: Apache-2.0
-- Objects with and without normalization of N, one per clock, then with pauses. A light is constant for 60 objects.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity ambient_term_run is
  generic (
    g_exact  : boolean;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of ambient_term_run is
  constant c_config  : config_t := config(g_exact, 3, 1, 1, 1, true, true, true, true);
  constant c_latency : positive := times(c_config, c_ambient, 0).term;
  constant c_vector  : positive := c_axes * formats(g_exact).direction.bits;

  signal clk     : std_logic := '0';
  signal enable  : std_logic := '0';
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0) := (others => '0');
  signal token   : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal delayed : std_logic_vector(token'range);
  signal terms   : std_logic_vector(3 * product_bits(g_exact) - 1 downto 0);
  signal normal  : std_logic_vector(c_vector - 1 downto 0);
  signal view    : std_logic_vector(c_vector - 1 downto 0);
begin
  dut : entity work.ambient_term
    generic map (g_config => c_config)
    port map (
      clk     => clk,
      enable  => enable,
      light   => light,
      token   => token,
      delayed => delayed,
      terms   => terms,
      normal  => normal,
      view    => view);

  late : entity work.delay_line
    generic map (token'length, c_latency)
    port map (clk, enable, token, delayed);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(light);
      vectors.drive(token);
      wait until rising_edge(clk);
      vectors.check_if(checked, "view, normal, terms", view & normal & terms);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity ambient_term_tb is
  generic (
    g_folder : string := "ambient_term"
  );
end entity;

architecture sim of ambient_term_tb is
  signal finished : boolean_vector(0 to 1);
begin
  presets : for preset in 0 to 1 generate
    checker : entity work.ambient_term_run
      generic map (preset = 0, g_folder)
      port map (finished(preset));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "ambient_term_tb: passed" severity note;
    wait;
  end process;
end architecture;
