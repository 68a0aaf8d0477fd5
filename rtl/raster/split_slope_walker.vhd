-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     An edge by its real slope, line by line, as slope_walker, with the fraction in two halves: the upper one runs a
--             line ahead of x, the lower one two, so that what either carries is a register and no sum is longer than x's.
--             g_complement: x comes as its complement, each bit a register's, so that who subtracts it need only add.
-- Contract    load = '1' stays until step is; where both are, the edge is taken, and the lower halves of load_x's and
--             load_slope's fractions have stood still since the clock before: their first step is taken from there
-- Formats     formats_pkg, preset published: edge_x, and x span_x; sums wrap
-- Latency     1 clock from a step to x
-- Throughput  1 line a clock
-- Error       none of its own; k steps carry k times the slope's rounding
-- Source      quadratic paper, section 5 and figure 6 (X counter); ours
-- Golden twin model/golden/slope_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity split_slope_walker is
  generic (
    g_complement : boolean := false
  );
  port (
    clk        : in  std_logic;
    load       : in  std_logic; -- take another edge in place of the next step
    load_x     : in  std_logic_vector(c_published_formats.edge_x.bits - 1 downto 0);
    load_slope : in  std_logic_vector(c_published_formats.edge_x.bits - 1 downto 0);
    step       : in  std_logic;
    x          : out std_logic_vector(c_published_formats.span_x.bits - 1 downto 0)
  );
end entity;

architecture rtl of split_slope_walker is

  constant c_fraction : positive := c_published_formats.edge_x.fraction;
  constant c_low      : positive := c_fraction / 2; -- bits of the lower half
  constant c_high     : natural  := c_published_formats.edge_x.bits - 1;

  subtype span_x_t is unsigned(c_published_formats.span_x.bits - 1 downto 0);
  subtype low_t    is unsigned(c_low - 1 downto 0);
  subtype high_t   is unsigned(c_fraction - c_low - 1 downto 0);

  type reg_t is record
    x           : span_x_t;
    whole       : span_x_t; -- of the slope
    carry       : std_logic; -- of the step to the next line's x
    part_high   : high_t; -- of the slope's fraction
    high        : high_t; -- of the next line's x
    high_carry  : std_logic; -- from the lower half, when high steps
    part_low    : low_t;
    low         : low_t; -- of x two lines on
    first_low   : low_t; -- what is offered: of its second line's x
    first_carry : std_logic;
  end record;

  signal r, r_next : reg_t;

  -- As x, whole and carry stand in their registers: the complement of a sum is the sum of complements and of the carry's.
  function held (word : std_logic_vector) return span_x_t is
  begin
    if g_complement then
      return unsigned(not word);
    end if;
    return unsigned(word);
  end function;

begin

  assert c_high - c_fraction + 1 = span_x_t'length
    report "split_slope_walker: edge_x has " & integer'image(c_high - c_fraction + 1) & " whole bits, span_x "
    & integer'image(span_x_t'length)
    severity failure;

  combinational : process (all)
    variable v                : reg_t;
    variable x_low, slope_low : low_t; -- of what is offered
    variable low, part_low    : low_t;
    variable high, part_high  : high_t;
    variable high_carry       : std_logic;
    variable next_low         : unsigned(low_t'length downto 0);
    variable next_high        : unsigned(high_t'length + 1 downto 0);
    variable next_carry       : std_logic;
    variable next_x           : unsigned(span_x_t'length downto 0);
  begin
    v         := r;
    next_x    := (r.x & '1') + (r.whole & r.carry); -- one sum takes the carry
    x_low     := unsigned(load_x(c_low - 1 downto 0));
    slope_low := unsigned(load_slope(c_low - 1 downto 0));

    next_low      := ('0' & x_low) + ('0' & slope_low);
    v.first_low   := next_low(c_low - 1 downto 0);
    v.first_carry := next_low(c_low);

    -- Chosen in front of the sums: a load has its own first steps.
    low        := r.low;
    part_low   := r.part_low;
    high       := r.high;
    part_high  := r.part_high;
    high_carry := r.high_carry;
    if load = '1' then
      low        := r.first_low;
      part_low   := slope_low;
      high       := unsigned(load_x(c_fraction - 1 downto c_low));
      part_high  := unsigned(load_slope(c_fraction - 1 downto c_low));
      high_carry := r.first_carry;
    end if;
    -- The highest bit cancels: so a cell of the sum's own, and none behind it, gives what is carried.
    next_low   := (low(low_t'high) & low) + ('0' & part_low);
    next_high  := (high(high_t'high) & high & '1') + ('0' & part_high & high_carry);
    next_carry := next_high(next_high'high) xor high(high_t'high);

    -- What the steps add is taken while load waits for its step: no sum of the edge before is wanted then.
    if load = '1' then
      v.whole     := held(load_slope(c_high downto c_fraction));
      v.part_high := part_high;
      v.part_low  := part_low;
    end if;
    if step = '1' then
      v.x          := next_x(next_x'high downto 1);
      v.high       := next_high(high_t'length downto 1);
      v.low        := next_low(low_t'range);
      v.high_carry := next_low(next_low'high) xor low(low_t'high);
      v.carry      := next_carry;
      if g_complement then
        v.carry := not next_carry;
      end if;
      if load = '1' then
        v.x := held(load_x(c_high downto c_fraction));
      end if;
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  x <= std_logic_vector(r.x);

end architecture;
