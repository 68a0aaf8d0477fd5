-- SPDX-License-Identifier: Apache-2.0
-- Random loads, steps and waits, with and without a carry, with extreme words and wrap-around. Every clock is compared
-- with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity part_interpolator_tb is
  generic (g_folder : string := "part_interpolator");
end entity;

architecture sim of part_interpolator_tb is
  constant c_bits : integer_vector := (3, formats(false).intensity.bits / 2, formats(true).intensity.bits / 2);
begin
  widths : for i in c_bits'range generate
    signal clk       : std_logic := '0';
    signal load      : std_logic;
    signal start     : std_logic_vector(c_bits(i) - 1 downto 0);
    signal step      : std_logic;
    signal increment : std_logic_vector(c_bits(i) - 1 downto 0);
    signal carry_in  : std_logic;
    signal value     : std_logic_vector(c_bits(i) - 1 downto 0);
    signal carry_out : std_logic;
    begin
      dut : entity work.part_interpolator
        generic map (g_bits => c_bits(i))
        port map (
          clk       => clk,
          load      => load,
          start     => start,
          step      => step,
          increment => increment,
          carry_in  => carry_in,
          value     => value,
          carry_out => carry_out);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_bits(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(load);
          vectors.drive(start);
          vectors.drive(step);
          vectors.drive(increment);
          vectors.drive(carry_in);
          settle;
          vectors.check("value", value);
          vectors.check("carry_out", carry_out);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "part_interpolator_tb");
end architecture;
