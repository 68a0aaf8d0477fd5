-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Converts a signed fixed-point value to an unsigned integer of fewer bits: values below zero give zero, values
--             above the largest result give the largest, all others lose their fraction. The start value contains
--             the 0.5 that turns this into rounding.
-- Formats     value: signed, g_value_bits with g_fraction_bits of fraction; result: unsigned, g_result_bits
-- Latency     0 (combinational)
-- Throughput  1 result per clock
-- Error       inside the range, the result is 0 to 1 (exclusive) below the value
-- Source      quadratic paper, section 5 (0.5 is added, then the fraction is dropped); that the start value has the 0.5 is
--             ours
-- Golden twin model/golden/saturate.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity saturate is
  generic (
    g_value_bits    : positive;
    g_fraction_bits : natural;
    g_result_bits   : positive
  );
  port (
    value  : in  std_logic_vector(g_value_bits - 1 downto 0);
    result : out std_logic_vector(g_result_bits - 1 downto 0)
  );
end entity;

architecture rtl of saturate is

  constant c_result_high : natural := g_fraction_bits + g_result_bits - 1;
  constant c_sign        : natural := g_value_bits - 1;

  signal above : std_logic_vector(c_sign - c_result_high - 1 downto 0);

begin

  assert g_value_bits >= g_fraction_bits + g_result_bits + 2
    report "saturate: " & integer'image(g_value_bits) & " bits have no bit above the result's "
    & integer'image(g_result_bits) & " and the fraction's " & integer'image(g_fraction_bits)
    severity failure;

  above <= value(c_sign - 1 downto c_result_high + 1) & '0';

  select_result : process (all)
  begin
    if value(c_sign) = '1' then
      result <= (others => '0');
    elsif not (unsigned(above) = 0) then
      result <= (others => '1');
    else
      result <= value(c_result_high downto g_fraction_bits);
    end if;
  end process;

end architecture;
