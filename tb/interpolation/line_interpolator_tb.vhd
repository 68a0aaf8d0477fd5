-- SPDX-License-Identifier: Apache-2.0
-- Random loads, steps and waits, with extreme words and wrap-around. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity line_interpolator_tb is
  generic (g_folder : string := "line_interpolator");
end entity;

architecture sim of line_interpolator_tb is
  constant c_bits : integer_vector := (3, formats(false).intensity.bits, formats(true).intensity.bits);
begin
  widths : for i in c_bits'range generate
    signal clk                     : std_logic := '0';
    signal load, step              : std_logic;
    signal start, increment, value : std_logic_vector(c_bits(i) - 1 downto 0);
    begin
      dut : entity work.line_interpolator
        generic map (g_bits => c_bits(i))
        port map (clk => clk, load => load, start => start, step => step, increment => increment, value => value);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_bits(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(load);
          vectors.drive(start);
          vectors.drive(step);
          vectors.drive(increment);
          settle;
          vectors.check("value", value);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "line_interpolator_tb");
end architecture;
