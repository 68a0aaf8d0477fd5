-- SPDX-License-Identifier: Apache-2.0
-- Random strobes, checked in every clock: each part's strobe is that of the part below, one clock later.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity skewed_strobe_tb is
  generic (g_folder : string := "skewed_strobe");
end entity;

architecture sim of skewed_strobe_tb is
begin
  numbers : for parts in 1 to 3 generate
    signal clk     : std_logic := '0';
    signal strobe  : std_logic;
    signal strobes : std_logic_vector(parts - 1 downto 0);
    begin
      dut : entity work.skewed_strobe
        generic map (g_parts => parts)
        port map (clk => clk, strobe => strobe, strobes => strobes);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/1_" & to_string(parts) & ".txt");
        while vectors.next_clock loop
          vectors.drive(strobe);
          settle;
          vectors.check("strobes", strobes);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "skewed_strobe_tb");
end architecture;
