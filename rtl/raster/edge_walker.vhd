-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     An exact edge, line by line: the first pixel whose centre is on the edge or right of it, by integer quotient
--             and remainder. With dx/dy = quotient + remainder/divisor, a step adds the quotient, and one more pixel (the
--             carry) if the error is less than the remainder. The error is the pixel's distance from the edge in
--             1/divisor pixels.
--             The register `reduced` is the error of the next line minus the remainder: its sign is the result of that
--             comparison, and the carry of the next step is a register.
-- Contract    load stays '1' until a clock with step = '1'; in that clock the edge loads init
-- Formats     formats_pkg: x and quotient span_x; error, remainder and divisor edge_error
-- Latency     1 clock from a step to x and carry
-- Throughput  1 line per clock
-- Error       none
-- Source      Bresenham; the quadratic paper steps a rounded slope instead (preset published)
-- Golden twin model/golden/edge_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity edge_walker is
  port (
    clk            : in  std_logic;
    load           : in  std_logic; -- the next step loads an edge
    load_x         : in  std_logic_vector(formats(true).span_x.bits - 1 downto 0);
    load_quotient  : in  std_logic_vector(formats(true).span_x.bits - 1 downto 0);
    load_remainder : in  std_logic_vector(formats(true).edge_error.bits - 1 downto 0);
    load_divisor   : in  std_logic_vector(formats(true).edge_error.bits - 1 downto 0);
    load_error     : in  std_logic_vector(formats(true).edge_error.bits - 1 downto 0); -- after the first step
    load_carry     : in  std_logic;                                                      -- of the first step
    step           : in  std_logic; -- go to the next line
    x              : out std_logic_vector(formats(true).span_x.bits - 1 downto 0);
    carry          : out std_logic -- the next step ends one pixel further right than the quotient says
  );
end entity;

architecture rtl of edge_walker is

  subtype span_x_t  is signed(formats(true).span_x.bits - 1 downto 0);
  subtype error_t   is unsigned(formats(true).edge_error.bits - 1 downto 0);
  subtype reduced_t is unsigned(formats(true).edge_error.bits downto 0); -- two's complement

  type reg_t is record
    x         : span_x_t;
    quotient  : span_x_t;
    remainder : error_t;
    rise      : error_t; -- divisor - remainder
    reduced   : reduced_t; -- the error minus the remainder; before the first step, the error
    carry     : std_logic;
  end record;

  signal r, r_next : reg_t;

begin

  combinational : process (all)
    variable v            : reg_t;
    variable below        : std_logic; -- the error is less than the remainder
    variable next_x       : signed(span_x_t'length downto 0);
    variable increment    : reduced_t;
    variable next_reduced : unsigned(reduced_t'length downto 0);
  begin
    v := r;

    -- Add the quotient and the carry, in one sum.
    next_x := (r.x & '1') + (r.quotient & r.carry);

    -- Subtract the remainder from the error; add the divisor if the error is less than it.
    below     := r.reduced(r.reduced'high);
    increment := '1' & not r.remainder;
    if below = '1' then
      increment := '0' & r.rise;
    end if;
    next_reduced := (r.reduced & '1') + (increment & not below);

    -- Load the increments while load = '1', also before the step: the previous edge does not step again.
    if load = '1' then
      v.quotient  := signed(load_quotient);
      v.remainder := unsigned(load_remainder);
      v.rise      := unsigned(load_divisor) - unsigned(load_remainder);
    end if;

    -- Go to the next line.
    if step = '1' then
      v.x       := next_x(next_x'high downto 1);
      v.reduced := next_reduced(next_reduced'high downto 1);
      v.carry   := next_reduced(next_reduced'high);
      if load = '1' then
        v.x       := signed(load_x);
        v.reduced := '0' & unsigned(load_error);
        v.carry   := load_carry;
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

  x     <= std_logic_vector(r.x);
  carry <= r.carry;

end architecture;
