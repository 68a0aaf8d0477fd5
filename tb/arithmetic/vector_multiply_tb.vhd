-- SPDX-License-Identifier: Apache-2.0
-- Random and extreme vectors in several widths: one product per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity vector_multiply_tb is
  generic (g_folder : string := "vector_multiply");
end entity;

architecture sim of vector_multiply_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  constant c_sizes : sizes_t := ((2, 5), (16, 11), (24, 26), (28, 30), (13, 26));
begin
  sizes : for i in c_sizes'range generate
    signal clk      : std_logic := '0';
    signal enable   : std_logic;
    signal a        : std_logic_vector(3 * c_sizes(i)(0) - 1 downto 0);
    signal b        : std_logic_vector(3 * c_sizes(i)(1) - 1 downto 0);
    signal products : std_logic_vector(a'length + b'length - 1 downto 0);
    begin
      dut : entity work.vector_multiply
        generic map (g_a_bits => c_sizes(i)(0), g_b_bits => c_sizes(i)(1))
        port map (clk => clk, enable => enable, a => a, b => b, products => products);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt", c_vector_multiply_latency);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(a);
          vectors.drive(b);
          settle;
          vectors.check("products", products);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "vector_multiply_tb");
end architecture;
