-- SPDX-License-Identifier: Apache-2.0
-- Random and extreme vectors and squares of vectors, in several widths: one sum per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity dot_product_tb is
  generic (g_folder : string := "dot_product");
end entity;

architecture sim of dot_product_tb is
  constant c_bits : integer_vector := (4, 16, 24, 30);
begin
  widths : for i in c_bits'range generate
    signal clk    : std_logic := '0';
    signal enable : std_logic;
    signal a, b   : std_logic_vector(3 * c_bits(i) - 1 downto 0);
    signal sum    : std_logic_vector(2 * c_bits(i) downto 0);
    begin
      dut : entity work.dot_product
        generic map (g_bits => c_bits(i))
        port map (clk => clk, enable => enable, a => a, b => b, sum => sum);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_bits(i)) & ".txt", c_dot_product_latency);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(a);
          vectors.drive(b);
          settle;
          vectors.check("sum", sum);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "dot_product_tb");
end architecture;
