-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of five pipelines against the golden twin (processors_checker).
-- Beside the vectors, the clocks from a token taken to the same one offered that the entity's header promises.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity unrolled_latency_run is
  generic (
    g_exact       : boolean;
    g_directional : natural := 0;
    g_positional  : natural := 0;
    g_spots       : natural := 0;
    g_specular    : boolean;
    g_normalize   : boolean := false;
    g_kind        : natural;
    g_clocks      : positive
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of unrolled_latency_run is
  constant c_config : config_t := config(g_exact, 3, g_directional, g_positional, g_spots, true, g_specular, g_normalize,
    false);

  subtype token_t is std_logic_vector(token_bits(c_config) - 1 downto 0);

  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal in_valid  : std_logic := '0';
  signal in_ready  : std_logic;
  signal in_token  : token_t   := (others => '0');
  signal out_valid : std_logic;
  signal out_token : token_t;
  signal ended     : boolean   := false;
begin
  dut : entity work.unrolled_shading_processor
    generic map (
      g_exact       => g_exact,
      g_channels    => 3,
      g_directional => g_directional,
      g_positional  => g_positional,
      g_spots       => g_spots,
      g_diffuse     => true,
      g_specular    => g_specular,
      g_normalize   => g_normalize,
      g_shadows     => false,
      g_kind        => g_kind,
      g_light       => boolean'pos(g_kind /= c_ambient))
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => in_valid,
      in_ready  => in_ready,
      in_token  => in_token,
      out_valid => out_valid,
      out_ready => '1',
      out_token => out_token,
      busy      => open,
      fault     => open);

  clk <= not clk after c_half_period when not ended;

  run : process is
    constant c_command : slice_t := pixel_header(g_exact).command;

    variable clocks : natural := 0;
  begin
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset    <= '0';
    in_valid <= '1';
    in_token(c_command.high downto c_command.low) <= std_logic_vector(to_unsigned(c_new_pixel, 3));
    wait until rising_edge(clk) and in_ready = '1';
    in_valid <= '0';
    loop
      wait until rising_edge(clk);
      clocks := clocks + 1;
      exit when out_valid = '1' or clocks > g_clocks;
    end loop;
    assert clocks = g_clocks
      report "unrolled_shading_processor, kind " & to_string(g_kind) & ", lights " & to_string(g_directional)
      & to_string(g_positional) & to_string(g_spots) & ", " & preset_name(g_exact) & ": " & to_string(clocks)
      & " clocks, expected " & to_string(g_clocks)
      severity failure;
    ended    <= true;
    finished <= true;
    wait;
  end process;
end architecture;

use work.processors_pkg.all;

entity unrolled_shading_processor_tb is
  generic (
    g_folder : string := "unrolled_shading_processor"
  );
end entity;

architecture sim of unrolled_shading_processor_tb is
  constant c_runs : positive := 8; -- of a preset

  type clocks_t is array (0 to 1) of positive; -- published, exact

  signal finished : boolean;
  signal timed    : boolean_vector(0 to 2 * c_runs - 1);
begin
  presets : for preset in 0 to 1 generate
    constant c_exact : boolean := preset = 1;
    constant c_first : natural := c_runs * preset;

    -- With specular the ambient processor of preset exact has the view vector to make.
    constant c_alone : clocks_t := (2, 2);
    constant c_normalizing    : clocks_t := (6, 9);
    constant c_directional_diffuse       : clocks_t := (4, 4);
    constant c_directional_specular       : clocks_t := (5, 18);
    constant c_positional_diffuse       : clocks_t := (10, 14);
    constant c_positional_specular       : clocks_t := (11, 28);
    constant c_spot_diffuse       : clocks_t := (14, 18);
    constant c_spot_specular       : clocks_t := (14, 29);
    begin
      ambient : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_specular => false, g_kind => c_ambient, g_clocks => c_alone(preset))
        port map (timed(c_first));

      normalizing : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_specular => false, g_normalize => true, g_kind => c_ambient,
          g_clocks => c_normalizing(preset))
        port map (timed(c_first + 1));

      directional_diffuse : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_directional => 1, g_specular => true, g_kind => c_diffuse,
          g_clocks => c_directional_diffuse(preset))
        port map (timed(c_first + 2));

      directional_specular : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_directional => 1, g_specular => true, g_kind => c_specular,
          g_clocks => c_directional_specular(preset))
        port map (timed(c_first + 3));

      positional_diffuse : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_positional => 1, g_specular => true, g_kind => c_diffuse,
          g_clocks => c_positional_diffuse(preset))
        port map (timed(c_first + 4));

      positional_specular : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_positional => 1, g_specular => true, g_kind => c_specular,
          g_clocks => c_positional_specular(preset))
        port map (timed(c_first + 5));

      spot_diffuse : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_spots => 1, g_specular => true, g_kind => c_diffuse,
          g_clocks => c_spot_diffuse(preset))
        port map (timed(c_first + 6));

      spot_specular : entity work.unrolled_latency_run
        generic map (g_exact => c_exact, g_spots => 1, g_specular => true, g_kind => c_specular,
          g_clocks => c_spot_specular(preset))
        port map (timed(c_first + 7));
  end generate;

  checker : entity work.processors_checker
    generic map (true, g_folder)
    port map (finished);

  done : process is
  begin
    wait until finished and (and timed);
    report "unrolled_shading_processor_tb: passed" severity note;
    wait;
  end process;
end architecture;
