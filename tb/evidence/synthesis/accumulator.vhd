-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A single sum as wide as a shader's. Its clock is the upper limit for every design with such a sum on the
--             device. `make synth` measures it with the shaders; it is no part of the hardware.
-- Formats     g_bits of two's complement; the sum wraps
-- Latency     1 clock from step to value
-- Throughput  1 step per clock

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity accumulator is
  generic (
    g_bits : positive
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    value     : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of accumulator is

  signal sum : signed(g_bits - 1 downto 0);

begin

  registers : process (clk)
  begin
    if rising_edge(clk) then
      sum <= sum + signed(increment);
      if reset = '1' then
        sum <= (others => '0');
      end if;
    end if;
  end process;

  value <= std_logic_vector(sum);

end architecture;
