-- SPDX-License-Identifier: Apache-2.0
-- Both presets and both forms, lights of each kind, with and without each effect, by shader_checker. Lights are
-- defined, redefined and deleted between triangles; there are several frames; with shadows lines are drawn in three
-- rounds. All outputs of the golden model are compared. Clocks are only compared if the processors accept one token per
-- clock.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity processors_shader_run is
  generic (
    g_exact       : boolean;
    g_channels    : positive;
    g_directional : natural;
    g_positional  : natural;
    g_spots       : natural;
    g_diffuse     : boolean;
    g_specular    : boolean;
    g_normalize   : boolean;
    g_shadows     : boolean;
    g_unrolled    : boolean;
    g_stem        : string -- start of the file names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of processors_shader_run is
  constant c_config    : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_init_bits : positive := init_bits(c_config);

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
  dut : entity work.processors_shader
    generic map (
      g_exact       => g_exact,
      g_channels    => g_channels,
      g_directional => g_directional,
      g_positional  => g_positional,
      g_spots       => g_spots,
      g_diffuse     => g_diffuse,
      g_specular    => g_specular,
      g_normalize   => g_normalize,
      g_shadows     => g_shadows,
      g_unrolled    => g_unrolled)
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
      g_timed      => false,
      g_gapless    => g_unrolled and not g_shadows,
      g_resets     => 10 - 8 * boolean'pos(g_shadows),
      g_faults     => g_shadows,
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

entity processors_shader_tb is
  generic (
    g_folder : string := "processors_shader"
  );
end entity;

-- The configurations are those of tb/vectors/processors_shader.cpp.
architecture sim of processors_shader_tb is
  signal finished : boolean_vector(0 to 8);
begin
  directional : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 3, g_directional => 1, g_positional => 0, g_spots => 0,
      g_diffuse => true, g_specular => true, g_normalize => true, g_shadows => false, g_unrolled => true,
      g_stem => g_folder & "/directional_")
    port map (finished => finished(0));

  all_kinds : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 3, g_directional => 1, g_positional => 1, g_spots => 1,
      g_diffuse => true, g_specular => true, g_normalize => true, g_shadows => false, g_unrolled => true,
      g_stem => g_folder & "/all_kinds_")
    port map (finished => finished(1));

  grey : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 1, g_directional => 2, g_positional => 0, g_spots => 0,
      g_diffuse => true, g_specular => false, g_normalize => false, g_shadows => false, g_unrolled => true,
      g_stem => g_folder & "/grey_")
    port map (finished => finished(2));

  no_light : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 3, g_directional => 0, g_positional => 0, g_spots => 0,
      g_diffuse => false, g_specular => false, g_normalize => true, g_shadows => false, g_unrolled => true,
      g_stem => g_folder & "/no_light_")
    port map (finished => finished(3));

  shadows : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 3, g_directional => 1, g_positional => 1, g_spots => 0,
      g_diffuse => true, g_specular => true, g_normalize => true, g_shadows => true, g_unrolled => true,
      g_stem => g_folder & "/shadows_")
    port map (finished => finished(4));

  folded : entity work.processors_shader_run
    generic map (g_exact => true, g_channels => 3, g_directional => 0, g_positional => 1, g_spots => 0,
      g_diffuse => true, g_specular => true, g_normalize => true, g_shadows => false, g_unrolled => false,
      g_stem => g_folder & "/folded_")
    port map (finished => finished(5));

  published : entity work.processors_shader_run
    generic map (g_exact => false, g_channels => 3, g_directional => 1, g_positional => 1, g_spots => 1,
      g_diffuse => true, g_specular => true, g_normalize => true, g_shadows => false, g_unrolled => false,
      g_stem => g_folder & "/published_")
    port map (finished => finished(6));

  published_unrolled : entity work.processors_shader_run
    generic map (g_exact => false, g_channels => 1, g_directional => 1, g_positional => 0, g_spots => 0,
      g_diffuse => true, g_specular => true, g_normalize => false, g_shadows => false, g_unrolled => true,
      g_stem => g_folder & "/published_unrolled_")
    port map (finished => finished(7));

  published_shadows : entity work.processors_shader_run
    generic map (g_exact => false, g_channels => 3, g_directional => 0, g_positional => 1, g_spots => 0,
      g_diffuse => false, g_specular => true, g_normalize => true, g_shadows => true, g_unrolled => false,
      g_stem => g_folder & "/published_shadows_")
    port map (finished => finished(8));

  done : process is
  begin
    wait until and finished;
    report "processors_shader_tb: passed" severity note;
    wait;
  end process;
end architecture;
