-- SPDX-License-Identifier: Apache-2.0
-- Both presets: every combination of the walker's strobes at random, clock by clock against the golden twin; in parts,
-- the same clocks later.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity z_interpolator_run is
  generic (
    g_exact   : boolean;
    g_file    : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of z_interpolator_run is
  type field_t is (line_value, value);

  type words_t is array (field_t) of std_logic_vector(formats(g_exact).depth_sum.bits - 1 downto 0);

  type outputs_t is array (natural range <>) of words_t;

  constant c_forms : interpolator_forms_t := ((2, true, 1), (3, true, 2), (1, false, 0), (2, false, 1));

  signal clk        : std_logic := '0';
  signal init       : std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0) := (others => '0');
  signal line_load  : std_logic := '0';
  signal line_step  : std_logic := '0';
  signal line_carry : std_logic := '0';
  signal span_load  : std_logic := '0';
  signal span_step  : std_logic := '0';

  signal plain   : words_t;
  signal outputs : outputs_t(c_forms'range);
begin
  dut : entity work.z_interpolator
    generic map (g_exact => g_exact)
    port map (
      clk        => clk,
      init       => init,
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => plain(line_value),
      value      => plain(value));

  forms : for i in c_forms'range generate
    form : entity work.z_interpolator
      generic map (g_exact => g_exact, g_parts => c_forms(i).parts, g_probe => c_forms(i).probe)
      port map (
        clk        => clk,
        init       => init,
        line_load  => line_load,
        line_step  => line_step,
        line_carry => line_carry,
        span_load  => span_load,
        span_step  => span_step,
        line_value => outputs(i)(line_value),
        value      => outputs(i)(value));
  end generate;

  clk <= not clk after c_half_period when not finished;

  run : process is
    constant c_most : positive := 2; -- clocks behind

    variable vectors  : vectors_t;
    variable strobe   : std_logic_vector(1 to 5);
    variable checked  : std_logic_vector(0 to c_most) := (others => '0'); -- now, in the clock before, ...
    variable before   : outputs_t(0 to c_most);
    variable expected : std_logic_vector(formats(g_exact).depth_sum.bits - 1 downto 0);
    variable compared : std_logic;
    variable words    : std_logic_vector(init'range);
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      checked(1 to c_most) := checked(0 to c_most - 1);
      vectors.read_flag(checked(0));
      vectors.read_word(words);
      for i in strobe'range loop
        vectors.read_flag(strobe(i));
      end loop;
      init <= words;
      (line_load, line_step, line_carry, span_load, span_step) <= strobe;
      wait until rising_edge(clk);
      before := plain & before(0 to c_most - 1);
      for field in field_t loop
        vectors.check_word_if(checked(0), field_t'image(field), plain(field));
        for i in c_forms'range loop
          expected := before(c_forms(i).behind)(field);
          compared := checked(c_forms(i).behind);
          if not c_forms(i).probe and field /= value then
            expected := (others => '0');
            compared := '1';
          end if;
          if compared = '1' and outputs(i)(field) /= expected then
            vectors.fail(field_t'image(field) & " in parts: " & to_string(c_forms(i).parts) & ", probe: "
              & to_string(c_forms(i).probe) & ", is " & to_hstring(outputs(i)(field)) & ", expected " & to_hstring(expected) & ", of "
              & to_string(c_forms(i).behind) & " clocks before");
          end if;
        end loop;
      end loop;
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity z_interpolator_tb is
  generic (
    g_folder : string := "z_interpolator"
  );
end entity;

architecture sim of z_interpolator_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact : entity work.z_interpolator_run
    generic map (g_exact => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.z_interpolator_run
    generic map (g_exact => false, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "z_interpolator_tb: passed" severity note;
    wait;
  end process;
end architecture;
