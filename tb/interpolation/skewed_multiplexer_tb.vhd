-- SPDX-License-Identifier: Apache-2.0
-- Random words and selections, checked in every clock: the output is the selected word, skewed.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_multiplexer_tb is
  generic (g_folder : string := "skewed_multiplexer");
end entity;

architecture sim of skewed_multiplexer_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, parts
  constant c_sizes : sizes_t := ((40, 2), (32, 1), (7, 3));
begin
  sizes : for i in c_sizes'range generate
    signal clk         : std_logic := '0';
    signal select_b    : std_logic;
    signal a, b, value : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
    begin
      dut : entity work.skewed_multiplexer
        generic map (g_bits => c_sizes(i)(0), g_parts => c_sizes(i)(1))
        port map (clk => clk, select_b => select_b, a => a, b => b, value => value);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(select_b);
          vectors.drive(a);
          vectors.drive(b);
          settle;
          vectors.check("value", value);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "skewed_multiplexer_tb");
end architecture;
