-- SPDX-License-Identifier: Apache-2.0
-- Draws lines of pixels with one step per pixel, after one step that loads. Measures the delays, the stages and their
-- overlap between events, and computes the expected values without the model's generics. Other delays or another step
-- in the generics must therefore be detected.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use ieee.math_real.all;
use work.tb_pkg.next_random;

entity interpolator_timing_tb is
  generic (
    g_lines         : positive := 200; -- figure 17 shows the first line
    g_step_ns       : positive := 60;  -- of the second line and all others
    g_mux_ns        : positive := 5;
    g_adder_ns      : positive := 10;
    g_register_ns   : positive := 5;
    g_rom_ns        : positive := 15;
    g_multiplier_ns : positive := 35
  );
end entity;

architecture sim of interpolator_timing_tb is

  type part_t is (multiplexer, adder, angle_register, rom, multiplier);
  type times_t is array (part_t) of time;

  -- Published, except ROM and multiplier, which are assumptions.
  constant c_delays : times_t := (5 ns, 10 ns, 5 ns, 15 ns, 35 ns);
  constant c_step   : time    := 60 ns;
  -- Stage 1, from step to multiplexer; stage 2, from step to product; overlap of the adder with ROM and multiplier.
  constant c_stage_1 : time := c_delays(angle_register) + c_delays(adder) + c_delays(multiplexer);
  constant c_stage_2 : time := c_delays(angle_register) + c_delays(rom) + c_delays(multiplier);
  constant c_overlap : time := c_delays(adder);


  signal init       : std_logic                     := '0';
  signal step       : std_logic                     := '0';
  signal start      : std_logic_vector(11 downto 0) := (others => '0');
  signal slope      : std_logic_vector(11 downto 0) := (others => '0');
  signal factor     : std_logic_vector(7 downto 0)  := (others => '0');
  signal sum        : std_logic_vector(11 downto 0);
  signal next_angle : std_logic_vector(11 downto 0);
  signal angle      : std_logic_vector(11 downto 0);
  signal ra         : std_logic_vector(5 downto 0);
  signal sample     : std_logic_vector(5 downto 0);
  signal product    : std_logic_vector(13 downto 0);

  -- Measured by the monitor.
  signal measured : times_t := (others => 0 ns);
  signal stage_1  : time    := 0 ns;
  signal stage_2  : time    := 0 ns;
  signal overlap  : time    := 0 ns;
  signal overlaps : natural := 0;

  procedure check_time (name : in string; got, expected : in time) is
  begin
    assert got = expected
      report name & " takes " & to_string(got, 1 ns) & ", expected " & to_string(expected, 1 ns) severity failure;
  end procedure;

  procedure check_word (name : in string; got : in std_logic_vector; expected : in natural) is
    constant c_expected : std_logic_vector(got'range) := std_logic_vector(to_unsigned(expected, got'length));
  begin
    assert got = c_expected
      report name & " is " & to_hstring(got) & ", expected " & to_hstring(c_expected) severity failure;
  end procedure;

  -- The published table's entry for this angle, computed by its formula.
  function bell (angle_word : natural) return natural is
    variable address : real := real(angle_word / 2 ** 6);
  begin
    if angle_word >= 2 ** 11 then
      address := address - 64.0;
    end if;
    return integer(round(63.0 * cos(math_pi_over_2 * (address + 0.5) / 32.0) ** 2));
  end function;

  function number (word : std_logic_vector) return natural is
  begin
    return to_integer(unsigned(word));
  end function;

begin

  dut : entity work.interpolator_timing
    generic map (
      g_mux_delay        => g_mux_ns * 1 ns,
      g_adder_delay      => g_adder_ns * 1 ns,
      g_register_delay   => g_register_ns * 1 ns,
      g_rom_delay        => g_rom_ns * 1 ns,
      g_multiplier_delay => g_multiplier_ns * 1 ns)
    port map (
      init       => init,
      step       => step,
      start      => start,
      slope      => slope,
      factor     => factor,
      sum        => sum,
      next_angle => next_angle,
      angle      => angle,
      ra         => ra,
      sample     => sample,
      product    => product);

  run : process is
    variable random            : unsigned(31 downto 0) := x"2545F491";
    variable last_sample       : natural               := 2 ** 6;
    variable expected_overlaps : natural               := 0;

    procedure draw_line (line, start_word, slope_word, factor_word, pixels : in natural; period : in time) is
      variable angle_word : natural := start_word;

      impure function here (pixel : natural) return string is
      begin
        return "line " & to_string(line) & ", pixel " & to_string(pixel) & ": ";
      end function;

      -- Check the register's next value and that it is stable before the step.
      procedure check_stage_1 (pixel : in natural) is
      begin
        check_word(here(pixel) & "what the register takes", next_angle, angle_word);
        assert next_angle'last_event > 0 ns
          report here(pixel) & "the multiplexer changes as the step comes" severity failure;
      end procedure;

      procedure check_stage_2 (pixel, pixel_angle : in natural) is
      begin
        check_word(here(pixel) & "angle", angle, pixel_angle);
        check_word(here(pixel) & "product", product, bell(pixel_angle) * factor_word);
        assert product'last_event > 0 ns
          report here(pixel) & "the product changes as the step comes" severity failure;
      end procedure;
    begin
      init   <= '1';
      start  <= std_logic_vector(to_unsigned(start_word, start'length));
      slope  <= std_logic_vector(to_unsigned(slope_word, slope'length));
      factor <= std_logic_vector(to_unsigned(factor_word, factor'length));
      wait for period;
      check_stage_1(0);
      for pixel in 0 to pixels - 1 loop
        step <= '1';
        wait for period / 2;
        step <= '0';
        init <= '0';
        wait for period - period / 2;

        if bell(angle_word) /= last_sample and factor_word /= 0 then
          expected_overlaps := expected_overlaps + 1;
        end if;
        last_sample := bell(angle_word);

        -- Stage 2 now has this pixel's product, and stage 1 the next pixel's angle.
        angle_word := (angle_word + slope_word) mod 2 ** 12;
        check_stage_1(pixel + 1);
        check_stage_2(pixel, (angle_word - slope_word) mod 2 ** 12);
      end loop;
    end procedure;
  begin
    draw_line(1, 16#B9A#, 16#2CD#, 16#C8#, 4, c_step);
    for line in 2 to g_lines loop
      random := next_random(random);
      draw_line(line, number(std_logic_vector(random(11 downto 0))), number(std_logic_vector(random(23 downto 12))),
        number(std_logic_vector(random(31 downto 24))), 1 + line mod 8, g_step_ns * 1 ns);
    end loop;

    wait for c_step / 2; -- extends the waveform of figure 17 by the last product
    for part in part_t loop
      check_time(to_string(part), measured(part), c_delays(part));
    end loop;
    check_time("stage 1", stage_1, c_stage_1);
    check_time("stage 2", stage_2, c_stage_2);
    check_time("the overlap", overlap, c_overlap);
    assert maximum(stage_1, stage_2) < c_step report "a stage does not fit into a step" severity failure;
    assert overlaps = expected_overlaps
      report "the stages overlap in " & to_string(overlaps) & " pixels, expected " & to_string(expected_overlaps)
      severity failure;
    for part in part_t loop
      report to_string(part) & " " & to_string(measured(part), 1 ns) severity note;
    end loop;
    report "stage 1 " & to_string(stage_1, 1 ns) & ", stage 2 " & to_string(stage_2, 1 ns) & ", both at once "
      & to_string(overlap, 1 ns) & " of a step of " & to_string(c_step, 1 ns) & ", in " & to_string(overlaps)
      & " pixels" severity note;
    report "interpolator_timing_tb: passed" severity note;
    wait;
  end process;

  -- At every event of an output, check its value and the time since the event of the input that caused it.
  monitor : process (init, step, start, slope, factor, sum, next_angle, angle, ra, sample, product) is
    -- Times of the last events.
    variable step_at, angle_at, sum_at, ra_at : time := 0 ns;

    variable both : time;
  begin
    if rising_edge(step) then
      if init = '0' then
        check_time("a step", now - step_at, c_step);
      end if;
      step_at := now;
    end if;

    if angle'event and not is_x(angle) then
      check_time("angle_register", step'last_event, c_delays(angle_register));
      measured(angle_register) <= step'last_event;
      angle_at := now;
    end if;

    if sum'event and not is_x(sum) then
      check_time("adder", minimum(angle'last_event, slope'last_event), c_delays(adder));
      check_word("sum", sum, (number(angle) + number(slope)) mod 2 ** 12);
      measured(adder) <= minimum(angle'last_event, slope'last_event);
      sum_at := now;
    end if;

    if next_angle'event and not is_x(next_angle) then
      if init = '1' then
        check_time("multiplexer", minimum(init'last_event, start'last_event), c_delays(multiplexer));
        check_word("next angle", next_angle, number(start));
      else
        check_time("multiplexer", minimum(init'last_event, sum'last_event), c_delays(multiplexer));
        check_word("next angle", next_angle, number(sum));
        measured(multiplexer) <= minimum(init'last_event, sum'last_event);
        if sum'last_event < init'last_event then
          stage_1 <= maximum(stage_1, now - step_at);
        end if;
      end if;
    end if;

    if ra'event then
      ra_at := now;
    end if;

    if sample'event and not is_x(sample) then
      check_time("rom", ra'last_event, c_delays(rom));
      check_word("sample", sample, bell(number(angle)));
      measured(rom) <= ra'last_event;
    end if;

    if product'event and not is_x(product) then
      check_time("multiplier", minimum(sample'last_event, factor'last_event), c_delays(multiplier));
      check_word("product", product, number(factor) * number(sample));
      measured(multiplier) <= minimum(sample'last_event, factor'last_event);

      -- The sample changed later than the factor, so a step caused this product. The adder computed the next angle
      -- meanwhile.
      if sample'last_event < factor'last_event then
        stage_2 <= maximum(stage_2, now - step_at);
        both := minimum(now, sum_at) - maximum(ra_at, angle_at);
        check_time("the overlap", both, c_overlap);
        overlap  <= both;
        overlaps <= overlaps + 1;
      end if;
    end if;
  end process;
end architecture;
