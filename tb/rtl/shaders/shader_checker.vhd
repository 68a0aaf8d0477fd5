-- SPDX-License-Identifier: Apache-2.0
-- Drives a shader and compares every fragment with the golden model, in order, on two sets: triangles without empty
-- lines ("dense"), and a mix with empty lines and random words ("mixed"). At full speed every init vector must be
-- accepted, and every fragment output, in the clock that the entity's header promises. Other passes have random stalls
-- on both sides, or a reset in the middle.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.tb_pkg.all;
use work.shader_pkg.all;
use work.tb_shaders_pkg.all;

entity shader_checker is
  generic (
    g_hardware : hardware_t;
    g_timed    : boolean  := true;  -- the files contain the clocks
    g_latency  : positive := 1;     -- if timed: clocks from the first init vector of a dense set to its first fragment
    g_gapless  : boolean;           -- no clock is lost if no line is empty, except after a single pixel
    g_one_side : boolean  := true;  -- also passes in which only one side stalls
    g_resets   : natural  := 10;    -- number of passes that end with a reset
    g_faults   : boolean  := false; -- a set "fault" exists: fault must be '1' at its end
    g_stem     : string             -- start of the file names
  );
end entity;

architecture sim of shader_checker is
  constant c_formats    : formats_t := formats(g_hardware.exact);
  constant c_idle_limit : positive  := 10_000; -- clocks without a transfer that count as a hang

  subtype colour_t is std_logic_vector(c_formats.colour.bits - 1 downto 0);

  signal running                      : boolean   := false;
  signal clk                          : std_logic := '0';
  signal reset                        : std_logic := '1';
  signal init_valid                   : std_logic := '0';
  signal init_ready                   : std_logic;
  signal init_data                    : std_logic_vector(init_bits(g_hardware) - 1 downto 0) := (others => '0');
  signal fragment_valid               : std_logic;
  signal fragment_ready               : std_logic := '0';
  signal fragment_triangle            : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal fragment_y                   : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal fragment_x                   : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
  signal fragment_z                   : std_logic_vector(c_formats.depth.bits - 1 downto 0);
  signal fragment_red, fragment_green : colour_t;
  signal fragment_blue                : colour_t;
  signal busy, fault                  : std_logic;
  signal payload                      : std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length
    + fragment_z'length + 3 * colour_t'length - 1 downto 0);
begin
  quadratic_dut : if g_hardware.shader = quadratic generate
    dut : entity work.quadratic_shader
      generic map (g_exact => g_hardware.exact, g_channels => g_hardware.channels, g_degree => g_hardware.degree)
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
  end generate;

  spherical_dut : if g_hardware.shader = spherical generate
    dut : entity work.spherical_shader
      generic map (
        g_exact              => g_hardware.exact,
        g_channels           => g_hardware.channels,
        g_lights             => g_hardware.lights,
        g_diffuse            => g_hardware.diffuse,
        g_specular           => g_hardware.specular,
        g_highlight_channels => g_hardware.highlight_channels,
        g_powers             => g_hardware.powers,
        g_cosine             => g_hardware.cosine)
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
  end generate;

  processors_dut : if g_hardware.shader = processors generate
    dut : entity work.processors_shader
      generic map (
        g_exact       => g_hardware.exact,
        g_channels    => g_hardware.channels,
        g_directional => g_hardware.directional,
        g_positional  => g_hardware.positional,
        g_spots       => g_hardware.spots,
        g_diffuse     => g_hardware.diffuse,
        g_specular    => g_hardware.specular,
        g_normalize   => g_hardware.normalize,
        g_shadows     => g_hardware.shadows,
        g_unrolled    => g_hardware.unrolled,
        g_objects     => g_hardware.objects,
        g_subpixels   => g_hardware.subpixels)
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
  end generate;

  payload <= fragment_triangle & fragment_y & fragment_x & fragment_z & fragment_red & fragment_green & fragment_blue;

  clk <= not clk after c_half_period when running;

  run : process is
    variable inits, fragments : vectors_t;

    procedure check_flag (name : string; got, expected : std_logic; clock : integer) is
    begin
      check(g_stem & ": clock", clock, name, got, expected);
    end procedure;

    -- One pass over a set. With stalls, init is offered in one of 2**init_pause clocks, and fragment_ready is '1' in
    -- one of 2**fragment_pause. The pass ends with a reset in clock reset_at; 0: no reset.
    procedure pass (set : string; seed, init_pause, fragment_pause, reset_at : natural) is
      constant c_full : boolean := init_pause = 0 and fragment_pause = 0;

      variable random     : unsigned(31 downto 0) := to_unsigned(seed, 32);
      variable init_now   : std_logic_vector(init_data'range);
      variable held       : std_logic_vector(payload'range);
      variable to_come    : boolean;          -- an init vector is not yet accepted
      variable offered    : boolean := false;
      variable waiting    : boolean := false; -- the fragment of the last clock was not accepted
      variable just_taken : boolean := false; -- an init vector was accepted in the last clock
      variable clock      : integer := -1;    -- 0: the first init vector is accepted
      variable ticks      : natural := 0;
      variable idle       : natural := 0;
      variable taken      : natural := 0;
      variable given      : natural := 0;
      variable init_clock : natural;
      variable before     : natural := 0;         -- clock of the previous fragment
      variable pixels     : natural := 0;         -- of the previous fragment's triangle
      variable last       : std_logic_vector(fragment_triangle'range);
      variable last_y     : unsigned(fragment_y'range);
    begin
      inits.open_file(g_stem & set & "_init.txt");
      fragments.open_file(g_stem & set & "_fragments.txt");
      to_come := inits.next_vector;
      inits.read_word(init_now);
      init_clock := inits.read_number;

      loop
        random  := next_random(random);
        offered := to_come and (offered or chance(random(19 downto 12), init_pause));
        init_valid <= to_flag(offered);
        if offered then
          init_data <= init_now;
        else
          init_data <= (others => '1');
        end if;
        fragment_ready <= to_flag(chance(random(30 downto 23), fragment_pause));
        ticks := ticks + 1;
        reset <= to_flag(ticks = reset_at);
        wait until rising_edge(clk);
        exit when ticks = reset_at;
        if clock >= 0 or (init_valid = '1' and init_ready = '1') then
          clock := clock + 1;
        end if;
        idle := idle + 1;

        if set /= "fault" then
          check_flag("fault", fault, '0', clock);
        end if;
        if just_taken then
          check_flag("busy with a vector just taken", busy, '1', clock);
        end if;
        if waiting then
          check_flag("fragment_valid of a fragment not taken", fragment_valid, '1', clock);
        end if;
        if fragment_valid = '1' then
          check_flag("busy with a fragment to give", busy, '1', clock);
          if not waiting then
            fragments.expect_vector("fragment " & to_string(given));
            given := given + 1;
            fragments.check("triangle", fragment_triangle);
            fragments.check("y", fragment_y);
            fragments.check("x", fragment_x);
            fragments.check("z", fragment_z);
            fragments.check("red", fragment_red);
            fragments.check("green", fragment_green);
            fragments.check("blue", fragment_blue);
            if c_full then
              if g_timed then
                fragments.check("clock", std_logic_vector(to_unsigned(clock, 32)));
              end if;
              if set = "dense" and given = 1 and g_timed and clock /= g_latency then
                fragments.fail("comes in clock " & to_string(clock) & ", expected " & to_string(g_latency));
              end if;
              -- Detect a new triangle by its number, or by a line that does not continue the previous one: consecutive
              -- triangles may have the same number.
              if given = 1 or fragment_triangle /= last or unsigned(fragment_y) - last_y > 1 then
                if set = "dense" and given > 1 and g_gapless and clock > before + maximum(1, 3 - pixels) then
                  fragments.fail("of another triangle comes " & to_string(clock - before) & " clocks after the one before");
                end if;
                pixels := 0;
              elsif set = "dense" and g_gapless and clock /= before + 1 then
                fragments.fail("comes " & to_string(clock - before) & " clocks after the one before");
              end if;
              last   := fragment_triangle;
              last_y := unsigned(fragment_y);
              before := clock;
              pixels := pixels + 1;
            end if;
          else
            assert payload = held
              report g_stem & ": fragment " & to_string(given - 1) & " changes while it waits, from " & to_hstring(held)
              & " to " & to_hstring(payload)
              severity failure;
          end if;
          held := payload;
          idle := 0;
        end if;
        waiting := fragment_valid = '1' and fragment_ready = '0';

        just_taken := init_valid = '1' and init_ready = '1';
        if just_taken then
          if c_full and g_timed and clock /= init_clock then
            inits.fail("is taken in clock " & to_string(clock) & ", expected " & to_string(init_clock));
          end if;
          offered := false;
          taken   := taken + 1;
          to_come := inits.next_vector;
          if to_come then
            inits.read_word(init_now);
            init_clock := inits.read_number;
          end if;
          idle := 0;
        elsif not to_come then
          exit when busy = '0' and fragment_valid = '0';
        end if;

        assert idle < c_idle_limit
          report g_stem & set & ": nothing moved for " & to_string(c_idle_limit) & " clocks after "
          & to_string(taken) & " init vectors and " & to_string(given) & " fragments"
          severity failure;
      end loop;

      if ticks /= reset_at and fragments.next_vector then
        fragments.fail("this fragment was not given out");
      end if;
      inits.close_file;
      fragments.close_file;

      if set = "fault" then
        for i in 1 to 8 loop
          wait until rising_edge(clk);
        end loop;
        check_flag("fault", fault, '1', clock);
        reset <= '1';
        wait until rising_edge(clk);
      end if;

      -- Check that the shader is idle, both after a reset and after the last triangle.
      init_valid     <= '0';
      reset          <= '0';
      fragment_ready <= '1';
      for i in 1 to 3 loop
        wait until rising_edge(clk);
        check_flag("init_ready when idle", init_ready, '1', clock);
        check_flag("fragment_valid when idle", fragment_valid, '0', clock);
        check_flag("busy when idle", busy, '0', clock);
        check_flag("fault when idle", fault, '0', clock);
      end loop;
    end procedure;

    constant c_resets : integer_vector := (2, 3, 4, 5, 6, 7, 8, 9, 23, 311);
  begin
    take_turn;
    running <= true;
    wait_clocks(clk, 2);
    pass("dense", 1, 0, 0, 0);
    pass("mixed", 1, 0, 0, 0);
    pass("mixed", 12, 1, 1, 0);
    if g_one_side then
      pass("mixed", 13, 4, 0, 0);
      pass("dense", 14, 0, 1, 0);
    end if;
    for i in 0 to g_resets - 1 loop
      pass("mixed", 20 + i, 0, i mod 2, c_resets(i));
    end loop;
    if g_faults then
      pass("fault", 1, 0, 0, 0);
    end if;
    pass("mixed", 1, 0, 0, 0);
    running <= false;
    end_turn(finished);
  end process;
end architecture;
