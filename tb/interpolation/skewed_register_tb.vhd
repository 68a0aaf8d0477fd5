-- SPDX-License-Identifier: Apache-2.0
-- Random loads and waits. Every clock is compared with the golden model of parameter_register, with its two words
-- skewed.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_register_tb is
  generic (g_folder : string := "skewed_register");
end entity;

architecture sim of skewed_register_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, parts
  constant c_sizes : sizes_t  := ((20, 2), (32, 1), (7, 3));
  constant c_words : positive := 2;
begin
  sizes : for i in c_sizes'range generate
    signal clk          : std_logic := '0';
    signal load         : std_logic;
    signal start, value : std_logic_vector(c_words * c_sizes(i)(0) - 1 downto 0);
    begin
      dut : entity work.skewed_register
        generic map (g_bits => c_sizes(i)(0), g_parts => c_sizes(i)(1), g_words => c_words)
        port map (clk => clk, load => load, start => start, value => value);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(load);
          vectors.drive(start);
          settle;
          vectors.check("value", value);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "skewed_register_tb");
end architecture;
