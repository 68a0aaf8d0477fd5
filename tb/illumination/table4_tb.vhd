-- SPDX-License-Identifier: Apache-2.0
-- Measures the clocks of the folded shading processor from one accepted token to the next while the output never
-- stalls. They must be those of model/plan/processor_clocks.hpp, row by row.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity table4_run is
  generic (
    g_folder     : string;
    g_name       : string;
    g_exact      : boolean;
    g_positional : natural range 0 to 1;
    g_spots      : natural range 0 to 1;
    g_hardware   : boolean; -- the ambient processor can normalize N, and counts shadows
    g_specular   : boolean;
    g_kind       : natural;
    g_command    : natural;
    g_normalize  : std_logic; -- of the objects
    g_light      : std_logic -- the light is lit: it is defined and valid
  );
  port (
    finished : out boolean := false;
    row      : out natural := 0 -- row of the table, valid once finished
  );
end entity;

architecture sim of table4_run is
  constant c_directional : natural  := 1 - g_positional - g_spots;
  constant c_config      : config_t := config(g_exact, 3, c_directional, g_positional, g_spots, true, g_specular,
    g_hardware, g_hardware);
  constant c_header : pixel_header_t      := pixel_header(g_exact);
  constant c_axes_header : light_axes_header_t  := light_axes_header(g_exact);
  constant c_axis   : light_axes_channel_t := light_axes_channel(g_exact);
  -- Light 1; light 0 for the ambient processor.
  constant c_light : natural := boolean'pos(g_kind /= c_ambient);

  -- The kind of work. Without work: a number that no kind has.
  function work_kind return natural is
  begin
    if g_light = '0' or g_command = c_shadow or g_command = c_define then
      return c_specular + 1;
    end if;
    return g_kind;
  end function;

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

  constant c_object : boolean := g_light = '1' and g_command /= c_shadow and g_command /= c_define;
  constant c_first  : boolean := c_object and g_kind = c_ambient;

  -- The row's key: preset, kind of processor, positional, spot, N normalized, view vector.
  constant c_work : std_logic_vector(6 downto 0) := to_flag(g_exact) & std_logic_vector(to_unsigned(work_kind, 2)) &
    to_flag(c_object and g_positional > 0) & to_flag(c_object and g_spots > 0) &
    to_flag(c_first and g_normalize = '1') & to_flag(c_first and has_view(c_config));

  procedure set (variable token : inout token_t; low, bits, value : in natural) is
  begin
    token(low + bits - 1 downto low) := std_logic_vector(to_unsigned(value, bits));
  end procedure;

  -- Define a light whose position, or direction, lies in the direction of the normals.
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
    variable rows_file : vectors_t;
    variable row_of : std_logic_vector(c_work'range);
    variable number : natural := 0;
    variable clocks : natural;
    variable wanted : natural;
  begin
    -- Find the row of this work.
    rows_file.open_file(g_folder & "/table4.txt");
    loop
      rows_file.expect_vector("work that is in no row, " & g_name);
      rows_file.read_word(row_of);
      exit when row_of = c_work;
      number := number + 1;
    end loop;
    wanted := rows_file.read_number;
    rows_file.close_file;

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
      assert clocks = wanted
        report "table 4, " & g_name & ", " & preset_name(g_exact) & ": " & to_string(clocks) & " clocks, expected "
        & to_string(wanted) severity failure;
    end loop;
    report "table 4, " & g_name & ", " & preset_name(g_exact) & ": " & to_string(clocks) severity note;
    assert fault = '0' report g_name & ": fault" severity failure;
    ended    <= true;
    row      <= number;
    finished <= true;
    wait;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity table4_tb is
  generic (
    g_folder : string
  );
end entity;

architecture sim of table4_tb is
  constant c_runs : positive := 15; -- per preset

  signal finished : boolean_vector(0 to 2 * c_runs - 1);
  signal rows     : integer_vector(0 to 2 * c_runs - 1);

begin
  presets : for preset in 0 to 1 generate
    constant c_exact : boolean := preset = 1;
    constant c_first : natural := c_runs * preset;
    begin
      ambient_1 : entity work.table4_run
        generic map (g_folder, "ambient, version I", c_exact, 0, 0, false, false, c_ambient, c_new_pixel, '0', '1')
        port map (finished(c_first), rows(c_first));

      ambient_2 : entity work.table4_run
        generic map (g_folder, "ambient, version II", c_exact, 0, 0, true, false, c_ambient, c_new_object, '0', '1')
        port map (finished(c_first + 1), rows(c_first + 1));

      normalizing : entity work.table4_run
        generic map (g_folder, "ambient and normalization", c_exact, 0, 0, true, false, c_ambient, c_new_pixel, '1', '1')
        port map (finished(c_first + 2), rows(c_first + 2));

      viewing : entity work.table4_run
        generic map (g_folder, "ambient, normalization and view vector", c_exact, 0, 0, true, true, c_ambient, c_new_scanline, '1',
          '1')
        port map (finished(c_first + 3), rows(c_first + 3));

      directional_diffuse : entity work.table4_run
        generic map (g_folder, "directional diffuse", c_exact, 0, 0, false, true, c_diffuse, c_new_pixel, '0', '1')
        port map (finished(c_first + 4), rows(c_first + 4));

      directional_specular : entity work.table4_run
        generic map (g_folder, "directional specular", c_exact, 0, 0, false, true, c_specular, c_new_pixel, '0', '1')
        port map (finished(c_first + 5), rows(c_first + 5));

      positional_diffuse : entity work.table4_run
        generic map (g_folder, "positional diffuse", c_exact, 1, 0, true, true, c_diffuse, c_new_pixel, '0', '1')
        port map (finished(c_first + 6), rows(c_first + 6));

      positional_specular : entity work.table4_run
        generic map (g_folder, "positional specular", c_exact, 1, 0, true, true, c_specular, c_new_pixel, '0', '1')
        port map (finished(c_first + 7), rows(c_first + 7));

      shadow_polygon : entity work.table4_run
        generic map (g_folder, "shadow polygon", c_exact, 1, 0, true, true, c_specular, c_shadow, '0', '1')
        port map (finished(c_first + 8), rows(c_first + 8));

      loading : entity work.table4_run
        generic map (g_folder, "define", c_exact, 1, 0, true, true, c_specular, c_define, '0', '1')
        port map (finished(c_first + 9), rows(c_first + 9));

      no_light : entity work.table4_run
        generic map (g_folder, "object, no light", c_exact, 1, 0, true, true, c_specular, c_new_pixel, '0', '0')
        port map (finished(c_first + 10), rows(c_first + 10));

      spot_diffuse : entity work.table4_run
        generic map (g_folder, "spot diffuse", c_exact, 0, 1, true, true, c_diffuse, c_new_pixel, '0', '1')
        port map (finished(c_first + 11), rows(c_first + 11));

      spot_specular : entity work.table4_run
        generic map (g_folder, "spot specular", c_exact, 0, 1, true, true, c_specular, c_new_pixel, '0', '1')
        port map (finished(c_first + 12), rows(c_first + 12));

      viewing_only : entity work.table4_run
        generic map (g_folder, "ambient and view vector, version II", c_exact, 0, 0, true, true, c_ambient, c_new_pixel, '0', '1')
        port map (finished(c_first + 13), rows(c_first + 13));

      viewing_without : entity work.table4_run
        generic map (g_folder, "ambient and view vector, version I", c_exact, 0, 0, false, true, c_ambient, c_new_pixel,
          '0', '1')
        port map (finished(c_first + 14), rows(c_first + 14));
  end generate;

  done : process is
    variable rows_file : vectors_t;
    variable number : natural := 0;
    variable measured : boolean;
  begin
    wait until and finished;
    -- Every row must have been measured by one of the runs.
    rows_file.open_file(g_folder & "/table4.txt");
    while rows_file.next_vector loop
      measured := false;
      for i in rows'range loop
        measured := measured or rows(i) = number;
      end loop;
      assert measured report "table 4: no run measures row " & to_string(number) severity failure;
      number := number + 1;
    end loop;
    rows_file.close_file;
    report "table4_tb: passed" severity note;
    wait;
  end process;
end architecture;
