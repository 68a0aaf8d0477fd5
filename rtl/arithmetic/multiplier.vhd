-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Product of two unsigned words: both halves of a times b in one clock, their sum in the next.
-- Formats     a: g_a_bits, b: g_b_bits, product: as many as both together
-- Latency     2 clocks from operands with enable to their product
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

  -- Of a with a zero before it: no half is without a bit.
  constant c_low_bits  : positive := (g_a_bits + 1) / 2;
  constant c_high_bits : positive := g_a_bits + 1 - c_low_bits;

  type reg_t is record
    added   : std_logic; -- the halves are of new operands
    low     : unsigned(c_low_bits + g_b_bits - 1 downto 0);
    high    : unsigned(c_high_bits + g_b_bits - 1 downto 0);
    product : unsigned(g_a_bits + g_b_bits downto 0);
  end record;

  signal r : reg_t;

  signal padded : std_logic_vector(g_a_bits downto 0);

begin

  padded <= '0' & a;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r.added <= enable;
      if enable = '1' then
        r.low  <= unsigned(padded(c_low_bits - 1 downto 0)) * unsigned(b);
        r.high <= unsigned(padded(g_a_bits downto c_low_bits)) * unsigned(b);
      end if;
      if r.added = '1' then
        r.product(g_a_bits + g_b_bits downto c_low_bits) <= r.high + resize(r.low(r.low'high downto c_low_bits), r.high'length);
        r.product(c_low_bits - 1 downto 0)               <= r.low(c_low_bits - 1 downto 0);
      end if;
    end if;
  end process;

  product <= std_logic_vector(r.product(product'range));

end architecture;
