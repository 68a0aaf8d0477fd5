-- SPDX-License-Identifier: Apache-2.0
-- Random skewed words, checked in every clock: the whole word is output with its last part.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity deskew_tb is
  generic (g_folder : string := "deskew");
end entity;

architecture sim of deskew_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, parts
  constant c_sizes : sizes_t := ((40, 2), (32, 1), (7, 3));
begin
  sizes : for i in c_sizes'range generate
    signal clk          : std_logic := '0';
    signal skewed, word : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
    begin
      dut : entity work.deskew
        generic map (g_bits => c_sizes(i)(0), g_parts => c_sizes(i)(1))
        port map (clk => clk, skewed => skewed, word => word);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(skewed);
          settle;
          vectors.check("word", word);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "deskew_tb");
end architecture;
