-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A line_interpolator's word, or a part of one: a word cut into parts, each a clock behind the part below it, so
--             that no sum is longer than a part.
-- Contract    a part takes load and step, and its bits of start and increment, a clock after the part below it, whose
--             carry_out is its carry_in; the lowest one's is '0'. load and step are never both '1'
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
    load      : in  std_logic; -- not with step
    start     : in  std_logic_vector(g_bits - 1 downto 0);
    step      : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    carry_in  : in  std_logic;
    value     : out std_logic_vector(g_bits - 1 downto 0);
    carry_out : out std_logic -- of the last step, '0' behind a load
  );
end entity;

architecture rtl of part_interpolator is

  subtype part_t is std_logic_vector(g_bits - 1 downto 0);

  -- What is carried, and the part.
  function sum_of (word, addend : part_t; carry : std_logic) return std_logic_vector is
    variable whole : unsigned(g_bits + 1 downto 0);
  begin
    -- The carry comes in through a bit below, so that one sum takes it. The highest bit cancels: so a cell of the sum's
    -- own, and none behind it, gives what is carried.
    whole := (word(g_bits - 1) & unsigned(word) & '1') + ('0' & unsigned(addend) & carry);
    return (whole(g_bits + 1) xor word(g_bits - 1)) & std_logic_vector(whole(g_bits downto 1));
  end function;

begin

  -- One clocked process, as in line_interpolator, and the ports are the registers: a copy would cost a simulator as much.
  registers : process (clk)
    variable addend : part_t;
    variable sum    : std_logic_vector(g_bits downto 0);
  begin
    if rising_edge(clk) then
      if load = '1' or step = '1' then
        -- Chosen in front of the sum, so that the sum's own cells choose what comes out.
        addend := start;
        if step = '1' then
          addend := increment;
        end if;
        sum := sum_of(value, addend, carry_in);
        -- Nobody asks behind a load; so that neither register changes but where the part loads or steps. No reset of the
        -- register's own: it would not share the sum's cells.
        carry_out <= sum(g_bits) and not load;
        value     <= sum(g_bits - 1 downto 0);
        if load = '1' then
          value <= addend;
        end if;
      end if;
    end if;
  end process;

end architecture;
