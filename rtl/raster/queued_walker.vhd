-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Walks one triangle after the other, as triangle_walker does, built for the clock: between the edges and the
--             span stands a queue of two lines, so that all in front of it moves by one register, `accepts`, whatever the
--             span does; and what a sum begins with is a register wherever it can be. Four stages: the edge stage, the line
--             that is measured (how many pixels it covers is a register there), the line that waits for the span, with a
--             second place behind it, and the span.
-- Init        as triangle_walker's
-- Contract    init is taken where init_ready is '1', which it is only where init_valid is; it has stood still since the clock
--             before init_valid. A fragment is taken where fragment_valid and fragment_ready are both '1'; x, y and triangle
--             stand still while a fragment waits. line_load comes 2 clocks behind the taking or later, once for each
--             triangle, in their order; up to three are taken before it does.
-- Formats     formats_pkg: the header of init; x span_x, y pixel_y
-- Latency     4 clocks from init taken to the triangle's first fragment, 2 from line_load
-- Throughput  1 fragment a clock, within and between spans and triangles; a triangle a clock, where whoever offers them has
--             one; a line without a pixel costs a clock only where no span is being drawn meanwhile
-- Error       none in preset exact: a pixel belongs to the triangle by its centre, top-left rule
-- Source      quadratic paper, section 5 and figure 6 (X counter, Y counter)
-- Golden twin model/golden/triangle_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity queued_walker is
  generic (
    g_exact : boolean := true
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    init_valid     : in  std_logic;
    init_ready     : out std_logic; -- the edge stage takes the init vector
    init           : in  std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0); -- header of the init vector
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

architecture rtl of queued_walker is

  constant c_formats : formats_t     := formats(g_exact);
  constant c_init    : init_header_t := init_header(g_exact);

  -- Pixels of a span and lines of a section are counted in two parts, the higher one a clock behind: so the sum that a
  -- count begins with is short.
  constant c_low_pixels : positive := c_formats.span_x.bits / 2;
  constant c_low_lines  : positive := c_formats.lines.bits / 2;

  subtype triangle_t is std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  subtype pixel_y_t  is unsigned(c_formats.pixel_y.bits - 1 downto 0);
  subtype span_x_t   is signed(c_formats.span_x.bits - 1 downto 0);
  subtype lines_t    is unsigned(c_formats.lines.bits - 1 downto 0);

  subtype low_pixels_t  is unsigned(c_low_pixels - 1 downto 0);
  subtype high_pixels_t is unsigned(c_formats.span_x.bits - c_low_pixels - 1 downto 0);
  subtype low_lines_t   is unsigned(c_low_lines - 1 downto 0);
  subtype high_lines_t  is unsigned(c_formats.lines.bits - c_low_lines downto 0); -- 2**bits of them, too

  -- What a line covers: pixels behind its first; below zero where it covers none.
  subtype more_t is signed(c_formats.span_x.bits downto 0);

  -- The same where it covers one.
  subtype pixels_t is unsigned(c_formats.span_x.bits - 1 downto 0);

  -- What of an init vector is asked for before it is taken.
  type offer_t is record
    upper_none : std_logic; -- lines, counted as 2**bits, as golden
    upper_one  : std_logic;
    upper_few  : std_logic; -- the higher part of the count is zero
    lower_none : std_logic;
    lower_one  : std_logic;
    lower_few  : std_logic;
  end record;

  type edge_stage_t is record
    valid        : std_logic;
    first        : std_logic; -- the triangle's first line
    triangle     : triangle_t;
    y            : pixel_y_t;
    low          : low_lines_t; -- lines in this section of the stop edge, this one included, less three: the lower part
    below        : std_logic; -- which went below zero: the higher part has one less
    high         : high_lines_t;
    no_high      : std_logic; -- high = 0
    lower_lines  : lines_t; -- in the section below
    section_last : std_logic; -- this line is its section's last
    lower_none   : std_logic; -- lower_lines = 0
    lower_one    : std_logic; -- lower_lines = 1
    lower_few    : std_logic; -- the higher part of lower_lines is zero
    reads        : std_logic; -- the next thing here is an init vector
    leaves       : std_logic; -- reads, or the triangle ends here: the start edge takes what init has
    follows      : std_logic; -- the stop edge goes on; else it takes another section
    backward     : std_logic;
  end record;

  -- What a line is to whoever draws it.
  type place_t is record
    triangle : triangle_t;
    y        : pixel_y_t;
    start    : span_x_t;
    stop     : span_x_t;
    more     : pixels_t;
    backward : std_logic;
    carry    : std_logic; -- of the step to the next line
  end record;

  type measured_t is record
    valid  : std_logic;
    first  : std_logic;
    covers : std_logic; -- it covers a pixel, be there a line or not
    place  : place_t;
  end record;

  type line_t is record
    valid : std_logic;
    first : std_logic;
    draws : std_logic; -- here is a line, and it covers a pixel
    long  : std_logic; -- it covers two or more
    few   : std_logic; -- the higher part of more is zero
    place : place_t;
  end record;

  type span_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    x        : span_x_t;
    low      : low_pixels_t; -- pixels behind x, less two: the lower part
    below    : std_logic; -- which went below zero: the higher part has one less
    high     : high_pixels_t;
    no_high  : std_logic; -- high = 0
    ends     : std_logic; -- x is the span's last, or no span is here
    backward : std_logic;
  end record;

  type reg_t is record
    clears   : std_logic; -- reset was '1' in the clock before
    accepts  : std_logic; -- the second place is free: the edge stage and what is measured go on
    offer    : offer_t;
    edges    : edge_stage_t;
    measured : measured_t;
    second   : line_t; -- behind line
    line     : line_t;
    span     : span_stage_t;
  end record;

  signal r, r_next : reg_t;

  -- From the edges, for the line that the edge stage holds.
  signal start, stop : span_x_t;
  signal more        : more_t;
  signal edge_carry  : std_logic;

  -- From the init vector, where the preset has them.
  signal init_upper_lines : lines_t;
  signal init_lower_lines : lines_t;
  signal init_backward    : std_logic;

  signal moves      : std_logic; -- the line that waits goes, or there is none
  signal edge_reads : std_logic; -- the edge stage goes, and what comes is an init vector, or nothing
  signal edge_load  : std_logic; -- an init vector comes
  signal turns      : std_logic; -- the stop edge takes another section

begin

  init_upper_lines <= unsigned(init(c_init.upper_lines.high downto c_init.upper_lines.low));

  -- A lookup table of registers' outputs each.
  moves     <= (fragment_ready and (r.span.ends or not r.line.draws)) or not r.line.valid;
  line_step <= fragment_ready and (r.span.ends or not r.line.draws) and r.line.valid;
  span_load <= fragment_ready and r.span.ends and r.line.draws;
  span_step <= fragment_ready and r.span.valid;

  -- A triangle begins where its first line comes to wait for the span.
  line_load <= moves and ((r.second.valid and r.second.first)
    or (r.accepts and r.measured.valid and r.measured.first and not r.second.valid));

  turns      <= not r.edges.follows;
  edge_reads <= r.accepts and r.edges.reads;
  edge_load  <= init_valid and edge_reads and not r.clears;
  init_ready <= edge_load;

  combinational : process (all)
    variable v            : reg_t;
    variable last         : std_logic; -- the next pixel is its span's, or none comes
    variable pixels       : unsigned(low_pixels_t'length downto 0);
    variable fewer_pixels : unsigned(low_pixels_t'length downto 0); -- a pixel less, or two where they are counted anew
    variable comes        : std_logic; -- what was measured goes on
    variable taken        : line_t;
    variable lines        : unsigned(low_lines_t'length downto 0);
    variable fewer_lines  : unsigned(low_lines_t'length downto 0); -- a line less, or three where they are counted anew
    variable section_ends : std_logic; -- the next line is its section's last
    variable holds        : std_logic; -- the edge stage does, where it goes
  begin
    v := r;

    -- The span. Behind its last pixel comes what waits, be it a line or not.
    last            := r.span.below and r.span.no_high;
    pixels          := '0' & r.span.low;
    fewer_pixels    := (others => '1');
    fewer_pixels(0) := not r.span.ends;
    if r.span.ends = '1' then
      last   := not r.line.long;
      pixels := '0' & r.line.place.more(low_pixels_t'range);
    end if;
    pixels := pixels + fewer_pixels;
    if fragment_ready = '1' then
      if r.span.backward = '1' then
        v.span.x := r.span.x - 1;
      else
        v.span.x := r.span.x + 1;
      end if;
      v.span.low     := pixels(low_pixels_t'range);
      v.span.below   := pixels(pixels'high);
      v.span.no_high := '0';
      if r.span.high = 0 then
        v.span.no_high := '1';
      end if;
      if r.span.below = '1' then
        v.span.high := r.span.high - 1;
      end if;
      if r.span.ends = '1' then
        v.span.triangle := r.line.place.triangle;
        v.span.y        := r.line.place.y;
        v.span.x        := r.line.place.start;
        v.span.backward := r.line.place.backward;
        v.span.high     := r.line.place.more(pixels_t'high downto c_low_pixels);
        v.span.no_high  := r.line.few;
      end if;
    end if;

    -- The line that waits, and the second place. Nothing is measured where nothing is accepted.
    comes := r.measured.valid and r.accepts;
    taken := (
      valid => comes,
      first => r.measured.first,
      draws => r.measured.covers and comes,
      long  => '0',
      few   => '0',
      place => r.measured.place
    );
    if r.measured.place.more /= 0 then
      taken.long := taken.draws;
    end if;
    if r.measured.place.more(pixels_t'high downto c_low_pixels) = 0 then
      taken.few := '1';
    end if;
    if r.accepts = '1' then
      v.second := taken;
    end if;
    if moves = '1' then
      v.line := taken;
      if r.second.valid = '1' then
        v.line := r.second;
      end if;
    end if;

    -- The line that is measured.
    if r.accepts = '1' then
      v.measured.first          := r.edges.first;
      v.measured.covers         := not more(more_t'high);
      v.measured.place.triangle := r.edges.triangle;
      v.measured.place.y        := r.edges.y;
      v.measured.place.start    := start;
      v.measured.place.stop     := stop;
      v.measured.place.more     := unsigned(more(pixels_t'range));
      v.measured.place.backward := r.edges.backward;
      v.measured.place.carry    := edge_carry;
    end if;

    -- What is offered has stood still for a clock when it is taken: so this is known a clock ahead.
    v.offer := (others => '0');
    if init_upper_lines = 0 then
      v.offer.upper_none := '1';
    end if;
    if init_upper_lines = 1 then
      v.offer.upper_one := '1';
    end if;
    if init_upper_lines(lines_t'high downto c_low_lines) = 0 and init_upper_lines /= 0 then
      v.offer.upper_few := '1';
    end if;
    if init_lower_lines = 0 then
      v.offer.lower_none := '1';
    end if;
    if init_lower_lines = 1 then
      v.offer.lower_one := '1';
    end if;
    if init_lower_lines(lines_t'high downto c_low_lines) = 0 then
      v.offer.lower_few := '1';
    end if;

    -- The edge stage. Lines are counted so that a sign says that one is behind this, or none.
    lines := '0' & r.edges.low;
    if r.edges.reads = '1' then
      lines := '0' & init_upper_lines(low_lines_t'range);
    elsif r.edges.section_last = '1' then
      lines := '0' & r.edges.lower_lines(low_lines_t'range);
    end if;
    fewer_lines    := (others => '1');
    fewer_lines(1) := r.edges.follows;
    lines          := lines + fewer_lines;
    section_ends   := r.edges.below and r.edges.no_high;
    if r.accepts = '1' then
      v.edges.low     := lines(low_lines_t'range);
      v.edges.below   := lines(lines'high);
      v.edges.no_high := '0';
      if r.edges.high = 0 then
        v.edges.no_high := '1';
      end if;
      if r.edges.below = '1' then
        v.edges.high := r.edges.high - 1;
      end if;
      v.edges.first := r.edges.reads;
      if r.edges.reads = '1' then
        v.edges.high         := r.offer.upper_none & init_upper_lines(lines_t'high downto c_low_lines);
        v.edges.no_high      := r.offer.upper_few;
        v.edges.y            := unsigned(init(c_init.y.high downto c_init.y.low));
        v.edges.section_last := r.offer.upper_one;
        v.edges.lower_none   := r.offer.lower_none;
        v.edges.lower_one    := r.offer.lower_one;
        v.edges.lower_few    := r.offer.lower_few;
        v.edges.reads        := not init_valid or (r.offer.upper_one and r.offer.lower_none);
      else
        v.edges.y            := r.edges.y + 1;
        v.edges.section_last := section_ends;
        v.edges.reads        := r.edges.lower_none and section_ends;
        if r.edges.section_last = '1' then
          v.edges.high         := '0' & r.edges.lower_lines(lines_t'high downto c_low_lines);
          v.edges.no_high      := r.edges.lower_few;
          v.edges.section_last := r.edges.lower_one;
          v.edges.lower_none   := '1';
          v.edges.reads        := r.edges.lower_none or r.edges.lower_one;
        end if;
      end if;
      v.edges.leaves  := v.edges.reads or (v.edges.section_last and v.edges.lower_none);
      v.edges.follows := not (v.edges.reads or v.edges.section_last);
    end if;
    if edge_reads = '1' then
      v.edges.triangle    := init(c_init.triangle.high downto c_init.triangle.low);
      v.edges.lower_lines := init_lower_lines;
      v.edges.backward    := init_backward;
    end if;
    holds := not (r.edges.section_last and r.edges.lower_none);
    if r.edges.reads = '1' then
      holds := init_valid;
    end if;

    -- By and and or, so that no enable of theirs hangs on reset, too.
    v.span.valid     := not reset and ((r.span.valid and not fragment_ready)
      or (fragment_ready and (r.line.draws or not r.span.ends)));
    v.span.ends      := reset or (r.span.ends and not fragment_ready) or (last and fragment_ready);
    v.line.valid     := not reset and ((r.line.valid and not moves) or (moves and (r.second.valid or taken.valid)));
    v.line.draws     := not reset and ((r.line.draws and not moves)
      or (moves and ((r.second.valid and r.second.draws) or (taken.draws and not r.second.valid))));
    v.line.long      := not reset and ((r.line.long and not moves)
      or (moves and ((r.second.valid and r.second.long) or (taken.long and not r.second.valid))));
    v.second.valid   := not reset and not moves and (r.second.valid or taken.valid);
    v.accepts        := reset or moves or not (r.second.valid or taken.valid);
    v.measured.valid := not reset and ((r.measured.valid and not r.accepts) or (r.edges.valid and r.accepts));
    v.edges.valid    := not reset and ((r.edges.valid and not r.accepts) or (holds and r.accepts and not r.clears));
    v.clears         := reset;
    -- A clock behind reset, when nothing is here.
    if r.clears = '1' then
      v.edges.reads   := '1';
      v.edges.leaves  := '1';
      v.edges.follows := '0';
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
          load           => r.edges.leaves,
          load_x         => init(c_init.start_x.high downto c_init.start_x.low),
          load_quotient  => init(c_init.start_quotient.high downto c_init.start_quotient.low),
          load_remainder => init(c_init.start_remainder.high downto c_init.start_remainder.low),
          load_divisor   => init(c_init.start_divisor.high downto c_init.start_divisor.low),
          load_error     => init(c_init.start_error.high downto c_init.start_error.low),
          load_carry     => init(c_init.start_carry.low),
          step           => r.accepts,
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
          load  => r.edges.reads,
          start => lower,
          value => held_lower
          );

      section <= upper when r.edges.reads = '1' else held_lower;

      stop_edge : entity work.edge_walker
        port map (
          clk            => clk,
          load           => turns,
          load_x         => part(section, c_init.upper_x),
          load_quotient  => part(section, c_init.upper_quotient),
          load_remainder => part(section, c_init.upper_remainder),
          load_divisor   => part(section, c_init.upper_divisor),
          load_error     => part(section, c_init.upper_error),
          load_carry     => section(c_section_bits - 1),
          step           => r.accepts,
          x              => stop_x,
          carry          => open
          );

      start <= signed(start_x);
      stop  <= signed(stop_x);

      -- One pixel less than lies between them: the complement is the negative less one.
      from_x <= resize(stop, more_t'length) when r.edges.backward = '1' else resize(start, more_t'length);
      to_x   <= resize(start, more_t'length) when r.edges.backward = '1' else resize(stop, more_t'length);
      more   <= to_x + not from_x;

  else generate

    signal not_start_x, stop_x : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
    signal upper_x, behind_x   : std_logic_vector(c_init.upper_x.high downto c_init.upper_x.low);
    signal not_start           : span_x_t;

    constant c_whole : natural := c_init.upper_x.high - span_x_t'length + 1; -- where the pixels begin

    begin

      init_lower_lines <= (others => '0');
      init_backward    <= '0';
      edge_carry       <= '0';

      -- Complemented, so that no lookup table stands in front of the sum that counts pixels.
      start_edge : entity work.split_slope_walker
        generic map (
          g_complement => true
          )
        port map (
          clk        => clk,
          load       => r.edges.leaves,
          load_x     => init(c_init.start_x.high downto c_init.start_x.low),
          load_slope => init(c_init.start_slope.high downto c_init.start_slope.low),
          step       => r.accepts,
          x          => not_start_x
          );

      upper_x <= init(c_init.upper_x.high downto c_init.upper_x.low);

      -- The edge ends on a line's last pixel: this one goes a pixel beside it, known a clock ahead.
      beside : process (clk)
      begin
        if rising_edge(clk) then
          behind_x(behind_x'high downto c_whole) <= std_logic_vector(unsigned(upper_x(upper_x'high downto c_whole)) + 1);
        end if;
      end process;

      behind_x(c_whole - 1 downto behind_x'low) <= upper_x(c_whole - 1 downto upper_x'low);

      stop_edge : entity work.split_slope_walker
        port map (
          clk        => clk,
          load       => turns,
          load_x     => behind_x,
          load_slope => init(c_init.upper_slope.high downto c_init.upper_slope.low),
          step       => r.accepts,
          x          => stop_x
          );

      not_start <= signed(not_start_x);
      start     <= not not_start;
      stop      <= signed(stop_x);
      more      <= resize(stop, more_t'length) + resize(not_start, more_t'length);

  end generate;

  line_carry <= r.line.place.carry;
  line_y     <= std_logic_vector(r.line.place.y);
  line_start <= std_logic_vector(r.line.place.start);
  line_stop  <= std_logic_vector(r.line.place.stop);

  fragment_valid <= r.span.valid;
  triangle       <= r.span.triangle;
  y              <= std_logic_vector(r.span.y);
  x              <= std_logic_vector(r.span.x);
  busy           <= r.edges.valid or r.measured.valid or r.second.valid or r.line.valid or r.span.valid;

end architecture;
