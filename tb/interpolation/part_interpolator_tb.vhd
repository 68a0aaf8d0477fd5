-- SPDX-License-Identifier: Apache-2.0
-- Loads, steps and waits at random, with and without a carry, extreme words and wrap-around among them, clock by clock
-- against the golden twin. A word in three parts gives the same two clocks later.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity part_interpolator_run is
  generic (
    g_bits   : positive;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of part_interpolator_run is
  signal clk       : std_logic := '0';
  signal load      : std_logic := '0';
  signal start     : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal step      : std_logic := '0';
  signal increment : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal carry_in  : std_logic := '0';
  signal value     : std_logic_vector(g_bits - 1 downto 0);
  signal carry_out : std_logic;

  constant c_parts : positive := 3;

  subtype parts_t is std_logic_vector(c_parts downto 0);

  signal loads, steps : parts_t := (others => '0'); -- as each part takes them
  signal carries      : parts_t;
  signal word_value   : std_logic_vector(value'range);
begin
  dut : entity work.part_interpolator
    generic map (g_bits => g_bits)
    port map (
      clk       => clk,
      load      => load,
      start     => start,
      step      => step,
      increment => increment,
      carry_in  => carry_in,
      value     => value,
      carry_out => carry_out);

  later : process (clk) is
  begin
    if rising_edge(clk) then
      loads(parts_t'high downto 1) <= loads(parts_t'high - 1 downto 0);
      steps(parts_t'high downto 1) <= steps(parts_t'high - 1 downto 0);
    end if;
  end process;

  loads(0)   <= load;
  steps(0)   <= step;
  carries(0) <= carry_in;

  parts : for part in 0 to c_parts - 1 generate
    constant c_low  : natural := part * g_bits / c_parts;
    constant c_high : natural := (part + 1) * g_bits / c_parts - 1;

    type waits_t is array (0 to c_parts - 1) of std_logic_vector(c_high downto c_low);

    signal starts, increments, values : waits_t;
    begin
      starts(0)     <= start(c_high downto c_low);
      increments(0) <= increment(c_high downto c_low);

      waits : process (clk) is
      begin
        if rising_edge(clk) then
          starts(1 to c_parts - 1)     <= starts(0 to c_parts - 2);
          increments(1 to c_parts - 1) <= increments(0 to c_parts - 2);
          values(1 to c_parts - 1)     <= values(0 to c_parts - 2);
        end if;
      end process;

      one : entity work.part_interpolator
        generic map (g_bits => c_high - c_low + 1)
        port map (
          clk       => clk,
          load      => loads(part),
          start     => starts(part),
          step      => steps(part),
          increment => increments(part),
          carry_in  => carries(part),
          value     => values(0),
          carry_out => carries(part + 1));

      word_value(c_high downto c_low) <= values(c_parts - 1 - part);
  end generate;

  clk <= not clk after c_half_period when not finished;

  run : process is
    type values_t is array (0 to c_parts) of std_logic_vector(value'range);

    variable vectors                       : vectors_t;
    variable load_now, step_now, carry_now : std_logic;
    variable start_now, increment_now      : std_logic_vector(start'range);

    -- Now, in the clock before, ...
    variable checked    : std_logic_vector(values_t'range) := (others => '0');
    variable values     : values_t;
    variable carry_outs : std_logic_vector(values_t'range);

    procedure check_later (name : string; got : std_logic_vector; got_carry : std_logic; behind : positive) is
    begin
      if checked(behind) = '1' and (got /= values(behind) or got_carry /= carry_outs(behind)) then
        vectors.fail(name & " is " & to_hstring(got) & ", carry_out " & to_string(got_carry) & ", expected "
          & to_hstring(values(behind)) & ", " & to_string(carry_outs(behind)) & ", of " & to_string(behind)
          & " clocks before");
      end if;
    end procedure;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & ".txt");
    while vectors.next_vector loop
      checked(1 to c_parts) := checked(0 to c_parts - 1);
      vectors.read_flag(checked(0));
      vectors.read_flag(load_now);
      vectors.read_word(start_now);
      vectors.read_flag(step_now);
      vectors.read_word(increment_now);
      vectors.read_flag(carry_now);
      load      <= load_now;
      start     <= start_now;
      step      <= step_now;
      increment <= increment_now;
      carry_in  <= carry_now;
      wait until rising_edge(clk);
      vectors.check_word_if(checked(0), "value", value);
      vectors.check_flag_if(checked(0), "carry_out", carry_out);
      values     := value & values(0 to c_parts - 1);
      carry_outs := carry_out & carry_outs(0 to c_parts - 1);
      check_later("in parts, value", word_value, carries(c_parts), c_parts - 1);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.formats_pkg.all;

entity part_interpolator_tb is
  generic (
    g_folder : string := "part_interpolator"
  );
end entity;

architecture sim of part_interpolator_tb is
  signal finished : boolean_vector(0 to 2);
begin
  small : entity work.part_interpolator_run
    generic map (g_bits => 3, g_folder => g_folder)
    port map (finished => finished(0));

  presets : for exact in boolean generate
    intensity : entity work.part_interpolator_run
      generic map (g_bits => formats(exact).intensity.bits / 2, g_folder => g_folder)
      port map (finished => finished(1 + boolean'pos(exact)));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "part_interpolator_tb: passed" severity note;
    wait;
  end process;
end architecture;
