-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Both edges of a triangle at one line, and the pixels between them. The start edge is the side from which
--             spans run.
--             preset exact: the start edge is the triangle's long one, the stop edge has an upper and a lower section.
--             preset published: both edges are one line of real slope, and spans are inclusive at both ends.
-- Contract    load or section_change stays '1' until a clock with step = '1'. In that clock, with load, both edges load
--             init; with section_change, the stop edge loads its lower section. load has priority.
-- Formats     formats_pkg: the header of init; start and stop span_x
-- Latency     1 clock from step
-- Throughput  1 line per clock
-- Error       preset exact: none. preset published: that of slope_walker
-- Source      quadratic paper, section 5 and figure 6 (X_start, X_end)
-- Golden twin model/golden/edge_pair.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;

entity edge_pair is
  generic (
    g_exact : boolean := true
  );
  port (
    clk            : in  std_logic;
    init           : in  std_logic_vector(init_bits(g_exact, 0) - 1 downto 0);
    load           : in  std_logic; -- the next line is the first of init
    section_change : in  std_logic; -- the next line is the first of the lower section
    step           : in  std_logic; -- go to the next line
    start          : out span_x_t;
    stop           : out span_x_t; -- exclusive
    remaining      : out pixels_t; -- pixels after the one at start; undefined in an empty line
    empty          : out std_logic;
    backward       : out std_logic; -- spans run to smaller x
    carry          : out std_logic -- the start edge's next step ends one pixel further right than its quotient says
  );
end entity;

architecture rtl of edge_pair is

  constant c_init : init_header_t := init_header(g_exact);

  signal not_from, to_x   : signed(span_x_t'length downto 0); -- not_from: the complement
  signal remaining_pixels : signed(span_x_t'length downto 0);

begin

  exact_edges : if g_exact generate

    -- A section of an edge, as init holds it.
    type edge_t is record
      x         : std_logic_vector(span_x_t'range);
      quotient  : std_logic_vector(span_x_t'range);
      remainder : std_logic_vector(formats(true).edge_error.bits - 1 downto 0);
      divisor   : std_logic_vector(formats(true).edge_error.bits - 1 downto 0);
      error     : std_logic_vector(formats(true).edge_error.bits - 1 downto 0);
      carry     : std_logic;
    end record;

    type reg_t is record
      lower    : edge_t; -- the stop edge's lower section
      backward : std_logic;
    end record;

    signal r, r_next                                  : reg_t;
    signal init_start, init_upper, init_lower, section : edge_t;
    signal load_stop                                   : std_logic;
    signal start_x, stop_x                             : std_logic_vector(span_x_t'range);

  begin

    init_start <= (
      x         => init(c_init.start_x.high downto c_init.start_x.low),
      quotient  => init(c_init.start_quotient.high downto c_init.start_quotient.low),
      remainder => init(c_init.start_remainder.high downto c_init.start_remainder.low),
      divisor   => init(c_init.start_divisor.high downto c_init.start_divisor.low),
      error     => init(c_init.start_error.high downto c_init.start_error.low),
      carry     => init(c_init.start_carry.low));

    init_upper <= (
      x         => init(c_init.upper_x.high downto c_init.upper_x.low),
      quotient  => init(c_init.upper_quotient.high downto c_init.upper_quotient.low),
      remainder => init(c_init.upper_remainder.high downto c_init.upper_remainder.low),
      divisor   => init(c_init.upper_divisor.high downto c_init.upper_divisor.low),
      error     => init(c_init.upper_error.high downto c_init.upper_error.low),
      carry     => init(c_init.upper_carry.low));

    init_lower <= (
      x         => init(c_init.lower_x.high downto c_init.lower_x.low),
      quotient  => init(c_init.lower_quotient.high downto c_init.lower_quotient.low),
      remainder => init(c_init.lower_remainder.high downto c_init.lower_remainder.low),
      divisor   => init(c_init.lower_divisor.high downto c_init.lower_divisor.low),
      error     => init(c_init.lower_error.high downto c_init.lower_error.low),
      carry     => init(c_init.lower_carry.low));

    combinational : process (all)
      variable v : reg_t;
    begin
      v := r;
      -- Hold the lower section until the upper one ends.
      if load = '1' then
        v.lower := init_lower;
      end if;
      -- Take the direction with the first line.
      if load = '1' and step = '1' then
        v.backward := init(c_init.backward.low);
      end if;
      r_next <= v;
    end process;

    registers : process (clk)
    begin
      if rising_edge(clk) then
        r <= r_next;
      end if;
    end process;

    load_stop <= load or section_change;
    section   <= init_upper when load = '1' else r.lower;

    start_edge : entity work.edge_walker
      port map (
        clk            => clk,
        load           => load,
        load_x         => init_start.x,
        load_quotient  => init_start.quotient,
        load_remainder => init_start.remainder,
        load_divisor   => init_start.divisor,
        load_error     => init_start.error,
        load_carry     => init_start.carry,
        step           => step,
        x              => start_x,
        carry          => carry
        );

    stop_edge : entity work.edge_walker
      port map (
        clk            => clk,
        load           => load_stop,
        load_x         => section.x,
        load_quotient  => section.quotient,
        load_remainder => section.remainder,
        load_divisor   => section.divisor,
        load_error     => section.error,
        load_carry     => section.carry,
        step           => step,
        x              => stop_x,
        carry          => open
        );

    start    <= signed(start_x);
    stop     <= signed(stop_x);
    backward <= r.backward;

    to_x     <= resize(start, to_x'length) when r.backward = '1' else resize(stop, to_x'length);
    not_from <= not resize(stop, to_x'length) when r.backward = '1' else not resize(start, to_x'length);

  else generate

    subtype edge_x_t is unsigned(formats(false).edge_x.bits - 1 downto 0);

    constant c_one_pixel : edge_x_t := shift_left(to_unsigned(1, edge_x_t'length), formats(false).edge_x.fraction);

    signal exclusive_x         : edge_x_t; -- the stop edge's first pixel that is not in the span
    signal not_start_x, stop_x : std_logic_vector(span_x_t'range);

  begin

    exclusive_x <= unsigned(init(c_init.upper_x.high downto c_init.upper_x.low)) + c_one_pixel;

    start_edge : entity work.slope_walker
      generic map (
        g_complement => true
        )
      port map (
        clk        => clk,
        load       => load,
        load_x     => init(c_init.start_x.high downto c_init.start_x.low),
        load_slope => init(c_init.start_slope.high downto c_init.start_slope.low),
        step       => step,
        x          => not_start_x
        );

    stop_edge : entity work.slope_walker
      port map (
        clk        => clk,
        load       => load,
        load_x     => std_logic_vector(exclusive_x),
        load_slope => init(c_init.upper_slope.high downto c_init.upper_slope.low),
        step       => step,
        x          => stop_x
        );

    start    <= signed(not not_start_x);
    stop     <= signed(stop_x);
    backward <= '0';
    carry    <= '0';

    to_x     <= resize(stop, to_x'length);
    not_from <= resize(signed(not_start_x), to_x'length);

  end generate;

  -- Count the pixels after the first: to_x - from_x - 1, below zero in an empty line.
  remaining_pixels <= to_x + not_from;

  remaining <= unsigned(remaining_pixels(pixels_t'range));
  empty     <= remaining_pixels(remaining_pixels'high);

end architecture;
