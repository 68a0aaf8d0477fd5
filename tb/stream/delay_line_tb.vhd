-- SPDX-License-Identifier: Apache-2.0
-- Random words through lines of several depths: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity delay_line_tb is
  generic (g_folder : string := "delay_line");
end entity;

architecture sim of delay_line_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, depth
  constant c_sizes : sizes_t := ((8, 1), (70, 2), (1, 3), (33, 4), (100, 13), (8, 0));
begin
  sizes : for i in c_sizes'range generate
    signal clk           : std_logic := '0';
    signal enable        : std_logic;
    signal word, delayed : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
    begin
      dut : entity work.delay_line
        generic map (g_bits => c_sizes(i)(0), g_depth => c_sizes(i)(1))
        port map (clk => clk, enable => enable, word => word, delayed => delayed);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt", c_sizes(i)(1));
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(word);
          settle;
          vectors.check("delayed", delayed);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "delay_line_tb");
end architecture;
