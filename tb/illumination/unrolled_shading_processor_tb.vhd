-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of six pipelines against the golden model (processors_checker). Also checks the
-- latency in clocks from an accepted token to the same token at the output, as the entity's header promises.
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
  type clocks_t is array (0 to 1) of positive; -- published, exact

  type promise_t is record
    directional, positional, spots : natural;
    specular, normalize            : boolean;
    kind                           : natural;
    clocks                         : clocks_t;
  end record;

  type promises_t is array (natural range <>) of promise_t;

  -- With specular, the ambient processor of preset exact computes the view vector.
  constant c_promises : promises_t := (
    (0, 0, 0, false, false, c_ambient, (2, 2)),
    (0, 0, 0, false, true, c_ambient, (6, 9)),
    (1, 0, 0, true, false, c_diffuse, (4, 4)),
    (1, 0, 0, true, false, c_specular, (5, 18)),
    (0, 1, 0, true, false, c_diffuse, (10, 14)),
    (0, 1, 0, true, false, c_specular, (11, 28)),
    (0, 0, 1, true, false, c_diffuse, (14, 18)),
    (0, 0, 1, true, false, c_specular, (14, 29)));

  signal finished : boolean;
  signal timed    : boolean_vector(0 to 2 * c_promises'length - 1);
begin
  presets : for preset in 0 to 1 generate
    promises : for i in c_promises'range generate
      latency : entity work.unrolled_latency_run
        generic map (
          g_exact       => preset = 1,
          g_directional => c_promises(i).directional,
          g_positional  => c_promises(i).positional,
          g_spots       => c_promises(i).spots,
          g_specular    => c_promises(i).specular,
          g_normalize   => c_promises(i).normalize,
          g_kind        => c_promises(i).kind,
          g_clocks      => c_promises(i).clocks(preset)
          )
        port map (
          finished => timed(preset * c_promises'length + i)
          );
    end generate;
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
