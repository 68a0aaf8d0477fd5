-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one and three channels, on triangles without an empty line, and on a mix with empty lines and garbage:
-- every fragment, and every event of the probe, against the golden twin, in order. At full speed every init vector is
-- taken and every fragment given out in the very clock that the entity's header promises; without empty lines that is
-- a fragment a clock from the first to the last. Then with both sides stalling at random, and with resets in the
-- middle.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity quadratic_shader_run is
  generic (
    g_exact    : boolean;
    g_channels : positive;
    g_probe    : boolean;
    g_stem     : string -- of the files' names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of quadratic_shader_run is
  constant c_latency    : positive := 4;      -- clocks from init taken to the first fragment
  constant c_idle_limit : positive := 10_000; -- clocks in which nothing moves: a hang

  constant c_probe_bits : positive        := probe_bits(g_exact, g_channels);
  constant c_header     : probe_header_t  := probe_header(g_exact);
  constant c_channel    : probe_channel_t := probe_channel(g_exact);

  subtype probe_t is std_logic_vector(c_probe_bits - 1 downto 0);

  -- The probe's fields that belong to the line stage, or to the span stage.
  function fields_of (line_stage : boolean) return probe_t is
    variable mask : probe_t := (others => '0');

    procedure add (field : slice_t; low : natural) is
    begin
      for i in field.low to field.high loop
        mask(low + i) := '1';
      end loop;
    end procedure;
  begin
    if line_stage then
      add(c_header.line_event, 0);
      add(c_header.line_y, 0);
      add(c_header.line_start, 0);
      add(c_header.line_stop, 0);
      add(c_header.line_carry, 0);
      add(c_header.line_z, 0);
    else
      add(c_header.span_event, 0);
      add(c_header.span_y, 0);
      add(c_header.span_x, 0);
      add(c_header.span_z, 0);
    end if;
    for channel in 0 to g_channels - 1 loop
      if line_stage then
        add(c_channel.line_value, probe_channel_low(g_exact, channel));
        add(c_channel.line_dx, probe_channel_low(g_exact, channel));
        add(c_channel.line_de0, probe_channel_low(g_exact, channel));
        add(c_channel.line_de1, probe_channel_low(g_exact, channel));
      else
        add(c_channel.span_value, probe_channel_low(g_exact, channel));
        add(c_channel.span_dx, probe_channel_low(g_exact, channel));
      end if;
    end loop;
    return mask;
  end function;

  constant c_line_fields : probe_t := fields_of(true);
  constant c_span_fields : probe_t := fields_of(false);

  signal clk               : std_logic := '0';
  signal reset             : std_logic := '1';
  signal init_valid        : std_logic := '0';
  signal init_ready        : std_logic;
  signal init_data         : std_logic_vector(init_bits(g_exact, g_channels) - 1 downto 0) := (others => '0');
  signal fragment_valid    : std_logic;
  signal fragment_ready    : std_logic := '0';
  signal fragment_triangle : std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
  signal fragment_y        : std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
  signal fragment_x        : std_logic_vector(formats(g_exact).pixel_x.bits - 1 downto 0);
  signal fragment_z        : std_logic_vector(formats(g_exact).depth.bits - 1 downto 0);
  signal fragment_red      : std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
  signal fragment_green    : std_logic_vector(fragment_red'range);
  signal fragment_blue     : std_logic_vector(fragment_red'range);
  signal busy              : std_logic;
  signal probe             : probe_t;

  signal payload : std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length + fragment_z'length
    + 3 * fragment_red'length - 1 downto 0);
begin
  payload <= fragment_triangle & fragment_y & fragment_x & fragment_z & fragment_red & fragment_green & fragment_blue;

  dut : entity work.quadratic_shader
    generic map (g_exact => g_exact, g_channels => g_channels, g_probe => g_probe)
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
      probe             => probe);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable inits, fragments, line_probes, span_probes : vectors_t;

    procedure check_flag (name : string; got, expected : std_logic; clock : integer) is
    begin
      assert got = expected
        report g_stem & ": clock " & to_string(clock) & ": " & name & " is " & to_string(got) & ", expected "
        & to_string(expected)
        severity failure;
    end procedure;

    -- One pass over a set. Where it stalls, init is offered in one clock of 2**init_pause, and fragments are taken in
    -- one of 2**fragment_pause. reset_at is the clock of a reset that ends the pass; 0: none.
    procedure pass (set : string; seed, init_pause, fragment_pause, reset_at : natural) is
      constant c_full : boolean := init_pause = 0 and fragment_pause = 0;

      variable random     : unsigned(31 downto 0) := to_unsigned(seed, 32);
      variable init_now   : std_logic_vector(init_data'range);
      variable held       : std_logic_vector(payload'range);
      variable to_come    : boolean;          -- an init vector not yet taken
      variable offered    : boolean := false;
      variable waiting    : boolean := false; -- the last clock's fragment was not taken
      variable just_taken : boolean := false; -- an init vector, in the last clock
      variable clock      : integer := -1;    -- 0: the first init vector is taken
      variable ticks      : natural := 0;
      variable idle       : natural := 0;
      variable taken      : natural := 0;
      variable given      : natural := 0;
      variable init_clock : natural;
    begin
      inits.open_file(g_stem & set & "_init.txt");
      fragments.open_file(g_stem & set & "_fragments.txt");
      line_probes.open_file(g_stem & set & "_line_probes.txt");
      span_probes.open_file(g_stem & set & "_span_probes.txt");
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
            fragments.check_word("triangle", fragment_triangle);
            fragments.check_word("y", fragment_y);
            fragments.check_word("x", fragment_x);
            fragments.check_word("z", fragment_z);
            fragments.check_word("red", fragment_red);
            fragments.check_word("green", fragment_green);
            fragments.check_word("blue", fragment_blue);
            if c_full then
              fragments.check_word("clock", std_logic_vector(to_unsigned(clock, 32)));
              if set = "dense" and clock /= given - 1 + c_latency then
                fragments.fail("comes in clock " & to_string(clock) & ", expected " & to_string(given - 1 + c_latency));
              end if;
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

        if g_probe then
          if probe(c_header.line_event.low) = '1' then
            line_probes.expect_vector("line event");
            line_probes.check_word("probe", probe, c_line_fields);
            idle := 0;
          else
            check_flag("line_event of the probe", probe(c_header.line_event.low), '0', clock);
          end if;
          if probe(c_header.span_event.low) = '1' then
            span_probes.expect_vector("span event");
            span_probes.check_word("probe", probe, c_span_fields);
          else
            check_flag("span_event of the probe", probe(c_header.span_event.low), '0', clock);
          end if;
        else
          assert probe = (probe'range => '0')
            report g_stem & ": probe is " & to_hstring(probe) & " though there is none" severity failure;
        end if;

        just_taken := init_valid = '1' and init_ready = '1';
        if just_taken then
          if c_full and clock /= init_clock then
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

      if ticks /= reset_at then
        if fragments.next_vector then
          fragments.fail("this fragment was not given out");
        end if;
        if g_probe and line_probes.next_vector then
          line_probes.fail("this line event did not come");
        end if;
        if g_probe and span_probes.next_vector then
          span_probes.fail("this span event did not come");
        end if;
      end if;
      inits.close_file;
      fragments.close_file;
      line_probes.close_file;
      span_probes.close_file;

      -- Idle, after a reset as after the last triangle.
      init_valid     <= '0';
      reset          <= '0';
      fragment_ready <= '1';
      for i in 1 to 3 loop
        wait until rising_edge(clk);
        check_flag("init_ready when idle", init_ready, '1', clock);
        check_flag("fragment_valid when idle", fragment_valid, '0', clock);
        check_flag("busy when idle", busy, '0', clock);
      end loop;
    end procedure;

    constant c_resets : integer_vector := (2, 3, 4, 5, 6, 7, 23, 311);
  begin
    wait until rising_edge(clk);
    wait until rising_edge(clk);
    pass("dense", 1, 0, 0, 0);
    pass("mixed", 1, 0, 0, 0);
    pass("mixed", 12, 1, 1, 0);
    pass("mixed", 13, 4, 0, 0);
    pass("dense", 14, 0, 1, 0);
    for i in c_resets'range loop
      pass("mixed", 20 + i, 0, i mod 2, c_resets(i));
    end loop;
    pass("mixed", 1, 0, 0, 0);
    finished <= true;
    wait;
  end process;
end architecture;

entity quadratic_shader_tb is
  generic (
    g_folder : string := "quadratic_shader"
  );
end entity;

architecture sim of quadratic_shader_tb is
  signal finished : boolean_vector(0 to 3);
begin
  exact_colour : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 3, g_probe => true, g_stem => g_folder & "/exact3_")
    port map (finished => finished(0));

  exact_grey : entity work.quadratic_shader_run
    generic map (g_exact => true, g_channels => 1, g_probe => false, g_stem => g_folder & "/exact1_")
    port map (finished => finished(1));

  published_colour : entity work.quadratic_shader_run
    generic map (g_exact => false, g_channels => 3, g_probe => false, g_stem => g_folder & "/published3_")
    port map (finished => finished(2));

  published_grey : entity work.quadratic_shader_run
    generic map (g_exact => false, g_channels => 1, g_probe => true, g_stem => g_folder & "/published1_")
    port map (finished => finished(3));

  done : process is
  begin
    wait until and finished;
    report "quadratic_shader_tb: passed" severity note;
    wait;
  end process;
end architecture;
