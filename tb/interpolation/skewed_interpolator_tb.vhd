-- SPDX-License-Identifier: Apache-2.0
-- Random loads, steps and waits, with extreme words and wrap-around. Every clock is compared with the golden model of
-- line_interpolator, with its words skewed.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_interpolator_tb is
  generic (g_folder : string := "skewed_interpolator");
end entity;

architecture sim of skewed_interpolator_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, parts
  constant c_sizes : sizes_t := ((40, 2), (32, 1), (7, 3));
begin
  sizes : for i in c_sizes'range generate
    signal clk                     : std_logic := '0';
    signal load, step              : std_logic;
    signal start, increment, value : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
    begin
      dut : entity work.skewed_interpolator
        generic map (g_bits => c_sizes(i)(0), g_parts => c_sizes(i)(1))
        port map (clk => clk, load => load, start => start, step => step, increment => increment, value => value);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
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

  report_end(finished, "skewed_interpolator_tb");
end architecture;
