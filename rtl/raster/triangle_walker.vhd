-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Walks one triangle after the other: lines down the start edge, pixels from the start edge to the stop
--             edge, and tells the interpolators when to load and when to step. Two stages overlap: the line stage
--             stands one line ahead of the span stage, so that neither a new line nor a new triangle costs a clock,
--             and lines that cover no pixel are passed over while a span is drawn.
-- Init        preset exact: the start edge is the triangle's long one, spans run away from it (backward: to smaller x);
--             the stop edge has an upper and a lower section. preset published: a horizontal-sided triangle, both
--             edges stepped by a real slope, lines and spans inclusive at both ends.
-- Contract    init is taken where init_valid and init_ready are '1', a fragment where fragment_valid and
--             fragment_ready are; x, y and triangle stand still while a fragment waits. The line stage goes on only
--             where line_ready = '1': what the line needs beside the walker has come. line_held: it holds a line.
-- Formats     formats_pkg: the header of init; x span_x, y pixel_y
-- Latency     2 clocks from init taken to the triangle's first fragment
-- Throughput  with line_ready = '1' 1 fragment a clock, within and between spans and triangles; a line without a pixel
--             costs a clock only where no span is being drawn meanwhile
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
    init_ready     : out std_logic;
    init           : in  std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0); -- header of the init vector
    line_ready     : in  std_logic;                                                   -- the line may go on
    line_held      : out std_logic;                                                   -- a line waits for line_ready
    line_load      : out std_logic;                                                   -- take the init vector
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

  type line_stage_t is record
    valid       : std_logic;
    triangle    : triangle_t;
    y           : pixel_y_t;
    lines       : lines_t; -- left in this section of the stop edge, this one included
    lower_lines : lines_t; -- in the section below
    backward    : std_logic;
  end record;

  type span_stage_t is record
    valid    : std_logic;
    triangle : triangle_t;
    y        : pixel_y_t;
    x        : span_x_t;
    stop     : span_x_t;
    backward : std_logic;
    last     : std_logic; -- x is the span's last pixel
  end record;

  type reg_t is record
    line : line_stage_t;
    span : span_stage_t;
  end record;

  signal r, r_next : reg_t;

  -- From the edges, for the line that the line stage holds.
  signal start, stop : span_x_t;

  -- From the init vector, where the preset has them.
  signal init_lower_lines : lines_t;
  signal init_backward    : std_logic;

  signal next_x       : span_x_t;
  signal span_last    : std_logic;
  signal start_last   : std_logic; -- the line's first pixel is its last
  signal next_last    : std_logic; -- the next pixel is the span's last
  signal span_free    : std_logic;
  signal line_empty   : std_logic;
  signal section_last : std_logic;
  signal line_last    : std_logic;
  signal to_lower     : std_logic; -- this step enters the lower section

begin

  next_x    <= r.span.x - 1 when r.span.backward = '1' else r.span.x + 1;
  span_last <= r.span.last;

  -- A pixel ahead: all that goes on at a span's end waits for a register, not for a sum and a comparison.
  start_last <= '1' when (r.line.backward = '1' and start - 1 = stop) or (r.line.backward = '0' and start + 1 = stop) else
    '0';
  next_last  <= '1' when (r.span.backward = '1' and r.span.x - 2 = r.span.stop)
    or (r.span.backward = '0' and r.span.x + 2 = r.span.stop) else '0';

  span_step <= r.span.valid and fragment_ready;
  span_free <= not r.span.valid or (fragment_ready and span_last);

  line_empty <= '1' when (r.line.backward = '0' and start >= stop) or (r.line.backward = '1' and start <= stop) else
    '0';

  section_last <= '1' when r.line.lines = 1 else '0';
  line_last    <= '1' when section_last = '1' and r.line.lower_lines = 0 else '0';
  to_lower     <= section_last and not line_last;

  span_load  <= r.line.valid and line_ready and not line_empty and span_free;
  line_step  <= r.line.valid and line_ready and (line_empty or span_free);
  init_ready <= not r.line.valid or (line_step and line_last);
  line_load  <= init_valid and init_ready;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    if span_load = '1' then
      v.span.valid    := '1';
      v.span.triangle := r.line.triangle;
      v.span.y        := r.line.y;
      v.span.x        := start;
      v.span.stop     := stop;
      v.span.backward := r.line.backward;
      v.span.last     := start_last;
    elsif span_step = '1' then
      v.span.x     := next_x;
      v.span.last  := next_last;
      v.span.valid := not span_last;
    end if;

    if line_load = '1' then
      v.line.valid       := '1';
      v.line.triangle    := init(c_init.triangle.high downto c_init.triangle.low);
      v.line.y           := unsigned(init(c_init.y.high downto c_init.y.low));
      v.line.lines       := unsigned(init(c_init.upper_lines.high downto c_init.upper_lines.low));
      v.line.lower_lines := init_lower_lines;
      v.line.backward    := init_backward;
    elsif line_step = '1' then
      v.line.valid := not line_last;
      v.line.y     := r.line.y + 1;
      v.line.lines := r.line.lines - 1;
      if to_lower = '1' then
        v.line.lines       := r.line.lower_lines;
        v.line.lower_lines := (others => '0');
      end if;
    end if;

    if reset = '1' then
      v.line.valid := '0';
      v.span.valid := '0';
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
          load           => line_load,
          load_x         => init(c_init.start_x.high downto c_init.start_x.low),
          load_quotient  => init(c_init.start_quotient.high downto c_init.start_quotient.low),
          load_remainder => init(c_init.start_remainder.high downto c_init.start_remainder.low),
          load_divisor   => init(c_init.start_divisor.high downto c_init.start_divisor.low),
          load_error     => init(c_init.start_error.high downto c_init.start_error.low),
          load_carry     => init(c_init.start_carry.low),
          step           => line_step,
          x              => start_x,
          carry          => line_carry
          );

      upper <= init(c_init.upper_carry.high downto c_init.upper_x.low);
      lower <= init(c_init.lower_carry.high downto c_init.lower_x.low);

      lower_section : entity work.parameter_register
        generic map (
          g_bits => c_section_bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => lower,
          value => held_lower
          );

      section   <= upper when line_load = '1' else held_lower;
      stop_load <= line_load or (line_step and to_lower);

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
          step           => line_step,
          x              => stop_x,
          carry          => open
          );

      start <= signed(start_x);
      stop  <= signed(stop_x);

  else generate

    constant c_fraction : natural := c_formats.edge_x.fraction;

    subtype edge_t is std_logic_vector(c_formats.edge_x.bits - 1 downto 0);

    signal start_x, start_slope, stop_x, stop_slope : edge_t;

    begin

      assert c_formats.edge_x.bits - c_fraction = c_formats.span_x.bits
        report "triangle_walker: edge_x has " & integer'image(c_formats.edge_x.bits - c_fraction)
        & " whole bits, span_x " & integer'image(c_formats.span_x.bits)
        severity failure;

      init_lower_lines <= (others => '0');
      init_backward    <= '0';
      line_carry       <= '0';

      start_slope_register : entity work.parameter_register
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.start_slope.high downto c_init.start_slope.low),
          value => start_slope
          );

      start_edge : entity work.line_interpolator
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk       => clk,
          load      => line_load,
          start     => init(c_init.start_x.high downto c_init.start_x.low),
          step      => line_step,
          increment => start_slope,
          value     => start_x
          );

      stop_slope_register : entity work.parameter_register
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk   => clk,
          load  => line_load,
          start => init(c_init.upper_slope.high downto c_init.upper_slope.low),
          value => stop_slope
          );

      stop_edge : entity work.line_interpolator
        generic map (
          g_bits => c_formats.edge_x.bits
          )
        port map (
          clk       => clk,
          load      => line_load,
          start     => init(c_init.upper_x.high downto c_init.upper_x.low),
          step      => line_step,
          increment => stop_slope,
          value     => stop_x
          );

      start <= signed(start_x(c_formats.edge_x.bits - 1 downto c_fraction));
      stop  <= signed(stop_x(c_formats.edge_x.bits - 1 downto c_fraction)) + 1;

  end generate;

  line_held  <= r.line.valid;
  line_y     <= std_logic_vector(r.line.y);
  line_start <= std_logic_vector(start);
  line_stop  <= std_logic_vector(stop);

  fragment_valid <= r.span.valid;
  triangle       <= r.span.triangle;
  y              <= std_logic_vector(r.span.y);
  x              <= std_logic_vector(r.span.x);
  busy           <= r.line.valid or r.span.valid;

end architecture;
