-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A strobe for each part of a skewed word (skew_pkg): a part's strobe is that of the part below it, a clock later.
-- Formats     bit p of strobes is for part p
-- Latency     p clocks to strobes(p)
-- Throughput  1 strobe per clock
-- Error       none
-- Source      skew_pkg
-- Golden twin none: a delay

library ieee;
use ieee.std_logic_1164.all;

entity skewed_strobe is
  generic (
    g_parts : positive
  );
  port (
    clk     : in  std_logic;
    strobe  : in  std_logic;
    strobes : out std_logic_vector(g_parts - 1 downto 0)
  );
end entity;

architecture rtl of skewed_strobe is

begin

  strobes(0) <= strobe;

  delays : for part in 1 to g_parts - 1 generate

    registers : process (clk)
    begin
      if rising_edge(clk) then
        strobes(part) <= strobes(part - 1);
      end if;
    end process;

  end generate;

end architecture;
