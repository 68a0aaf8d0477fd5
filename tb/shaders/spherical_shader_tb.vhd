-- SPDX-License-Identifier: Apache-2.0
-- Both presets, with and without each effect, one light and several, by shader_checker. With line records one clock is
-- lost between triangles if the last span has a single pixel. halfway_vectors checks this rule in the clocks that it
-- writes.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity spherical_shader_run is
  generic (
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_lights             : natural  := 1;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := 1;
    g_powers             : natural  := 2;
    g_address_bits       : positive := 9;
    g_data_bits          : positive := 8;
    g_stem               : string -- start of the file names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of spherical_shader_run is
  constant c_init_bits : positive := init_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
    g_highlight_channels);
  constant c_records : boolean := record_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
    g_highlight_channels) > 0;

  signal clk               : std_logic;
  signal reset             : std_logic;
  signal init_valid        : std_logic;
  signal init_ready        : std_logic;
  signal init_data         : std_logic_vector(c_init_bits - 1 downto 0);
  signal fragment_valid    : std_logic;
  signal fragment_ready    : std_logic;
  signal fragment_triangle : std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
  signal fragment_y        : std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
  signal fragment_x        : std_logic_vector(formats(g_exact).pixel_x.bits - 1 downto 0);
  signal fragment_z        : std_logic_vector(formats(g_exact).depth.bits - 1 downto 0);
  signal fragment_red      : std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
  signal fragment_green    : std_logic_vector(fragment_red'range);
  signal fragment_blue     : std_logic_vector(fragment_red'range);
  signal busy              : std_logic;
  signal fault             : std_logic;
begin
  dut : entity work.spherical_shader
    generic map (
      g_exact              => g_exact,
      g_channels           => g_channels,
      g_lights             => g_lights,
      g_diffuse            => g_diffuse,
      g_specular           => g_specular,
      g_highlight_channels => g_highlight_channels,
      g_powers             => g_powers,
      g_address_bits       => g_address_bits,
      g_data_bits          => g_data_bits)
    port map (
      clk               => clk,
      reset             => reset,
      init_valid        => init_valid,
      init_ready        => init_ready,
      init_data         => init_data,
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => fragment_triangle,
      fragment_y        => fragment_y,
      fragment_x        => fragment_x,
      fragment_z        => fragment_z,
      fragment_red      => fragment_red,
      fragment_green    => fragment_green,
      fragment_blue     => fragment_blue,
      busy              => busy,
      fault             => fault);

  checker : entity work.shader_checker
    generic map (
      g_exact      => g_exact,
      g_init_bits  => c_init_bits,
      g_latency    => 11,
      g_gapless    => not c_records,
      g_stem       => g_stem)
    port map (
      clk               => clk,
      reset             => reset,
      init_valid        => init_valid,
      init_ready        => init_ready,
      init_data         => init_data,
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => fragment_triangle,
      fragment_y        => fragment_y,
      fragment_x        => fragment_x,
      fragment_z        => fragment_z,
      fragment_red      => fragment_red,
      fragment_green    => fragment_green,
      fragment_blue     => fragment_blue,
      busy              => busy,
      fault             => fault,
      finished          => finished);
end architecture;

entity spherical_shader_tb is
  generic (
    g_folder : string := "spherical_shader"
  );
end entity;

-- The configurations are those of tb/vectors/shaders.cpp.
architecture sim of spherical_shader_tb is
  signal finished : boolean_vector(0 to 10);
begin
  white_highlights : entity work.spherical_shader_run
    generic map (g_stem => g_folder & "/white_highlights_")
    port map (finished => finished(0));

  two_lights : entity work.spherical_shader_run
    generic map (g_lights => 2, g_highlight_channels => 3, g_powers => 22, g_stem => g_folder & "/two_lights_")
    port map (finished => finished(1));

  grey : entity work.spherical_shader_run
    generic map (g_channels => 1, g_powers => 16, g_stem => g_folder & "/grey_")
    port map (finished => finished(2));

  no_light : entity work.spherical_shader_run
    generic map (g_lights => 0, g_stem => g_folder & "/no_light_")
    port map (finished => finished(3));

  highlights : entity work.spherical_shader_run
    generic map (g_diffuse => false, g_highlight_channels => 3, g_powers => 9, g_stem => g_folder & "/highlights_")
    port map (finished => finished(4));

  matte : entity work.spherical_shader_run
    generic map (g_specular => false, g_stem => g_folder & "/matte_")
    port map (finished => finished(5));

  sixteen_lights : entity work.spherical_shader_run
    generic map (g_lights => 16, g_powers => 3, g_stem => g_folder & "/sixteen_lights_")
    port map (finished => finished(6));

  published : entity work.spherical_shader_run
    generic map (g_exact => false, g_highlight_channels => 3, g_address_bits => 6, g_data_bits => 6,
      g_stem => g_folder & "/published_")
    port map (finished => finished(7));

  published_4_4 : entity work.spherical_shader_run
    generic map (g_exact => false, g_lights => 2, g_address_bits => 4, g_data_bits => 4,
      g_stem => g_folder & "/published_4_4_")
    port map (finished => finished(8));

  published_highlights : entity work.spherical_shader_run
    generic map (g_exact => false, g_channels => 1, g_diffuse => false, g_address_bits => 6, g_data_bits => 6,
      g_stem => g_folder & "/published_highlights_")
    port map (finished => finished(9));

  no_effect : entity work.spherical_shader_run
    generic map (g_lights => 2, g_diffuse => false, g_specular => false, g_stem => g_folder & "/no_effect_")
    port map (finished => finished(10));

  done : process is
  begin
    wait until and finished;
    report "spherical_shader_tb: passed" severity note;
    wait;
  end process;
end architecture;
