-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Holds words that stay as they are while a triangle or a line is drawn.
-- Formats     g_bits of anything
-- Latency     1 clock from load to value
-- Throughput  1 load a clock
-- Error       none: the words are held as they are
-- Source      none: the papers leave out what holds their parameters
-- Golden twin model/golden/parameter_register.hpp

library ieee;
use ieee.std_logic_1164.all;

entity parameter_register is
  generic (
    g_bits : positive
  );
  port (
    clk   : in  std_logic;
    load  : in  std_logic;
    start : in  std_logic_vector(g_bits - 1 downto 0);
    value : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of parameter_register is

begin

  -- Nothing to compute: the one clocked process is all. Its enable keeps wide words from costing a simulator anything in
  -- the clocks in which they stand still, and so does the port that is the register itself.
  registers : process (clk)
  begin
    if rising_edge(clk) then
      if load = '1' then
        value <= start;
      end if;
    end if;
  end process;

end architecture;
