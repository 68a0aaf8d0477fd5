-- SPDX-License-Identifier: Apache-2.0
-- One term and several. All values of small widths; otherwise all terms at their maximum, sums around the largest
-- result, and random and extreme words.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity saturating_sum_tb is
  generic (g_folder : string := "saturating_sum");
end entity;

architecture sim of saturating_sum_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 3);

  -- terms, term, fraction and result bits
  constant c_sizes : sizes_t := ((1, 16, 4, 8), (2, 8, 2, 6), (2, 6, 0, 6), (3, 5, 1, 4), (5, 3, 0, 4), (3, 24, 14, 8),
    (33, 26, 16, 8), (33, 32, 16, 8), (3, 36, 20, 8));
begin
  sizes : for i in c_sizes'range generate
    constant c_size : integer_vector(0 to 3) := c_sizes(i);

    signal clk    : std_logic := '0';
    signal enable : std_logic;
    signal terms  : std_logic_vector(c_size(0) * c_size(1) - 1 downto 0);
    signal result : std_logic_vector(c_size(3) - 1 downto 0);
    begin
      dut : entity work.saturating_sum
        generic map (
          g_terms         => c_size(0),
          g_term_bits     => c_size(1),
          g_fraction_bits => c_size(2),
          g_result_bits   => c_size(3))
        port map (clk => clk, enable => enable, terms => terms, result => result);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_size) & ".txt", 1);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(terms);
          settle;
          vectors.check("result", result);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "saturating_sum_tb");
end architecture;
