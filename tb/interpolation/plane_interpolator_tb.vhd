-- SPDX-License-Identifier: Apache-2.0
-- The planes of both presets, and one without de1: every combination of the walker's strobes at random, clock by clock
-- against the golden twin; in halves the same a clock later.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity plane_interpolator_run is
  generic (
    g_bits    : positive;
    g_carries : boolean;
    g_file    : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of plane_interpolator_run is
  signal clk        : std_logic := '0';
  signal plane      : std_logic_vector((3 + boolean'pos(g_carries)) * g_bits - 1 downto 0) := (others => '0');
  signal line_load  : std_logic := '0';
  signal line_step  : std_logic := '0';
  signal line_carry : std_logic := '0';
  signal span_load  : std_logic := '0';
  signal span_step  : std_logic := '0';
  signal line_value : std_logic_vector(g_bits - 1 downto 0);
  signal value      : std_logic_vector(line_value'range);

  signal split_line_value, split_value : std_logic_vector(line_value'range);
begin
  dut : entity work.plane_interpolator
    generic map (g_bits => g_bits, g_carries => g_carries)
    port map (
      clk        => clk,
      plane      => plane,
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => line_value,
      value      => value);

    -- A clock later the same.
  split : entity work.plane_interpolator
    generic map (g_bits => g_bits, g_carries => g_carries, g_split => true)
    port map (
      clk        => clk,
      plane      => plane,
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => split_line_value,
      value      => split_value);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors  : vectors_t;
    variable checked  : std_logic;
    variable before   : std_logic := '0'; -- checked, in the clock before
    variable before_line_value : std_logic_vector(line_value'range);
    variable before_value : std_logic_vector(line_value'range);
    variable next_plane : std_logic_vector(plane'range);
    variable strobe   : std_logic_vector(1 to 5);
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.read_word(next_plane);
      for i in strobe'range loop
        vectors.read_flag(strobe(i));
      end loop;
      plane <= next_plane;
      (line_load, line_step, line_carry, span_load, span_step) <= strobe;
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "line_value", line_value);
      vectors.check_word_if(checked, "value", value);
      assert before = '0' or split_line_value = before_line_value
        report "plane_interpolator: split, line_value is " & to_hstring(split_line_value) & ", expected " & to_hstring(before_line_value)
        severity failure;
      assert before = '0' or split_value = before_value
        report "plane_interpolator: split, value is " & to_hstring(split_value) & ", expected " & to_hstring(before_value)
        severity failure;
      before_line_value := line_value;
      before_value := value;
      before := checked;
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity plane_interpolator_tb is
  generic (
    g_folder : string := "plane_interpolator"
  );
end entity;

architecture sim of plane_interpolator_tb is
  signal finished : boolean_vector(0 to 2);
begin
  exact : entity work.plane_interpolator_run
    generic map (g_bits => c_exact_formats.plane_sum.bits, g_carries => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.plane_interpolator_run
    generic map (g_bits => c_published_formats.plane_sum.bits, g_carries => true, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  without_carry : entity work.plane_interpolator_run
    generic map (g_bits => 7, g_carries => false, g_file => g_folder & "/without_carry.txt")
    port map (finished => finished(2));

  done : process is
  begin
    wait until and finished;
    report "plane_interpolator_tb: passed" severity note;
    wait;
  end process;
end architecture;
