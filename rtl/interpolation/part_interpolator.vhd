-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One part of a skewed_interpolator: takes its bits of a start value, then adds its bits of an increment per step,
--             with the carry of the part below.
-- Contract    load and step are never both '1'. carry_in is the carry_out of the part below, whose step was one clock earlier;
--             of the lowest part it is '0'
-- Formats     g_bits throughout; the sum of all parts wraps
-- Latency     1 clock from load or step to value and carry_out
-- Throughput  1 step per clock
-- Error       adds none: k steps carry k times the increment's rounding
-- Source      line_interpolator; the cut is ours
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
    load      : in  std_logic; -- not with step
    start     : in  std_logic_vector(g_bits - 1 downto 0);
    step      : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    carry_in  : in  std_logic;
    value     : out std_logic_vector(g_bits - 1 downto 0);
    carry_out : out std_logic -- of the last step; '0' after a load
  );
end entity;

architecture rtl of part_interpolator is

  subtype part_t is std_logic_vector(g_bits - 1 downto 0);

  -- The carry out and the sum.
  function sum_of (word, addend : part_t; carry : std_logic) return std_logic_vector is
    variable whole : unsigned(g_bits + 1 downto 0);
  begin
    -- Add the carry in a bit below the word: one carry chain does both. Critical path: extend the word by its own
    -- highest bit, which is subtracted again, so that the last cell of the chain gives the carry out.
    whole := (word(g_bits - 1) & unsigned(word) & '1') + ('0' & unsigned(addend) & carry);
    return (whole(g_bits + 1) xor word(g_bits - 1)) & std_logic_vector(whole(g_bits downto 1));
  end function;

begin

  -- One clocked process, as in line_interpolator.
  registers : process (clk)
    variable addend : part_t;
    variable sum    : std_logic_vector(g_bits downto 0);
  begin
    if rising_edge(clk) then
      if load = '1' or step = '1' then
        -- Select before the adder: the adder's cells then hold the choice between sum and start, too.
        addend := start;
        if step = '1' then
          addend := increment;
        end if;
        sum := sum_of(value, addend, carry_in);
        -- Gate the carry instead of resetting its register, which would take one more cell.
        carry_out <= sum(g_bits) and not load;
        value     <= sum(g_bits - 1 downto 0);
        if load = '1' then
          value <= addend;
        end if;
      end if;
    end if;
  end process;

end architecture;
