-- SPDX-License-Identifier: Apache-2.0
-- All vectors of small widths; otherwise each shift, and random vectors. One per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity vector_shift_tb is
  generic (g_folder : string := "vector_shift");
end entity;

architecture sim of vector_shift_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  constant c_sizes : sizes_t := ((5, 5), (30, 24), (25, 24), (17, 16), (16, 24));
begin
  sizes : for i in c_sizes'range generate
    signal clk        : std_logic := '0';
    signal enable     : std_logic;
    signal components : std_logic_vector(3 * c_sizes(i)(0) - 1 downto 0);
    signal shifted    : std_logic_vector(3 * c_sizes(i)(1) - 1 downto 0);
    begin
      dut : entity work.vector_shift
        generic map (g_vector_bits => c_sizes(i)(0), g_result_bits => c_sizes(i)(1))
        port map (clk => clk, enable => enable, components => components, shifted => shifted);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt", c_vector_shift_latency);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(components);
          settle;
          vectors.check("shifted", shifted);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "vector_shift_tb");
end architecture;
