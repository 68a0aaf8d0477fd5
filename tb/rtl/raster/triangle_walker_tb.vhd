-- SPDX-License-Identifier: Apache-2.0
-- Both presets, on triangles without empty lines, and on a mix with empty lines and random words. Every strobe and
-- pixel is compared with the golden model, in order. At full speed every init vector must be accepted, and every
-- fragment output, in the clock that the entity's header promises. Without empty lines that is one fragment per clock;
-- only a triangle of a single pixel takes two clocks (tb/vectors/raster.cpp). Other passes have random stalls of init,
-- lines and fragments, or a reset in the middle.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity triangle_walker_tb is
  generic (g_folder : string := "triangle_walker");
end entity;

architecture sim of triangle_walker_tb is
  constant c_latency    : positive := 3;      -- clocks from an accepted init vector to the first fragment
  constant c_idle_limit : positive := 10_000; -- clocks without a transfer that count as a hang
begin
  presets : for exact in boolean generate
    constant c_formats : formats_t := formats(exact);
    constant c_stem    : string    := g_folder & "/" & preset_name(exact) & "_";

    signal ended                           : boolean := false;
    signal clk                             : std_logic := '0';
    signal reset                           : std_logic := '1';
    signal init_valid                      : std_logic := '0';
    signal init_ready                      : std_logic;
    signal init                            : std_logic_vector(init_bits(exact, 0) - 1 downto 0) := (others => '0');
    signal line_ready                      : std_logic := '1';
    signal line_held, line_load, line_step : std_logic;
    signal line_carry, span_load           : std_logic;
    signal span_step, fragment_valid       : std_logic;
    signal fragment_ready                  : std_logic := '0';
    signal triangle                        : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
    signal y                               : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
    signal x                               : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
    signal busy                            : std_logic;
  begin
    dut : entity work.triangle_walker
      generic map (g_exact => exact)
      port map (
        clk            => clk,
        reset          => reset,
        init_valid     => init_valid,
        init_ready     => init_ready,
        init           => init,
        line_ready     => line_ready,
        line_held      => line_held,
        line_load      => line_load,
        line_step      => line_step,
        line_carry     => line_carry,
        span_load      => span_load,
        span_step      => span_step,
        fragment_valid => fragment_valid,
        fragment_ready => fragment_ready,
        triangle       => triangle,
        y              => y,
        x              => x,
        busy           => busy);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable inits, lines, fragments : vectors_t;

      procedure check_flag (name : string; got, expected : std_logic; clock : integer) is
      begin
        check(c_stem & ": clock", clock, name, got, expected);
      end procedure;

      -- One pass over a set. With stalls, init is offered in one of 2**init_pause clocks, line_ready is '1' in one of
      -- 2**line_pause, and fragment_ready in one of 2**fragment_pause. The pass ends with a reset in clock reset_at; 0:
      -- no reset.
      procedure pass (set : string; seed, init_pause, line_pause, fragment_pause, reset_at : natural) is
        constant c_full : boolean := init_pause = 0 and line_pause = 0 and fragment_pause = 0;

        variable random     : unsigned(31 downto 0) := to_unsigned(seed, 32);
        variable init_now   : std_logic_vector(init'range);
        variable to_come    : boolean;            -- an init vector is not yet accepted
        variable offered    : boolean := false;
        variable in_edge    : boolean := false;   -- the edge stage holds a triangle that has not started
        variable in_line    : boolean := false;   -- the line stage holds a triangle
        variable waiting    : boolean := false;   -- the fragment of the last clock was not accepted
        variable empty      : std_logic;
        variable last       : std_logic;
        variable clock      : integer := -1;      -- 0: the first init vector is accepted
        variable ticks      : natural := 0;
        variable idle       : natural := 0;
        variable taken      : natural := 0;
        variable given      : natural := 0;
        variable init_clock : natural;
      begin
        inits.open_file(c_stem & set & "_init.txt");
        lines.open_file(c_stem & set & "_lines.txt");
        fragments.open_file(c_stem & set & "_fragments.txt");
        to_come := inits.next_vector;
        inits.read_word(init_now);
        init_clock := inits.read_number;

        loop
          random  := next_random(random);
          offered := to_come and (offered or chance(random(19 downto 12), init_pause));
          init_valid <= to_flag(offered);
          if offered then
            init <= init_now;
          else
            init <= (others => '1');
          end if;
          line_ready     <= to_flag(chance(random(11 downto 4), line_pause));
          fragment_ready <= to_flag(chance(random(30 downto 23), fragment_pause));
          ticks := ticks + 1;
          reset <= to_flag(ticks = reset_at);
          wait until rising_edge(clk);
          exit when ticks = reset_at;
          if clock >= 0 or (init_valid = '1' and init_ready = '1') then
            clock := clock + 1;
          end if;
          idle := idle + 1;

          -- Check the contract for the outputs that do not depend on the triangles.
          check_flag("busy", busy, to_flag(in_edge) or to_flag(in_line) or fragment_valid, clock);
          check_flag("line_held", line_held, to_flag(in_line), clock);
          check_flag("span_step", span_step, fragment_valid and fragment_ready, clock);
          if waiting then
            check_flag("fragment_valid of a fragment not taken", fragment_valid, '1', clock);
          end if;

          if fragment_valid = '1' then
            -- Compare in every clock: a waiting fragment must be stable.
            if not waiting then
              fragments.expect_vector("fragment " & to_string(given));
              given := given + 1;
              fragments.check("triangle", triangle);
              fragments.check("y", y);
              fragments.check("x", x);
              if c_full then
                fragments.check("clock", std_logic_vector(to_unsigned(clock, 32)));
                if given = 1 and clock /= c_latency then
                  fragments.fail("comes in clock " & to_string(clock) & ", expected " & to_string(c_latency));
                end if;
              end if;
            else
              assert y'stable(2 * c_half_period) and x'stable(2 * c_half_period) and triangle'stable(2 * c_half_period)
                report c_stem & ": fragment " & to_string(given) & " changes while it waits" severity failure;
            end if;
            idle := 0;
          end if;
          waiting := fragment_valid = '1' and fragment_ready = '0';

          if line_step = '1' then
            check_flag("line_step without a triangle", to_flag(in_line), '1', clock);
            check_flag("line_ready of a line that goes on", line_ready, '1', clock);
            lines.expect_vector("line");
            lines.read_flag(empty);
            lines.read_flag(last);
            lines.check_if(not last, "line_carry", line_carry);
            check_flag("span_load", span_load, not empty, clock);
            in_line := last = '0';
            idle    := 0;
          else
            check_flag("span_load", span_load, '0', clock);
          end if;

          if line_load = '1' then
            check_flag("line_load without a triangle", to_flag(in_edge), '1', clock);
            check_flag("line_load over a triangle not yet drawn", to_flag(in_line), '0', clock);
            in_edge := false;
            in_line := true;
            idle    := 0;
          end if;

          if init_valid = '1' and init_ready = '1' then
            check_flag("init_ready over a triangle that has not begun", to_flag(in_edge), '0', clock);
            if c_full and clock /= init_clock then
              inits.fail("is taken in clock " & to_string(clock) & ", expected " & to_string(init_clock));
            end if;
            in_edge := true;
            offered := false;
            taken   := taken + 1;
            to_come := inits.next_vector;
            if to_come then
              inits.read_word(init_now);
              init_clock := inits.read_number;
            end if;
            idle := 0;
          end if;

          exit when not to_come and not in_edge and not in_line and line_step = '0' and fragment_valid = '0';
          assert idle < c_idle_limit
            report c_stem & set & ": nothing moved for " & to_string(c_idle_limit) & " clocks after "
            & to_string(taken) & " init vectors and " & to_string(given) & " fragments"
            severity failure;
        end loop;

        if ticks /= reset_at then
          if lines.next_vector then
            lines.fail("this line was not drawn");
          end if;
          if fragments.next_vector then
            fragments.fail("this fragment was not given out");
          end if;
        end if;
        inits.close_file;
        lines.close_file;
        fragments.close_file;

        -- Check that the walker is idle, both after a reset and after the last triangle.
        init_valid     <= '0';
        reset          <= '0';
        fragment_ready <= '1';
        for i in 1 to 3 loop
          wait until rising_edge(clk);
          check_flag("init_ready when idle", init_ready, '0', clock);
          check_flag("fragment_valid when idle", fragment_valid, '0', clock);
          check_flag("busy when idle", busy, '0', clock);
          check_flag("line_step when idle", line_step, '0', clock);
          check_flag("span_load when idle", span_load, '0', clock);
        end loop;
      end procedure;

      constant c_resets : integer_vector := (2, 3, 4, 5, 6, 23, 57, 311, 1_002, 2_741);
    begin
      wait until rising_edge(clk);
      wait until rising_edge(clk);
      pass("dense", 1, 0, 0, 0, 0);
      pass("mixed", 1, 0, 0, 0, 0);
      pass("dense", 11, 1, 0, 1, 0);
      pass("mixed", 12, 1, 0, 1, 0);
      pass("mixed", 13, 6, 0, 0, 0);
      pass("dense", 14, 0, 0, 2, 0);
      pass("dense", 15, 0, 2, 0, 0);
      pass("mixed", 16, 1, 1, 1, 0);
      for i in c_resets'range loop
        pass("mixed", 20 + i, 0, i / 2 mod 2, i mod 2, c_resets(i));
      end loop;
      pass("mixed", 1, 0, 0, 0, 0);
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "triangle_walker_tb");
end architecture;
