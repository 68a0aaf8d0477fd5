-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Walks one triangle after the other: lines down the start edge, pixels from the start edge to the stop
--             edge, and tells the interpolators when to load and when to step. Three stages overlap: the edge stage
--             stands one line ahead of the line stage, so that how many pixels a line covers is a register there, and
--             the line stage one ahead of the span stage, so that neither a new line nor, behind two pixels or more, a
--             new triangle costs a clock, and lines that cover no pixel are passed over while a span is drawn.
-- Init        preset exact: the start edge is the triangle's long one, spans run away from it (backward: to smaller x);
--             the stop edge has an upper and a lower section. preset published: a horizontal-sided triangle, both
--             edges stepped by a real slope, lines and spans inclusive at both ends.
-- Contract    init is taken where init_valid and init_ready are '1', a fragment where fragment_valid and
--             fragment_ready are; x, y and triangle stand still while a fragment waits, and so do all stages that hold
--             anything. init stands still from init_valid = '1' until it is taken. It may stand longer, until line_load:
--             none is taken before, nor in the clock behind a reset. The line stage goes on only where line_ready =
--             '1': what the line needs beside the walker has come. line_held: it holds a line.
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

  -- The same where it covers one.
  subtype pixels_t is unsigned(c_formats.span_x.bits - 1 downto 0);

  -- Lines of a section less three, with a sign.
  subtype left_t is unsigned(c_formats.lines.bits downto 0);

  type edge_stage_t is record
    valid        : std_logic;
    first        : std_logic; -- the triangle's first line
    triangle     : triangle_t;
    y            : pixel_y_t;
    left         : left_t; -- lines in this section of the stop edge, this one included, less three
    lower_lines  : lines_t; -- in the section below
    section_last : std_logic; -- this line is its section's last
    lower_none   : std_logic; -- lower_lines = 0
    lower_one    : std_logic; -- lower_lines = 1
    reads        : std_logic; -- the next thing here is an init vector
    leaves       : std_logic; -- reads, or the triangle ends here: the start edge takes what init has
    follows      : std_logic; -- the stop edge goes on; else it takes another section
    backward     : std_logic;
  end record;

  type line_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    start    : span_x_t;
    stop     : span_x_t;
    more     : pixels_t;
    draws    : std_logic; -- here is a line, and it covers a pixel
    backward : std_logic;
    carry    : std_logic; -- of the step to the next line
  end record;

  type span_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    x        : span_x_t;
    more     : more_t; -- pixels behind x, less two
    ends     : std_logic; -- x is the span's last, or no span is here
    backward : std_logic;
  end record;

  type reg_t is record
    clears : std_logic; -- reset was '1' in the clock before
    flows  : std_logic; -- the line stage need not wait for the span: it ends, or no line draws
    edges  : edge_stage_t;
    line   : line_stage_t;
    span   : span_stage_t;
  end record;

  signal r, r_next : reg_t;

  -- From the edges, for the line that the edge stage holds.
  signal start, stop : span_x_t;
  signal more        : more_t;
  signal edge_carry  : std_logic;

  -- From the init vector, where the preset has them.
  signal init_upper_lines : lines_t;
  signal init_lower_lines : lines_t;
  signal init_none        : std_logic; -- no line: counted as 2**bits, as golden
  signal init_backward    : std_logic;

  signal moves     : std_logic; -- the line that the line stage holds need not wait, or there is none
  signal edge_load : std_logic; -- read the init vector
  signal edge_step : std_logic; -- hand the line on, and go to the next one
  signal edge_goes : std_logic; -- either, or neither where nothing is here
  signal edge_reads : std_logic; -- goes, and what comes is an init vector, or nothing
  signal edge_last : std_logic; -- the triangle's last line
  signal turns     : std_logic; -- the stop edge takes another section

begin

  init_upper_lines <= unsigned(init(c_init.upper_lines.high downto c_init.upper_lines.low));

  init_none <= '1' when init_upper_lines = 0 else '0';

  -- While a fragment waits all stages stand: so what moves hangs on registers, and on few.
  moves <= fragment_ready and r.flows and (line_ready or not r.line.valid);

  -- Each a lookup table of registers' outputs, where moves would be one in front of it.
  span_step <= r.span.valid and fragment_ready;
  span_load <= fragment_ready and r.span.ends and r.line.draws and line_ready;
  line_step <= fragment_ready and r.flows and r.line.valid and line_ready;

  edge_last <= r.edges.section_last and r.edges.lower_none;
  turns     <= not r.edges.follows;
  edge_step <= r.edges.valid and moves;
  edge_goes <= moves or not r.edges.valid;
  line_load <= moves and r.edges.first;

  -- Where nothing is here an init vector is next: so this is edge_goes and reads, a lookup table earlier.
  edge_reads <= (moves and r.edges.reads) or not r.edges.valid;
  edge_load  <= init_valid and edge_reads and not r.clears;
  init_ready <= edge_load;

  combinational : process (all)
    variable v      : reg_t;
    variable begins : std_logic; -- a span does, where the one before ends
    variable last   : std_logic; -- the next pixel is its span's, or none comes
    variable pixels : more_t;
    variable behind : more_t; -- a pixel less, or two where pixels are counted anew
    variable blank  : std_logic; -- the line that the edge stage holds covers no pixel, or there is none
    variable lines  : left_t;
    variable fewer  : left_t;
    variable holds  : std_logic; -- the edge stage does, where it goes
  begin
    v := r;

    -- Behind a span's last pixel comes what the line stage holds, be it a line or not.
    begins    := r.line.draws and line_ready;
    last      := r.span.more(more_t'high);
    pixels    := r.span.more;
    behind    := (others => '1');
    behind(0) := not r.span.ends;
    if r.span.ends = '1' then
      last := not begins;
      if r.line.more = 0 then
        last := '1';
      end if;
      pixels := signed('0' & r.line.more);
    end if;
    blank := more(more_t'high) or not r.edges.valid;
    if fragment_ready = '1' then
      if r.span.backward = '1' then
        v.span.x := r.span.x - 1;
      else
        v.span.x := r.span.x + 1;
      end if;
      if r.span.ends = '1' then
        v.span.valid    := begins;
        v.span.triangle := r.line.triangle;
        v.span.y        := r.line.y;
        v.span.x        := r.line.start;
        v.span.backward := r.line.backward;
      end if;
      v.span.more := pixels + behind;
      v.span.ends := last;
      -- While a line waits for line_ready alone it need wait for no span: none begins.
      if moves = '1' or r.flows = '0' then
        v.flows := last or (r.flows and blank);
      end if;
    end if;

    if moves = '1' then
      v.line.valid    := r.edges.valid;
      v.line.triangle := r.edges.triangle;
      v.line.y        := r.edges.y;
      v.line.start    := start;
      v.line.stop     := stop;
      v.line.more     := unsigned(more(pixels_t'range));
      v.line.draws    := not blank;
      v.line.backward := r.edges.backward;
      v.line.carry    := edge_carry;
    end if;

    -- Lines are counted so that a sign says that one is behind this, or none.
    lines := r.edges.left;
    if r.edges.reads = '1' then
      lines := init_none & init_upper_lines;
    elsif r.edges.section_last = '1' then
      lines := '0' & r.edges.lower_lines;
    end if;
    fewer    := (others => '1'); -- a line less, or three where lines are counted anew
    fewer(1) := r.edges.follows;
    if edge_goes = '1' then
      v.edges.left := lines + fewer;
      if r.edges.reads = '1' then
        v.edges.y            := unsigned(init(c_init.y.high downto c_init.y.low));
        v.edges.section_last := '0';
        if init_upper_lines = 1 then
          v.edges.section_last := '1';
        end if;
        v.edges.lower_none := '0';
        if init_lower_lines = 0 then
          v.edges.lower_none := '1';
        end if;
        v.edges.lower_one := '0';
        if init_lower_lines = 1 then
          v.edges.lower_one := '1';
        end if;
        -- While the first line is here init may still be this triangle's.
        v.edges.reads := not init_valid;
      else
        v.edges.y            := r.edges.y + 1;
        v.edges.section_last := r.edges.left(left_t'high);
        v.edges.reads        := r.edges.lower_none and r.edges.left(left_t'high);
        if r.edges.section_last = '1' then
          v.edges.section_last := r.edges.lower_one;
          v.edges.lower_none   := '1';
          v.edges.reads        := r.edges.lower_none or r.edges.lower_one;
        end if;
      end if;
      -- Three registers, so that none has all the edges' bits to choose: with one its wires bound the clock.
      v.edges.leaves  := v.edges.reads or (v.edges.section_last and v.edges.lower_none);
      v.edges.follows := not (v.edges.reads or v.edges.section_last);
      -- A clock behind reset, when nothing is here: so no enable hangs on reset, too.
      if r.clears = '1' then
        v.edges.reads   := '1';
        v.edges.leaves  := '1';
        v.edges.follows := '0';
      end if;
    end if;
    holds := not edge_last;
    if r.edges.reads = '1' then
      holds := init_valid;
    end if;
    v.edges.first := not reset and ((r.edges.first and not edge_goes) or (edge_load and edge_goes));
    v.edges.valid := not reset and ((r.edges.valid and not moves) or (edge_goes and holds and not r.clears));
    v.clears      := reset;

    if edge_reads = '1' then
      v.edges.triangle    := init(c_init.triangle.high downto c_init.triangle.low);
      v.edges.lower_lines := init_lower_lines;
      v.edges.backward    := init_backward;
    end if;

    if reset = '1' then
      v.line.valid := '0';
      v.line.draws := '0';
      v.span.valid := '0';
      v.span.ends  := '1';
      v.flows      := '1';
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

  else generate

    signal not_start_x, stop_x : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
    signal upper_x, behind_x   : std_logic_vector(c_init.upper_x.high downto c_init.upper_x.low);
    signal not_start           : span_x_t;

    constant c_one : unsigned(upper_x'length - 1 downto 0) := shift_left(to_unsigned(1, upper_x'length), upper_x'length - span_x_t'length);

    begin

      init_lower_lines <= (others => '0');
      init_backward    <= '0';
      edge_carry       <= '0';

      -- Complemented, so that no lookup table stands in front of the sum that counts pixels.
      start_edge : entity work.slope_walker
        generic map (
          g_complement => true
          )
        port map (
          clk        => clk,
          load       => r.edges.leaves,
          load_x     => init(c_init.start_x.high downto c_init.start_x.low),
          load_slope => init(c_init.start_slope.high downto c_init.start_slope.low),
          step       => edge_goes,
          x          => not_start_x
          );

        -- The edge ends on a line's last pixel: this one goes a pixel beside it.
      upper_x  <= init(c_init.upper_x.high downto c_init.upper_x.low);
      behind_x <= std_logic_vector(unsigned(upper_x) + c_one);

      stop_edge : entity work.slope_walker
        port map (
          clk        => clk,
          load       => turns,
          load_x     => behind_x,
          load_slope => init(c_init.upper_slope.high downto c_init.upper_slope.low),
          step       => edge_goes,
          x          => stop_x
          );

      not_start <= signed(not_start_x);
      start     <= not not_start;
      stop      <= signed(stop_x);
      more      <= resize(stop, more_t'length) + resize(not_start, more_t'length);

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
