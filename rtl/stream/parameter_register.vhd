-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Holds words that do not change while a triangle or a line is drawn.
-- Formats     g_bits of any format
-- Latency     1 clock from load to value
-- Throughput  1 load per clock
-- Error       none
-- Source      processors paper, section 3.2 (the registers of the loading mode); spherical paper, section 4 (parameters
--             are loaded for each line)
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

  -- One clocked process with an enable, and the port is the register: wide words then cost a simulator nothing in
  -- clocks without a load.
  registers : process (clk)
  begin
    if rising_edge(clk) then
      if load = '1' then
        value <= start;
      end if;
    end if;
  end process;

end architecture;
