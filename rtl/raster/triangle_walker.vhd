-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Walks one triangle after the other: lines down the start edge, pixels from the start edge to the stop
--             edge, and tells the interpolators when to load and when to step. Three stages overlap: the edge stage
--             stands one line ahead of the line stage, so that how many pixels a line covers is a register there, and
--             the line stage one ahead of the span stage, so that neither a new line nor a new triangle costs a clock,
--             and lines that cover no pixel are passed over while a span is drawn.
-- Init        preset exact: the start edge is the triangle's long one, spans run away from it (backward: to smaller x);
--             the stop edge has an upper and a lower section. preset published: a horizontal-sided triangle, both
--             edges stepped by a real slope, lines and spans inclusive at both ends.
-- Contract    init is taken where init_valid and init_ready are '1', a fragment where fragment_valid and
--             fragment_ready are; x, y and triangle stand still while a fragment waits. init stands still from
--             init_valid = '1' until it is taken. It may stand longer, until line_load: none is taken before. The line
--             stage goes on only where line_ready = '1': what the line needs beside the walker has come. line_held: it
--             holds a line.
-- Formats     formats_pkg: the header of init; x span_x, y pixel_y
-- Latency     3 clocks from init taken to the triangle's first fragment, 2 from line_load
-- Throughput  with line_ready = '1' 1 fragment a clock, within and between spans and triangles, but that a triangle takes
--             2 clocks at least; a line without a pixel costs a clock only where no span is being drawn meanwhile
-- Error       none in preset exact: a pixel belongs to the triangle by its centre, top-left rule
-- Source      quadratic paper, section 5 and figure 6 (X counter, Y counter)
-- Golden twin model/golden/triangle_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity triangle_walker is
  generic (
    g_exact : boolean := true
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    init_valid     : in  std_logic;
    init_ready     : out std_logic; -- the edge stage reads the init vector
    init           : in  std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0); -- header of the init vector
    line_ready     : in  std_logic;                                                   -- the line may go on
    line_held      : out std_logic;                                                   -- a line waits for line_ready
    line_load      : out std_logic;                                                   -- begin the triangle
    line_step      : out std_logic;                                                   -- go to the next line
    line_carry     : out std_logic;                                                   -- that step goes a pixel further
    span_load      : out std_logic;                                                   -- begin the line
    span_step      : out std_logic;                                                   -- go to the next pixel
    line_y         : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    line_start     : out std_logic_vector(formats(g_exact).span_x.bits - 1 downto 0);
    line_stop      : out std_logic_vector(formats(g_exact).span_x.bits - 1 downto 0); -- exclusive
    fragment_valid : out std_logic;
    fragment_ready : in  std_logic;
    triangle       : out std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
    y              : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    x              : out std_logic_vector(formats(g_exact).span_x.bits - 1 downto 0);
    busy           : out std_logic
  );
end entity;

architecture rtl of triangle_walker is

  constant c_formats : formats_t     := formats(g_exact);
  constant c_init    : init_header_t := init_header(g_exact);

  subtype triangle_t is std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  subtype pixel_y_t  is unsigned(c_formats.pixel_y.bits - 1 downto 0);
  subtype span_x_t   is signed(c_formats.span_x.bits - 1 downto 0);
  subtype lines_t    is unsigned(c_formats.lines.bits - 1 downto 0);

  -- What a line covers: pixels behind its first; below zero where it covers none.
  subtype more_t is signed(c_formats.span_x.bits downto 0);
  subtype rest_t is unsigned(c_formats.span_x.bits - 1 downto 0);

  type edge_stage_t is record
    valid        : std_logic;
    first        : std_logic; -- the triangle's first line
    triangle     : triangle_t;
    y            : pixel_y_t;
    lines        : lines_t; -- left in this section of the stop edge, this one included
    lower_lines  : lines_t; -- in the section below
    section_last : std_logic; -- lines = 1
    lower_none   : std_logic; -- lower_lines = 0
    last_behind  : std_logic; -- the triangle's last line, and not its first
    backward     : std_logic;
  end record;

  type line_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    start    : span_x_t;
    stop     : span_x_t;
    more     : rest_t; -- pixels behind the first
    draws    : std_logic; -- valid, and the line covers a pixel
    backward : std_logic;
    carry    : std_logic; -- of the step to the next line
  end record;

  type span_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    x        : span_x_t;
    more     : rest_t; -- pixels behind x
    backward : std_logic;
    goes_on  : std_logic; -- valid, and a pixel is behind x
    ends     : std_logic; -- valid, and none is
  end record;

  type reg_t is record
    edges : edge_stage_t;
    line  : line_stage_t;
    span  : span_stage_t;
  end record;

  signal r, r_next : reg_t;

  -- From the edges, for the line that the edge stage holds.
  signal start, stop : span_x_t;
  signal more        : more_t;
  signal empty       : std_logic;
  signal edge_carry  : std_logic;

  -- From the init vector, where the preset has them.
  signal init_upper_lines : lines_t;
  signal init_lower_lines : lines_t;
  signal init_backward    : std_logic;

  signal next_x    : span_x_t;
  signal blocked   : std_logic; -- the line that the line stage holds has to wait
  signal edge_load : std_logic; -- read the init vector
  signal edge_step : std_logic; -- hand the line on, and go to the next one
  signal edge_goes : std_logic; -- either
  signal edge_last : std_logic; -- the triangle's last line
  signal to_lower  : std_logic; -- this step enters the lower section

begin

  init_upper_lines <= unsigned(init(c_init.upper_lines.high downto c_init.upper_lines.low));

  next_x <= r.span.x - 1 when r.span.backward = '1' else r.span.x + 1;

  span_step <= r.span.valid and fragment_ready;
  blocked   <= (r.line.draws and (r.span.goes_on or (r.span.ends and not fragment_ready)))
    or (r.line.valid and not line_ready);

  span_load <= r.line.draws and not blocked;
  line_step <= r.line.valid and not blocked;

  edge_last <= r.edges.section_last and r.edges.lower_none;
  to_lower  <= r.edges.section_last and not r.edges.lower_none;
  edge_step <= r.edges.valid and not blocked;
  edge_goes <= edge_step or (init_valid and not r.edges.valid);
  line_load <= edge_step and r.edges.first;

  -- While the first line is here init may still be this triangle's.
  edge_load  <= init_valid and (not r.edges.valid or (edge_step and r.edges.last_behind));
  init_ready <= edge_load;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    if span_load = '1' then
      v.span.valid    := '1';
      v.span.triangle := r.line.triangle;
      v.span.y        := r.line.y;
      v.span.x        := r.line.start;
      v.span.more     := r.line.more;
      v.span.backward := r.line.backward;
      v.span.goes_on  := '1';
      v.span.ends     := '0';
      if r.line.more = 0 then
        v.span.goes_on := '0';
        v.span.ends    := '1';
      end if;
    elsif span_step = '1' then
      v.span.x    := next_x;
      v.span.more := r.span.more - 1;
      v.span.ends := '0';
      if r.span.more = 1 then
        v.span.goes_on := '0';
        v.span.ends    := r.span.goes_on;
      end if;
      v.span.valid := r.span.goes_on;
    end if;

    if edge_step = '1' then
      v.line.valid    := '1';
      v.line.triangle := r.edges.triangle;
      v.line.y        := r.edges.y;
      v.line.start    := start;
      v.line.stop     := stop;
      v.line.more     := unsigned(more(rest_t'range));
      v.line.draws    := not empty;
      v.line.backward := r.edges.backward;
      v.line.carry    := edge_carry;
    elsif line_step = '1' then
      v.line.valid := '0';
      v.line.draws := '0';
    end if;

    if edge_goes = '1' and edge_load = '1' then
      v.edges.valid        := '1';
      v.edges.first        := '1';
      v.edges.triangle     := init(c_init.triangle.high downto c_init.triangle.low);
      v.edges.y            := unsigned(init(c_init.y.high downto c_init.y.low));
      v.edges.lines        := init_upper_lines;
      v.edges.lower_lines  := init_lower_lines;
      v.edges.section_last := '0';
      if init_upper_lines = 1 then
        v.edges.section_last := '1';
      end if;
      v.edges.lower_none := '0';
      if init_lower_lines = 0 then
        v.edges.lower_none := '1';
      end if;
      v.edges.backward := init_backward;
    elsif edge_goes = '1' then
      v.edges.valid        := not edge_last;
      v.edges.first        := '0';
      v.edges.y            := r.edges.y + 1;
      v.edges.lines        := r.edges.lines - 1;
      v.edges.section_last := '0';
      if r.edges.lines = 2 then
        v.edges.section_last := '1';
      end if;
      if to_lower = '1' then
        v.edges.lines        := r.edges.lower_lines;
        v.edges.lower_none   := '1';
        v.edges.section_last := '0';
        if r.edges.lower_lines = 1 then
          v.edges.section_last := '1';
        end if;
      end if;
    end if;

    v.edges.last_behind := v.edges.section_last and v.edges.lower_none and not v.edges.first;

    if reset = '1' then
      v.edges.valid   := '0';
      v.line.valid   := '0';
      v.line.draws   := '0';
      v.span.valid   := '0';
      v.span.goes_on := '0';
      v.span.ends    := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  exact_edges : if g_exact generate

    -- Both sections of the stop edge are as wide, field for field.
    constant c_section_bits : positive := c_init.upper_carry.high - c_init.upper_x.low + 1;

    subtype section_t is std_logic_vector(c_section_bits - 1 downto 0);

    signal upper, lower, held_lower, section : section_t;
    signal start_x, stop_x                   : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
    signal stop_load                         : std_logic;
    signal from_x, to_x                      : more_t;

    function part (whole : section_t; field : slice_t) return std_logic_vector is
    begin
      return whole(field.high - c_init.upper_x.low downto field.low - c_init.upper_x.low);
    end function;

    begin

      init_lower_lines <= unsigned(init(c_init.lower_lines.high downto c_init.lower_lines.low));
      init_backward    <= init(c_init.backward.low);

      start_edge : entity work.edge_walker
        port map (
          clk            => clk,
          load           => edge_load,
          load_x         => init(c_init.start_x.high downto c_init.start_x.low),
          load_quotient  => init(c_init.start_quotient.high downto c_init.start_quotient.low),
          load_remainder => init(c_init.start_remainder.high downto c_init.start_remainder.low),
          load_divisor   => init(c_init.start_divisor.high downto c_init.start_divisor.low),
          load_error     => init(c_init.start_error.high downto c_init.start_error.low),
          load_carry     => init(c_init.start_carry.low),
          step           => edge_goes,
          x              => start_x,
          carry          => edge_carry
          );

      upper <= init(c_init.upper_carry.high downto c_init.upper_x.low);
      lower <= init(c_init.lower_carry.high downto c_init.lower_x.low);

      lower_section : entity work.parameter_register
        generic map (
          g_bits => c_section_bits
          )
        port map (
          clk   => clk,
          load  => edge_load,
          start => lower,
          value => held_lower
          );

        -- Where the next section waits there is no other triangle to load: edge_load comes too late to choose by it.
      section   <= held_lower when r.edges.valid = '1' and to_lower = '1' else upper;
      stop_load <= edge_load or (edge_step and to_lower);

      stop_edge : entity work.edge_walker
        port map (
          clk            => clk,
          load           => stop_load,
          load_x         => part(section, c_init.upper_x),
          load_quotient  => part(section, c_init.upper_quotient),
          load_remainder => part(section, c_init.upper_remainder),
          load_divisor   => part(section, c_init.upper_divisor),
          load_error     => part(section, c_init.upper_error),
          load_carry     => section(c_section_bits - 1),
          step           => edge_goes,
          x              => stop_x,
          carry          => open
          );

      start <= signed(start_x);
      stop  <= signed(stop_x);

      -- One pixel less than lies between them: the complement is the negative less one.
      from_x <= resize(stop, more_t'length) when r.edges.backward = '1' else resize(start, more_t'length);
      to_x   <= resize(start, more_t'length) when r.edges.backward = '1' else resize(stop, more_t'length);
      more   <= to_x + not from_x;
      empty  <= more(more'high);

  else generate

    constant c_fraction : natural := c_formats.edge_x.fraction;

    subtype edge_t is std_logic_vector(c_formats.edge_x.bits - 1 downto 0);

    signal start_x, start_slope, stop_x, stop_slope : edge_t;
    signal last                                     : span_x_t; -- pixel of the line

    constant c_highest : span_x_t := to_signed(2 ** (span_x_t'length - 1) - 1, span_x_t'length);

    begin

      assert c_formats.edge_x.bits - c_fraction = c_formats.span_x.bits
        report "triangle_walker: edge_x has " & integer'image(c_formats.edge_x.bits - c_fraction)
        & " whole bits, span_x " & integer'image(c_formats.span_x.bits)
        severity failure;

      init_lower_lines <= (others => '0');
      init_backward    <= '0';
      edge_carry       <= '0';

      start_slope_register : entity work.parameter_register
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk   => clk,
          load  => edge_load,
          start => init(c_init.start_slope.high downto c_init.start_slope.low),
          value => start_slope
          );

      start_edge : entity work.line_interpolator
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk       => clk,
          load      => edge_load,
          start     => init(c_init.start_x.high downto c_init.start_x.low),
          step      => edge_step,
          increment => start_slope,
          value     => start_x
          );

      stop_slope_register : entity work.parameter_register
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk   => clk,
          load  => edge_load,
          start => init(c_init.upper_slope.high downto c_init.upper_slope.low),
          value => stop_slope
          );

      stop_edge : entity work.line_interpolator
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk       => clk,
          load      => edge_load,
          start     => init(c_init.upper_x.high downto c_init.upper_x.low),
          step      => edge_step,
          increment => stop_slope,
          value     => stop_x
          );

      start <= signed(start_x(c_formats.edge_x.bits - 1 downto c_fraction));
      last  <= signed(stop_x(c_formats.edge_x.bits - 1 downto c_fraction));
      stop  <= last + 1;
      more  <= resize(last, more_t'length) - resize(start, more_t'length);
      -- Behind the highest pixel lies the lowest.
      empty <= '1' when more(more'high) = '1' or last = c_highest else '0';

  end generate;

  line_held  <= r.line.valid;
  line_carry <= r.line.carry;
  line_y     <= std_logic_vector(r.line.y);
  line_start <= std_logic_vector(r.line.start);
  line_stop  <= std_logic_vector(r.line.stop);

  fragment_valid <= r.span.valid;
  triangle       <= r.span.triangle;
  y              <= std_logic_vector(r.span.y);
  x              <= std_logic_vector(r.span.x);
  busy           <= r.edges.valid or r.line.valid or r.span.valid;

end architecture;
