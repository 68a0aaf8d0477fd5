-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     An edge by its real slope, line by line: the whole part of a sum of slopes. The fraction is summed one line
--             ahead of x. Its carry into the next step is a register, so no sum is longer than the longer of both parts.
--             g_complement: x is the complement, so that its reader subtracts it without an inverter in front of the sum.
-- Contract    load stays '1' until a clock with step = '1'; in that clock the edge loads init
-- Formats     formats_pkg, preset published: edge_x, and x span_x; sums wrap
-- Latency     1 clock from a step to x
-- Throughput  1 line per clock
-- Error       adds none; k steps add k times the slope's rounding error
-- Source      quadratic paper, section 5 and figure 6 (X_start, X_end); the split of the sum is ours
-- Golden twin model/golden/slope_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity slope_walker is
  generic (
    g_complement : boolean := false
  );
  port (
    clk        : in  std_logic;
    load       : in  std_logic; -- the next step loads an edge
    load_x     : in  std_logic_vector(formats(false).edge_x.bits - 1 downto 0);
    load_slope : in  std_logic_vector(formats(false).edge_x.bits - 1 downto 0);
    step       : in  std_logic;
    x          : out std_logic_vector(formats(false).span_x.bits - 1 downto 0)
  );
end entity;

architecture rtl of slope_walker is

  constant c_fraction : natural := formats(false).edge_x.fraction;
  constant c_high     : natural := formats(false).edge_x.bits - 1;

  subtype span_x_t   is unsigned(formats(false).span_x.bits - 1 downto 0);
  subtype fraction_t is unsigned(c_fraction - 1 downto 0);

  type reg_t is record
    x        : span_x_t;
    whole    : span_x_t; -- of the slope
    part     : fraction_t;
    fraction : fraction_t; -- of the next line's x
    carry    : std_logic; -- of the step to it
  end record;

  signal r, r_next : reg_t;

  -- The form in which x, whole and carry are stored: the complement of a sum is the sum of the complements, the carry's too.
  function stored (word : std_logic_vector) return span_x_t is
  begin
    if g_complement then
      return unsigned(not word);
    end if;
    return unsigned(word);
  end function;

begin

  assert c_high - c_fraction + 1 = span_x_t'length
    report "slope_walker: edge_x has " & integer'image(c_high - c_fraction + 1) & " whole bits, span_x "
    & integer'image(span_x_t'length)
    severity failure;

  combinational : process (all)
    variable v              : reg_t;
    variable fraction, part : fraction_t;
    variable next_fraction  : unsigned(c_fraction downto 0);
    variable next_carry     : std_logic;
    variable next_x         : unsigned(span_x_t'length downto 0);
  begin
    v := r;

    -- Add the slope's whole part and the carry, in one sum.
    next_x := (r.x & '1') + (r.whole & r.carry);

    -- Add the fractions one line ahead of x. On a load, add those of the new edge.
    fraction := r.fraction;
    part     := r.part;
    if load = '1' then
      fraction := unsigned(load_x(c_fraction - 1 downto 0));
      part     := unsigned(load_slope(c_fraction - 1 downto 0));
    end if;
    -- The carry, from the sum's highest cell itself: no lookup table follows the carry chain.
    next_fraction := (fraction(fraction_t'high) & fraction) + ('0' & part);
    next_carry    := next_fraction(c_fraction) xor fraction(fraction_t'high);

    -- Load the slope while load = '1', also before the step: the previous edge does not step again.
    if load = '1' then
      v.whole := stored(load_slope(c_high downto c_fraction));
      v.part  := unsigned(load_slope(c_fraction - 1 downto 0));
    end if;

    -- Go to the next line.
    if step = '1' then
      v.x        := next_x(next_x'high downto 1);
      v.fraction := next_fraction(c_fraction - 1 downto 0);
      v.carry    := next_carry;
      if g_complement then
        v.carry := not next_carry;
      end if;
      if load = '1' then
        v.x := stored(load_x(c_high downto c_fraction));
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
