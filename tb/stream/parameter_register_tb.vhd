-- SPDX-License-Identifier: Apache-2.0
-- Random loads and waits. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity parameter_register_tb is
  generic (g_folder : string := "parameter_register");
end entity;

architecture sim of parameter_register_tb is
  -- one bit, an intensity, a section of an edge
  constant c_bits : integer_vector := (1, 40, 83);
begin
  widths : for i in c_bits'range generate
    signal clk          : std_logic := '0';
    signal load         : std_logic;
    signal start, value : std_logic_vector(c_bits(i) - 1 downto 0);
    begin
      dut : entity work.parameter_register
        generic map (g_bits => c_bits(i))
        port map (clk => clk, load => load, start => start, value => value);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_bits(i)) & ".txt");
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

  report_end(finished, "parameter_register_tb");
end architecture;
