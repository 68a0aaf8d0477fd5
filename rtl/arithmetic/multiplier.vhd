-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Product of two unsigned words, a clock later.
-- Formats     a: g_a_bits, b: g_b_bits, product: as many as both together
-- Latency     1 clock from operands with enable to their product
-- Throughput  1 product a clock
-- Error       none
-- Source      spherical paper, figure 12
-- Golden twin model/golden/multiplier.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity multiplier is
  generic (
    g_a_bits : positive;
    g_b_bits : positive
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    a       : in  std_logic_vector(g_a_bits - 1 downto 0);
    b       : in  std_logic_vector(g_b_bits - 1 downto 0);
    product : out std_logic_vector(g_a_bits + g_b_bits - 1 downto 0)
  );
end entity;

architecture rtl of multiplier is

  type reg_t is record
    product : unsigned(g_a_bits + g_b_bits - 1 downto 0);
  end record;

  signal r : reg_t;

begin

  registers : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        r.product <= unsigned(a) * unsigned(b);
      end if;
    end if;
  end process;

  product <= std_logic_vector(r.product);

end architecture;
