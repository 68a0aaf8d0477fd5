-- SPDX-License-Identifier: Apache-2.0
-- Measures the clocks of the folded shading processor from one accepted token to the next while the output never
-- stalls. They must be those of model/plan/processor_clocks.hpp, row by row, and each row must be measured.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity table4_tb is
  generic (g_folder : string := "table4");
end entity;

architecture sim of table4_tb is
  type run_t is record
    positional, spots : natural range 0 to 1;
    hardware          : boolean; -- the ambient processor can normalize N, and counts shadows
    specular          : boolean;
    kind, command     : natural;
    normalize         : std_logic; -- of the objects
    light             : std_logic; -- the light is lit: it is defined and valid
  end record;

  type runs_t is array (natural range <>) of run_t;

  constant c_runs : runs_t := (
    (0, 0, false, false, c_ambient, c_new_object, '0', '1'),
    (0, 0, true, false, c_ambient, c_new_object, '0', '1'),
    (0, 0, true, false, c_ambient, c_new_object, '1', '1'),
    (0, 0, true, true, c_ambient, c_new_object, '1', '1'),
    (0, 0, true, true, c_ambient, c_new_object, '0', '1'),
    (0, 0, false, true, c_ambient, c_new_object, '0', '1'),
    (0, 0, false, true, c_diffuse, c_new_object, '0', '1'),
    (0, 0, false, true, c_specular, c_new_object, '0', '1'),
    (1, 0, true, true, c_diffuse, c_new_object, '0', '1'),
    (1, 0, true, true, c_specular, c_new_object, '0', '1'),
    (0, 1, true, true, c_diffuse, c_new_object, '0', '1'),
    (0, 1, true, true, c_specular, c_new_object, '0', '1'),
    (1, 0, true, true, c_specular, c_shadow, '0', '1'),
    (1, 0, true, true, c_specular, c_new_pixel, '0', '1'),
    (1, 0, true, true, c_specular, c_define, '0', '1'),
    (1, 0, true, true, c_specular, c_new_object, '0', '0'));

  constant c_names : string := "ambient, version I;ambient, version II;ambient and normalization;"
    & "ambient, normalization and view vector;ambient and view vector, version II;ambient and view vector, version I;"
    & "directional diffuse;directional specular;positional diffuse;positional specular;spot diffuse;spot specular;"
    & "shadow polygon;head;define;object, no light";

  type rows_t is array (boolean) of integer_vector(c_runs'range);

  signal rows : rows_t := (others => (others => -1)); -- of the table, that the runs measured
begin
  presets : for exact in boolean generate
    runs : for i in c_runs'range generate
      constant c_run         : run_t                := c_runs(i);
      constant c_name        : string               := nth_word(c_names, i, ';') & ", " & preset_name(exact);
      constant c_directional : natural              := 1 - c_run.positional - c_run.spots;
      constant c_config      : config_t             := config(exact, 3, c_directional, c_run.positional, c_run.spots, true,
        c_run.specular, c_run.hardware, c_run.hardware);
      constant c_header      : pixel_header_t       := pixel_header(exact);
      constant c_axes_header : light_axes_header_t  := light_axes_header(exact);
      constant c_axis        : light_axes_channel_t := light_axes_channel(exact);
      constant c_formats     : formats_t            := formats(exact);

      -- Light 1; light 0 for the ambient processor.
      constant c_light  : natural := boolean'pos(c_run.kind /= c_ambient);
      constant c_object : boolean := c_run.light = '1' and c_run.command = c_new_object;
      constant c_first  : boolean := c_object and c_run.kind = c_ambient;

      -- The kind of work. Without work: a number that no kind has.
      function work_kind return natural is
      begin
        if not c_object then
          return c_specular + 1;
        end if;
        return c_run.kind;
      end function;

      -- The row's key: preset, kind of processor, positional, spot, N normalized, view vector.
      constant c_work : std_logic_vector(6 downto 0) := to_flag(exact) & std_logic_vector(to_unsigned(work_kind, 2)) &
        to_flag(c_object and c_run.positional > 0) & to_flag(c_object and c_run.spots > 0) &
        to_flag(c_first and c_run.normalize = '1') & to_flag(c_first and has_view(c_config));

      subtype token_t is std_logic_vector(token_bits(c_config) - 1 downto 0);

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
        set(token, low + c_axes_header.positional.low, 1, c_run.positional + c_run.spots);
        set(token, low + c_axes_header.spot.low, 1, c_run.spots);
        low := low + light_axes_bits(exact, 0);
        set(token, low + c_axis.place.low, c_formats.light_place.bits, 2 ** c_formats.light_place.fraction);
        if not exact then
          set(token, low + c_axis.half.low, c_formats.direction.bits, 2 ** c_formats.direction.fraction);
        end if;
        return token;
      end function;

      function measured return token_t is
        variable token : token_t := (others => '0');
      begin
        if c_run.command = c_define then
          return definition;
        end if;
        set(token, c_header.command.low, 3, c_run.command);
        set(token, c_header.light.low, 5, c_light);
        token(c_header.normalize.low) := c_run.normalize;
        token(c_header.opens.low)     := '1';
        set(token, normal_low(c_config, 0), c_formats.vector.bits, 2 ** c_formats.direction.fraction);
        if has_distance(c_config) then
          set(token, distance_low(c_config), c_formats.vector.bits, 2 ** c_formats.vector.fraction);
        end if;
        return token;
      end function;

      signal clk         : std_logic := '0';
      signal reset       : std_logic := '1';
      signal in_valid    : std_logic := '0';
      signal in_ready    : std_logic;
      signal in_token    : token_t := (others => '0');
      signal out_valid   : std_logic;
      signal out_token   : token_t;
      signal busy        : std_logic;
    begin
      dut : entity work.shading_processor
        generic map (
          g_exact       => exact,
          g_channels    => 3,
          g_directional => c_directional,
          g_positional  => c_run.positional,
          g_spots       => c_run.spots,
          g_diffuse     => true,
          g_specular    => c_run.specular,
          g_normalize   => c_run.hardware,
          g_shadows     => c_run.hardware,
          g_kind        => c_run.kind,
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
          busy      => busy);

      run : process is
        variable table  : vectors_t;
        variable key    : std_logic_vector(c_work'range);
        variable number : natural := 0;
        variable clocks : natural;
        variable wanted : natural;

        -- Count the clocks until a token is taken.
        procedure offer (token : token_t) is
        begin
          in_valid <= '1';
          in_token <= token;
          clocks   := 0;
          loop
            settle;
            clocks := clocks + 1;
            exit when in_ready = '1';
            tick(clk);
          end loop;
          tick(clk);
        end procedure;
      begin
        -- Find the row of this work.
        table.open_file(g_folder & "/table4.txt");
        loop
          table.expect_vector("work that is in no row, " & c_name);
          table.read_word(key);
          exit when key = c_work;
          number := number + 1;
        end loop;
        wanted := table.read_number;
        table.close_file;

        for clock in 1 to 3 loop
          settle;
          tick(clk);
        end loop;
        reset <= '0';
        if c_run.light = '1' then
          offer(definition);
        end if;
        offer(measured);
        for token in 1 to 5 loop
          offer(measured);
          check("table 4, " & c_name & ", token", token, "number of clocks", clocks, wanted);
        end loop;
        report "table 4, " & c_name & ": " & to_string(clocks) severity note;
        rows(exact)(i) <= number;
        finish(finished);
      end process;
    end generate;
  end generate;

  -- Every row must have been measured by one of the runs.
  check_rows : process is
    variable table    : vectors_t;
    variable number   : natural := 0;
    variable measured : boolean;
  begin
    wait until minimum(rows(false) & rows(true)) >= 0;
    table.open_file(g_folder & "/table4.txt");
    while table.next_vector loop
      measured := false;
      for exact in boolean loop
        for i in c_runs'range loop
          measured := measured or rows(exact)(i) = number;
        end loop;
      end loop;
      assert measured report "table 4: no run measures row " & to_string(number) severity failure;
      number := number + 1;
    end loop;
    finish(finished);
  end process;

  report_end(finished, "table4_tb");
end architecture;
