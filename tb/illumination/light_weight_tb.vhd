-- SPDX-License-Identifier: Apache-2.0
-- Spots and other lights, points inside and outside the cone: one per clock, then with pauses. The cosine follows its
-- direction after g_lead clocks.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity light_weight_run is
  generic (
    g_exact    : boolean;
    g_lead     : positive;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of light_weight_run is
  constant c_formats : formats_t := formats(g_exact);
  constant c_latency : natural   := g_lead + light_weight_latency(true, g_lead);

  signal clk      : std_logic := '0';
  signal enable   : std_logic := '0';
  signal spot     : std_logic := '0';
  signal axis     : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal outer    : std_logic_vector(c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal slope    : std_logic_vector(c_formats.spot_slope.bits - 1 downto 0) := (others => '0');
  signal to_light : std_logic_vector(3 * c_formats.direction.bits - 1 downto 0) := (others => '0');
  signal cosine   : std_logic_vector(c_formats.weight.bits - 1 downto 0) := (others => '0');
  signal weight   : std_logic_vector(c_formats.weight.bits - 1 downto 0);
  signal cosine_late : std_logic_vector(cosine'range);
begin
  dut : entity work.light_weight
    generic map (g_exact => g_exact, g_lead => g_lead)
    port map (
      clk      => clk,
      enable   => enable,
      spot     => spot,
      axis     => axis,
      outer    => outer,
      slope    => slope,
      to_light => to_light,
      cosine   => cosine_late,
      weight   => weight);

  late : entity work.delay_line
    generic map (cosine'length, g_lead)
    port map (clk, enable, cosine, cosine_late);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_lead) & ".txt", c_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(spot);
      vectors.drive(axis);
      vectors.drive(outer);
      vectors.drive(slope);
      vectors.drive(to_light);
      vectors.drive(cosine);
      wait until rising_edge(clk);
      vectors.check_if(checked, "weight", weight);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity light_weight_tb is
  generic (
    g_folder : string := "light_weight"
  );
end entity;

architecture sim of light_weight_tb is
  signal finished : boolean_vector(0 to 3);
begin
  presets : for preset in 0 to 1 generate
    cone_last : entity work.light_weight_run
      generic map (preset = 0, 2, g_folder)
      port map (finished(2 * preset + 0));

    cosine_last : entity work.light_weight_run
      generic map (preset = 0, 16, g_folder)
      port map (finished(2 * preset + 1));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "light_weight_tb: passed" severity note;
    wait;
  end process;
end architecture;
