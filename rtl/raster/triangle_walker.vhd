-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Walks triangles: lines down the start edge, pixels from the start edge to the stop edge. It outputs the
--             load and step enables of the interpolators. Three stages overlap:
--
--                        edge stage                line stage            span stage
--                     +--------------+
--               init  | line_counter |   line    +------------+  line  +------------+  fragment
--             ------->|              |---------->| line_stage |------->| span_stage |---------->
--                     | edge_pair    |           +------------+        +------------+  y, x
--                     +--------------+
--
--             Triangle A has a line of 3 pixels and an empty line, B a line of 2 pixels:
--
--               clock         0    1    2    3    4    5    6    7
--               init taken    A         B         C
--               edge stage         A0   A1   B0   -    C0
--               line stage              A0   A1   B0   B0   C0
--               span stage                   A0   A0   A0   B0   B0
--               x                            0    1    2    0    1
--
--             The edge stage is one line ahead of the line stage. The line stage is one line ahead of the span stage.
--             The next line, or triangle, is therefore ready when a span ends, and an empty line is skipped while a
--             span is drawn.
--             preset exact: the start edge spans all lines of the triangle. Spans run away from it (backward: to
--             smaller x). The stop edge has an upper and a lower section.
--             preset published: a triangle with a horizontal side. Both edges are stepped by a real slope. Lines and
--             spans are inclusive at both ends.
-- Contract    init is taken where init_valid and init_ready are '1', a fragment where fragment_valid and
--             fragment_ready are. fragment_ready = '0' stalls all stages that hold anything: x, y and triangle do not
--             change. init must not change while it waits. It may stay unchanged until line_load; no other vector is
--             taken before. A line leaves the line stage only in a clock with line_ready = '1': everything else that
--             the line needs, such as its line record, has arrived.
--             line_held: the line stage contains a line.
-- Formats     formats_pkg: the header of init; x span_x, y pixel_y
-- Latency     3 clocks from init taken to the triangle's first fragment, 2 from line_load
-- Throughput  with line_ready = '1' 1 fragment per clock, within and between spans and triangles. Exceptions: a triangle
--             takes 2 clocks at least, and an empty line takes 1 clock if no span is drawn meanwhile.
-- Error       preset exact: none; a pixel belongs to the triangle by its centre, top-left rule. Preset published: x of an
--             edge is off by at most 2**-7 pixels, see edge_x in formats_pkg
-- Source      quadratic paper, section 5 and figure 6 (X counter, Y counter); spherical paper, section 5 (halves of a triangle)
-- Golden twin model/golden/triangle_walker.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;

entity triangle_walker is
  generic (
    g_exact : boolean := true
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    init_valid     : in  std_logic;
    init_ready     : out std_logic;
    init           : in  std_logic_vector(init_bits(g_exact, 0) - 1 downto 0); -- header of the init vector
    line_ready     : in  std_logic;                                                   -- the line may leave the line stage
    line_held      : out std_logic;                                                   -- the line stage holds a line
    line_load      : out std_logic;                                                   -- begin the triangle
    line_step      : out std_logic;                                                   -- go to the next line
    line_carry     : out std_logic;                                                   -- that step ends one pixel further right
    span_load      : out std_logic;                                                   -- begin the line
    span_step      : out std_logic;                                                   -- go to the next pixel
    fragment_valid : out std_logic;
    fragment_ready : in  std_logic;
    triangle       : out std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
    y              : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    x              : out std_logic_vector(formats(g_exact).span_x.bits - 1 downto 0);
    busy           : out std_logic
  );
end entity;

architecture rtl of triangle_walker is

  -- Edge stage.
  signal edge_step, edge_load, section_change : std_logic;
  signal edge_valid, edge_first               : std_logic;
  signal edge_line                            : line_t;

  -- Line stage.
  signal advance, line_valid : std_logic;
  signal line                : line_t;

  -- The line's words as vectors, for traces: GHDL's VCD has no records.
  signal line_y                : std_logic_vector(y'range);
  signal line_start, line_stop : std_logic_vector(x'range);

  -- Span stage.
  signal span_last_next, span_valid : std_logic;
  signal span_y                     : pixel_y_t;
  signal span_x                     : span_x_t;

begin

  lines : entity work.line_counter
    generic map (
      g_exact => g_exact
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => init_valid,
      init_ready     => init_ready,
      init           => init,
      advance        => advance,
      step           => edge_step,
      load           => edge_load,
      section_change => section_change,
      valid          => edge_valid,
      first          => edge_first,
      triangle       => edge_line.triangle,
      y              => edge_line.y
      );

  edges : entity work.edge_pair
    generic map (
      g_exact => g_exact
      )
    port map (
      clk            => clk,
      init           => init,
      load           => edge_load,
      section_change => section_change,
      step           => edge_step,
      start          => edge_line.start,
      stop           => edge_line.stop,
      remaining      => edge_line.remaining,
      empty          => edge_line.empty,
      backward       => edge_line.backward,
      carry          => edge_line.carry
      );

  next_line : entity work.line_stage
    port map (
      clk            => clk,
      reset          => reset,
      enable         => fragment_ready,
      in_valid       => edge_valid,
      in_line        => edge_line,
      line_ready     => line_ready,
      span_last_next => span_last_next,
      advance        => advance,
      step           => line_step,
      span_load      => span_load,
      valid          => line_valid,
      line           => line
      );

  spans : entity work.span_stage
    port map (
      clk       => clk,
      reset     => reset,
      enable    => fragment_ready,
      load      => span_load,
      line      => line,
      last_next => span_last_next,
      valid     => span_valid,
      triangle  => triangle,
      y         => span_y,
      x         => span_x
      );

  line_load  <= advance and edge_first;
  line_held  <= line_valid;
  line_carry <= line.carry;

  line_y     <= std_logic_vector(line.y);
  line_start <= std_logic_vector(line.start);
  line_stop  <= std_logic_vector(line.stop);

  span_step      <= span_valid and fragment_ready;
  fragment_valid <= span_valid;
  y              <= std_logic_vector(span_y);
  x              <= std_logic_vector(span_x);
  busy           <= edge_valid or line_valid or span_valid;

end architecture;
