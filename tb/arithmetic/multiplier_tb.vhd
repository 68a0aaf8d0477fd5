-- SPDX-License-Identifier: Apache-2.0
-- All operands of small widths; random and extreme operands of others. One product per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity multiplier_tb is
  generic (g_folder : string := "multiplier");
end entity;

architecture sim of multiplier_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  constant c_sizes : sizes_t := ((1, 1), (8, 8), (4, 9), (8, 18), (18, 12), (8, 24), (12, 24), (32, 32));
begin
  sizes : for i in c_sizes'range generate
    forms : for gated in boolean generate
      signal clk     : std_logic := '0';
      signal enable  : std_logic;
      signal a       : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
      signal b       : std_logic_vector(c_sizes(i)(1) - 1 downto 0);
      signal product : std_logic_vector(a'length + b'length - 1 downto 0);
      begin
        dut : entity work.multiplier
          generic map (g_a_bits => a'length, g_b_bits => b'length, g_gated => gated)
          port map (clk => clk, enable => enable, a => a, b => b, product => product);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(a);
            vectors.drive(b);
            settle;
            vectors.check("product", product);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "multiplier_tb");
end architecture;
