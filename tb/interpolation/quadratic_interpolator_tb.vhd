-- SPDX-License-Identifier: Apache-2.0
-- Both presets: every combination of the walker's strobes at random, clock by clock against the golden twin;
-- in halves the same a clock later.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity quadratic_interpolator_run is
  generic (
    g_exact : boolean;
    g_file  : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of quadratic_interpolator_run is
  constant c_init_bits : positive := init_channel_low(g_exact, 1) - init_channel_low(g_exact, 0);

  subtype word_t is std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);

  signal clk        : std_logic := '0';
  signal init       : std_logic_vector(c_init_bits - 1 downto 0) := (others => '0');
  signal line_load  : std_logic := '0';
  signal line_step  : std_logic := '0';
  signal line_carry : std_logic := '0';
  signal span_load  : std_logic := '0';
  signal span_step  : std_logic := '0';

  signal line_value, line_dx, line_de0, line_de1, value, dx : word_t;

  signal split_line_value, split_line_dx, split_line_de0, split_line_de1, split_value, split_dx : word_t;
begin
  dut : entity work.quadratic_interpolator
    generic map (g_exact => g_exact)
    port map (
      clk        => clk,
      init       => init,
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => line_value,
      line_dx    => line_dx,
      line_de0   => line_de0,
      line_de1   => line_de1,
      value      => value,
      dx         => dx);

    -- A clock later the same.
  split : entity work.quadratic_interpolator
    generic map (g_exact => g_exact, g_split => true)
    port map (
      clk        => clk,
      init       => init,
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => split_line_value,
      line_dx    => split_line_dx,
      line_de0   => split_line_de0,
      line_de1   => split_line_de1,
      value      => split_value,
      dx         => split_dx);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors  : vectors_t;
    variable checked  : std_logic;
    variable before   : std_logic := '0'; -- checked, in the clock before
    variable before_line_value : word_t;
    variable before_line_dx : word_t;
    variable before_line_de0 : word_t;
    variable before_line_de1 : word_t;
    variable before_value : word_t;
    variable before_dx : word_t;
    variable init_now : std_logic_vector(init'range);
    variable strobe   : std_logic_vector(1 to 5);
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.read_word(init_now);
      for i in strobe'range loop
        vectors.read_flag(strobe(i));
      end loop;
      init <= init_now;
      (line_load, line_step, line_carry, span_load, span_step) <= strobe;
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "line_value", line_value);
      vectors.check_word_if(checked, "line_dx", line_dx);
      vectors.check_word_if(checked, "line_de0", line_de0);
      vectors.check_word_if(checked, "line_de1", line_de1);
      vectors.check_word_if(checked, "value", value);
      vectors.check_word_if(checked, "dx", dx);
      assert before = '0' or split_line_value = before_line_value
        report "quadratic_interpolator: split, line_value is " & to_hstring(split_line_value) & ", expected " & to_hstring(before_line_value)
        severity failure;
      assert before = '0' or split_line_dx = before_line_dx
        report "quadratic_interpolator: split, line_dx is " & to_hstring(split_line_dx) & ", expected " & to_hstring(before_line_dx)
        severity failure;
      assert before = '0' or split_line_de0 = before_line_de0
        report "quadratic_interpolator: split, line_de0 is " & to_hstring(split_line_de0) & ", expected " & to_hstring(before_line_de0)
        severity failure;
      assert before = '0' or split_line_de1 = before_line_de1
        report "quadratic_interpolator: split, line_de1 is " & to_hstring(split_line_de1) & ", expected " & to_hstring(before_line_de1)
        severity failure;
      assert before = '0' or split_value = before_value
        report "quadratic_interpolator: split, value is " & to_hstring(split_value) & ", expected " & to_hstring(before_value)
        severity failure;
      assert before = '0' or split_dx = before_dx
        report "quadratic_interpolator: split, dx is " & to_hstring(split_dx) & ", expected " & to_hstring(before_dx)
        severity failure;
      before_line_value := line_value;
      before_line_dx := line_dx;
      before_line_de0 := line_de0;
      before_line_de1 := line_de1;
      before_value := value;
      before_dx := dx;
      before := checked;
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity quadratic_interpolator_tb is
  generic (
    g_folder : string := "quadratic_interpolator"
  );
end entity;

architecture sim of quadratic_interpolator_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact : entity work.quadratic_interpolator_run
    generic map (g_exact => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.quadratic_interpolator_run
    generic map (g_exact => false, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "quadratic_interpolator_tb: passed" severity note;
    wait;
  end process;
end architecture;
