-- SPDX-License-Identifier: Apache-2.0
-- Both presets, with and without each part of a light. Every clock is compared with the golden model, each stage
-- stalling at random. Angles beyond the ends of the bell, and random words.
library ieee;
use ieee.std_logic_1164.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity spherical_light_run is
  generic (
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := 1;
    g_powers             : natural  := 2;
    g_address_bits       : positive := 9;
    g_data_bits          : positive := 8;
    g_file               : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of spherical_light_run is
  constant c_term_bits : positive := term_bits(g_exact, g_data_bits);
  constant c_terms     : positive := light_terms(g_diffuse, g_specular) * g_channels;

  signal clk         : std_logic := '0';
  signal part        : std_logic_vector(light_part_bits(g_exact, g_channels, g_diffuse, g_specular, g_highlight_channels)
    - 1 downto 0) := (others => '0');
  signal span_load   : std_logic := '0';
  signal span_step   : std_logic := '0';
  signal sample_step : std_logic := '0';
  signal terms       : std_logic_vector(c_terms * c_term_bits - 1 downto 0);
begin
  dut : entity work.spherical_light
    generic map (
      g_exact              => g_exact,
      g_channels           => g_channels,
      g_diffuse            => g_diffuse,
      g_specular           => g_specular,
      g_highlight_channels => g_highlight_channels,
      g_powers             => g_powers,
      g_address_bits       => g_address_bits,
      g_data_bits          => g_data_bits)
    port map (
      clk         => clk,
      part        => part,
      span_load   => span_load,
      span_step   => span_step,
      sample_step => sample_step,
      terms       => terms);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_file);
    while vectors.next_clock loop
      vectors.drive(part);
      vectors.drive(span_load);
      vectors.drive(span_step);
      vectors.drive(sample_step);
      wait until rising_edge(clk);
      vectors.check_words("term", c_term_bits, terms);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity spherical_light_tb is
  generic (
    g_folder : string := "spherical_light"
  );
end entity;

-- The lights are those of tb/vectors/illumination.cpp.
architecture sim of spherical_light_tb is
  signal finished : boolean_vector(0 to 6);
begin
  coloured_highlights : entity work.spherical_light_run
    generic map (g_highlight_channels => 3, g_powers => 18, g_file => g_folder & "/coloured_highlights.txt")
    port map (finished => finished(0));

  white_highlights : entity work.spherical_light_run
    generic map (g_file => g_folder & "/white_highlights.txt")
    port map (finished => finished(1));

  grey : entity work.spherical_light_run
    generic map (g_channels => 1, g_powers => 16, g_file => g_folder & "/grey.txt")
    port map (finished => finished(2));

  highlights : entity work.spherical_light_run
    generic map (g_diffuse => false, g_highlight_channels => 3, g_powers => 9, g_file => g_folder & "/highlights.txt")
    port map (finished => finished(3));

  matte : entity work.spherical_light_run
    generic map (g_specular => false, g_file => g_folder & "/matte.txt")
    port map (finished => finished(4));

  published : entity work.spherical_light_run
    generic map (g_exact => false, g_address_bits => 6, g_data_bits => 6, g_file => g_folder & "/published.txt")
    port map (finished => finished(5));

  published_highlights : entity work.spherical_light_run
    generic map (g_exact => false, g_channels => 1, g_diffuse => false, g_address_bits => 4, g_data_bits => 4,
      g_file => g_folder & "/published_highlights.txt")
    port map (finished => finished(6));

  done : process is
  begin
    wait until and finished;
    report "spherical_light_tb: passed" severity note;
    wait;
  end process;
end architecture;
