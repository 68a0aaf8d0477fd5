-- SPDX-License-Identifier: Apache-2.0
-- Random loads, steps and waits, with and without a carry, with extreme words and wrap-around. Every clock is compared
-- with the golden model.
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

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(load);
      vectors.drive(start);
      vectors.drive(step);
      vectors.drive(increment);
      vectors.drive(carry_in);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "value", value);
      vectors.check_flag_if(checked, "carry_out", carry_out);
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
