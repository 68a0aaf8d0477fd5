-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A line_interpolator's word, or a part of one: a word cut into parts, each a clock behind the part below it, so
--             that no sum is longer than a part.
-- Contract    a part takes load and step, and its bits of start and increment, a clock after the part below it, whose
--             carry_out is its carry_in; the lowest one's is '0'
-- Formats     g_bits throughout; the sum of all parts wraps
-- Latency     1 clock from load or step to value and carry_out
-- Throughput  1 step a clock
-- Error       none of its own; k steps carry k times the increment's rounding
-- Source      line_interpolator; ours
-- Golden twin model/golden/part_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity part_interpolator is
  generic (
    g_bits : positive
  );
  port (
    clk       : in  std_logic;
    load      : in  std_logic; -- wins over step
    start     : in  std_logic_vector(g_bits - 1 downto 0);
    step      : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    carry_in  : in  std_logic;
    value     : out std_logic_vector(g_bits - 1 downto 0);
    carry_out : out std_logic -- of the last step, '0' behind a load
  );
end entity;

architecture rtl of part_interpolator is

  type reg_t is record
    value : unsigned(g_bits - 1 downto 0);
    carry : std_logic;
  end record;

  signal r : reg_t;

begin

  -- One clocked process, as in line_interpolator. The carry comes in through a bit below, so that one sum takes it.
  registers : process (clk)
    variable sum : unsigned(g_bits + 1 downto 0);
  begin
    if rising_edge(clk) then
      if load = '1' then
        r.value <= unsigned(start);
        r.carry <= '0'; -- nobody asks; so that neither register changes but where the part loads or steps
      elsif step = '1' then
        -- The highest bit cancels: so a cell of the sum's own, and none behind it, gives what is carried.
        sum := (r.value(g_bits - 1) & r.value & '1') + ('0' & unsigned(increment) & carry_in);
        r.value <= sum(g_bits downto 1);
        r.carry <= sum(g_bits + 1) xor r.value(g_bits - 1);
      end if;
    end if;
  end process;

  value     <= std_logic_vector(r.value);
  carry_out <= r.carry;

end architecture;
