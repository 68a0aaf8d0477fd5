-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one and three channels, both degrees, by shader_checker. Without empty lines the shader outputs one fragment per
-- clock; only a triangle of a single pixel takes two clocks.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.quadratic_pkg.all;
use work.tb_pkg.all;

entity quadratic_shader_run is
  generic (
    g_exact    : boolean;
    g_channels : positive;
    g_degree   : positive := 2;
    g_stem     : string -- start of the file names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of quadratic_shader_run is
  signal clk               : std_logic;
  signal reset             : std_logic;
  signal init_valid        : std_logic;
  signal init_ready        : std_logic;
  signal init_data         : std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0);
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
  dut : entity work.quadratic_shader
    generic map (g_exact => g_exact, g_channels => g_channels, g_degree => g_degree)
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
      g_init_bits  => init_data'length,
      g_latency    => 8,
      g_gapless    => true,
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

entity quadratic_shader_tb is
  generic (
    g_folder : string := "quadratic_shader"
  );
end entity;

architecture sim of quadratic_shader_tb is
  signal finished : boolean_vector(0 to 6);
begin
  exact_colour : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 3, g_stem => g_folder & "/exact3_")
    port map (finished => finished(0));

  exact_grey : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 1, g_stem => g_folder & "/exact1_")
    port map (finished => finished(1));

  published_colour : entity work.quadratic_shader_run
    generic map (g_exact => false, g_channels => 3, g_stem => g_folder & "/published3_")
    port map (finished => finished(2));

  published_grey : entity work.quadratic_shader_run
    generic map (g_exact => false, g_channels => 1, g_stem => g_folder & "/published1_")
    port map (finished => finished(3));

  exact_planes : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 3, g_degree => 1, g_stem => g_folder & "/exact3_planes_")
    port map (finished => finished(4));

  exact_grey_planes : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 1, g_degree => 1, g_stem => g_folder & "/exact1_planes_")
    port map (finished => finished(5));

  published_planes : entity work.quadratic_shader_run
    generic map (g_exact => false, g_channels => 3, g_degree => 1, g_stem => g_folder & "/published3_planes_")
    port map (finished => finished(6));

  done : process is
  begin
    wait until and finished;
    report "quadratic_shader_tb: passed" severity note;
    wait;
  end process;
end architecture;
