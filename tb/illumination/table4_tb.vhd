-- SPDX-License-Identifier: Apache-2.0
-- The clocks of the folded shading processor, from one token taken to the next one taken while nothing behind it waits:
-- in preset published those of the processors paper's table 4, and what preset exact takes; what the paper does not
-- have besides.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity table4_run is
  generic (
    g_name       : string;
    g_exact      : boolean;
    g_positional : natural range 0 to 1;
    g_spots      : natural range 0 to 1;
    g_hardware   : boolean; -- the ambient processor can normalize N, and counts shadows
    g_specular   : boolean;
    g_kind       : natural;
    g_command    : natural;
    g_normalize  : std_logic; -- of objects
    g_light      : std_logic; -- lit: the light is valid
    g_clocks     : positive
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of table4_run is
  constant c_directional : natural  := 1 - g_positional - g_spots;
  constant c_config      : config_t := config(g_exact, 3, c_directional, g_positional, g_spots, true, g_specular,
    g_hardware, g_hardware);
  constant c_header : pixel_header_t      := pixel_header(g_exact);
  constant c_axes_header : light_axes_header_t  := light_axes_header(g_exact);
  constant c_axis   : light_axes_channel_t := light_axes_channel(g_exact);
  -- Of light 1, but for the ambient processor.
  constant c_light : natural := boolean'pos(g_kind /= c_ambient);

  subtype token_t is std_logic_vector(token_bits(c_config) - 1 downto 0);

  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal in_valid  : std_logic := '0';
  signal in_ready  : std_logic;
  signal in_token  : token_t   := (others => '0');
  signal out_valid : std_logic;
  signal out_token : token_t;
  signal busy      : std_logic;
  signal fault     : std_logic;
  signal ended     : boolean   := false;

  procedure set (variable token : inout token_t; low, bits, value : in natural) is
  begin
    token(low + bits - 1 downto low) := std_logic_vector(to_unsigned(value, bits));
  end procedure;

  -- The light stands, or lies, where the normals point to.
  function definition return token_t is
    variable token : token_t := (others => '0');
    variable low   : natural;
  begin
    set(token, c_header.command.low, 3, c_define);
    set(token, c_header.light.low, 5, c_light);
    low := light_axes_low(c_config);
    set(token, low + c_axes_header.positional.low, 1, g_positional + g_spots);
    set(token, low + c_axes_header.spot.low, 1, g_spots);
    low := low + light_axes_channel_low(g_exact, 0);
    set(token, low + c_axis.place.low, formats(g_exact).light_place.bits, 2 ** formats(g_exact).light_place.fraction);
    if not g_exact then
      set(token, low + c_axis.half.low, formats(g_exact).direction.bits, 2 ** formats(g_exact).direction.fraction);
    end if;
    return token;
  end function;

  function measured return token_t is
    variable token : token_t := (others => '0');
    variable low   : natural;
  begin
    if g_command = c_define then
      return definition;
    end if;
    set(token, c_header.command.low, 3, g_command);
    set(token, c_header.light.low, 5, c_light);
    token(c_header.normalize.low) := g_normalize;
    token(c_header.opens.low)     := '1';
    low := normal_low(c_config, 0);
    set(token, low, formats(g_exact).vector.bits, 2 ** formats(g_exact).direction.fraction);
    if has_distance(c_config) then
      set(token, distance_low(c_config), formats(g_exact).vector.bits, 2 ** formats(g_exact).vector.fraction);
    end if;
    return token;
  end function;
begin
  dut : entity work.shading_processor
    generic map (
      g_exact       => g_exact,
      g_channels    => 3,
      g_directional => c_directional,
      g_positional  => g_positional,
      g_spots       => g_spots,
      g_diffuse     => true,
      g_specular    => g_specular,
      g_normalize   => g_hardware,
      g_shadows     => g_hardware,
      g_kind        => g_kind,
      g_light       => c_light)
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => in_valid,
      in_ready  => in_ready,
      in_token  => in_token,
      out_valid => out_valid,
      out_ready => '1',
      out_token => out_token,
      busy      => busy,
      fault     => fault);

  clk <= not clk after c_half_period when not ended;

  run : process is
    variable clocks : natural;
  begin
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset    <= '0';
    in_valid <= g_light;
    in_token <= definition;
    if g_light = '1' then
      wait until rising_edge(clk) and in_ready = '1';
    end if;
    in_valid <= '1';
    in_token <= measured;
    wait until rising_edge(clk) and in_ready = '1';
    for i in 1 to 5 loop
      clocks := 0;
      loop
        wait until rising_edge(clk);
        clocks := clocks + 1;
        exit when in_ready = '1';
      end loop;
      assert clocks = g_clocks
        report "table 4, " & g_name & ", " & preset_name(g_exact) & ": " & to_string(clocks) & " clocks, expected "
        & to_string(g_clocks) severity failure;
    end loop;
    report "table 4, " & g_name & ", " & preset_name(g_exact) & ": " & to_string(clocks) severity note;
    assert fault = '0' report g_name & ": fault" severity failure;
    ended    <= true;
    finished <= true;
    wait;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;

entity table4_tb is
  generic (
    g_folder : string := "table4" -- no vectors
  );
end entity;

architecture sim of table4_tb is
  signal finished : boolean_vector(0 to 25);

  function clocks (exact : boolean; in_published, in_exact : positive) return positive is
  begin
    if exact then
      return in_exact;
    end if;
    return in_published;
  end function;
begin
  presets : for preset in 0 to 1 generate
    constant c_exact : boolean := preset = 1;
    constant c_first : natural := 13 * preset;
    begin
      ambient_1 : entity work.table4_run
        generic map ("ambient, version I", c_exact, 0, 0, false, false, c_ambient, c_new_pixel, '0', '1', 4)
        port map (finished(c_first));

      ambient_2 : entity work.table4_run
        generic map ("ambient, version II", c_exact, 0, 0, true, false, c_ambient, c_new_object, '0', '1', 4)
        port map (finished(c_first + 1));

      normalizing : entity work.table4_run
        generic map ("ambient and normalization", c_exact, 0, 0, true, false, c_ambient, c_new_pixel, '1', '1',
          clocks(c_exact, 6, 9))
        port map (finished(c_first + 2));

      viewing : entity work.table4_run
        generic map ("ambient, normalization and view vector", c_exact, 0, 0, true, true, c_ambient, c_new_scanline, '1',
          '1', clocks(c_exact, 6, 15))
        port map (finished(c_first + 3));

      directional_diffuse : entity work.table4_run
        generic map ("directional diffuse", c_exact, 0, 0, false, true, c_diffuse, c_new_pixel, '0', '1', 6)
        port map (finished(c_first + 4));

      directional_specular : entity work.table4_run
        generic map ("directional specular", c_exact, 0, 0, false, true, c_specular, c_new_pixel, '0', '1',
          clocks(c_exact, 7, 20))
        port map (finished(c_first + 5));

      positional_diffuse : entity work.table4_run
        generic map ("positional diffuse", c_exact, 1, 0, true, true, c_diffuse, c_new_pixel, '0', '1',
          clocks(c_exact, 12, 16))
        port map (finished(c_first + 6));

      positional_specular : entity work.table4_run
        generic map ("positional specular", c_exact, 1, 0, true, true, c_specular, c_new_pixel, '0', '1',
          clocks(c_exact, 13, 30))
        port map (finished(c_first + 7));

      shadow_polygon : entity work.table4_run
        generic map ("shadow polygon", c_exact, 1, 0, true, true, c_specular, c_shadow, '0', '1', 2)
        port map (finished(c_first + 8));

      loading : entity work.table4_run
        generic map ("define", c_exact, 1, 0, true, true, c_specular, c_define, '0', '1', 2)
        port map (finished(c_first + 9));

      no_light : entity work.table4_run
        generic map ("object, no light", c_exact, 1, 0, true, true, c_specular, c_new_pixel, '0', '0', 2)
        port map (finished(c_first + 10));

      spot_diffuse : entity work.table4_run
        generic map ("spot diffuse", c_exact, 0, 1, true, true, c_diffuse, c_new_pixel, '0', '1',
          clocks(c_exact, 18, 22))
        port map (finished(c_first + 11));

      spot_specular : entity work.table4_run
        generic map ("spot specular", c_exact, 0, 1, true, true, c_specular, c_new_pixel, '0', '1',
          clocks(c_exact, 24, 32))
        port map (finished(c_first + 12));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "table4_tb: passed" severity note;
    wait;
  end process;
end architecture;
