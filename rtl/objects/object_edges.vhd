-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The subpixels of each pixel of a strip that a triangle covers, in raster order. A pixel has g_subpixels
--             subpixels, in `side` lines of `side`. line_counter and edge_pair walk the triangle at this resolution:
--             they give the span of one such line per clock. While a line of pixels is scanned, the spans of the next
--             one are collected:
--
--               init --> line_counter, edge_pair --> spans of the next line --> spans of this line --> mask
--
--             The spans of this line are kept as distances from the pixel to their ends, in subpixels.
-- Contract    load: take init; the next line is the one that contains its first line. line_step: go to the first pixel of
--             the next line. pixel_step: go to the next pixel. At most one of the three is '1'. load and line_step
--             only where ready = '1', load only where more = '0', too. mask is valid from the first line_step after a
--             load or another line_step; a reset ends the triangle.
--             more: the next line has a part of the triangle; valid while ready = '1'.
--             A strip has at most most_columns and most_lines (objects_pkg): with more, the ends of spans and the first
--             lines wrap.
-- Formats     init: header of preset exact, lines and columns in subpixels from the strip's first pixel
-- Latency     1 clock from a step to mask, side + 1 from load or line_step to ready
-- Throughput  1 pixel per clock; a line takes at least side + 1 clocks
-- Error       none: a subpixel belongs to the triangle by its centre, top-left rule
-- Source      ours; that the filter uses subpixel masks: Schneider and Claussen 1988
-- Golden twin model/golden/object_edges.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.objects_pkg.all;

entity object_edges is
  generic (
    g_subpixels : positive := 1 -- 1, 4 or 16
  );
  port (
    clk        : in  std_logic;
    reset      : in  std_logic;
    load       : in  std_logic;
    line_step  : in  std_logic;
    pixel_step : in  std_logic;
    init       : in  std_logic_vector(init_bits(true, 0) - 1 downto 0);
    ready      : out std_logic;
    more       : out std_logic;
    mask       : out std_logic_vector(g_subpixels - 1 downto 0)
  );
end entity;

architecture rtl of object_edges is

  constant c_side : positive      := side_of(g_subpixels);
  constant c_init : init_header_t := init_header(true);

  -- Subpixels of one line of a pixel, counted from 0.
  subtype row_t is unsigned(2 downto 0);

  -- Two bits more than a span's ends: no distance wraps in a strip of most_columns.
  subtype distance_t is signed(span_x_t'length + 1 downto 0);

  type distances_t is array (0 to c_side - 1) of distance_t;

  type reg_t is record
    row        : row_t; -- rows of the next line that are known
    skip       : row_t; -- rows before the triangle's first line
    more       : std_logic;
    next_left  : distances_t; -- spans of the next line, from its first pixel
    next_right : distances_t;
    left       : distances_t; -- spans of this line, from this pixel
    right      : distances_t;
  end record;

  signal r, r_next : reg_t;

  signal collects                        : std_logic; -- a row is taken
  signal advance, step, edge_load        : std_logic;
  signal section_change, valid, backward : std_logic;
  signal start, stop                     : span_x_t;

begin

  assert g_subpixels = 1 or g_subpixels = 4 or g_subpixels = 16
    report "object_edges: g_subpixels is " & integer'image(g_subpixels) & ", not 1, 4 or 16"
    severity failure;

  collects <= '1' when r.row /= c_side else '0';
  advance  <= '1' when collects = '1' and r.skip = 0 else '0';

  lines : entity work.line_counter
    generic map (
      g_exact => true
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => load,
      init_ready     => open,
      init           => init,
      advance        => advance,
      step           => step,
      load           => edge_load,
      section_change => section_change,
      valid          => valid,
      first          => open,
      triangle       => open,
      y              => open
      );

  edges : entity work.edge_pair
    generic map (
      g_exact => true
      )
    port map (
      clk            => clk,
      init           => init,
      load           => edge_load,
      section_change => section_change,
      step           => step,
      start          => start,
      stop           => stop,
      remaining      => open,
      empty          => open,
      backward       => backward,
      carry          => open
      );

  combinational : process (all)
    variable v           : reg_t;
    variable left, right : distance_t;
  begin
    v := r;

    -- The span of this row: [left, right), empty before and after the triangle's lines.
    left  := resize(start, distance_t'length);
    right := resize(stop, distance_t'length);
    if backward = '1' then
      left  := resize(stop, distance_t'length) + 1;
      right := resize(start, distance_t'length) + 1;
    end if;
    if valid = '0' or advance = '0' then
      left  := (others => '0');
      right := (others => '0');
    end if;

    -- Collect the rows of the next line.
    if collects = '1' then
      v.row := r.row + 1;
      if r.skip /= 0 then
        v.skip := r.skip - 1;
      end if;
      v.more := r.more or (valid and advance);
      for row in 0 to c_side - 1 loop
        if r.row = row then
          v.next_left(row)  := left;
          v.next_right(row) := right;
        end if;
      end loop;
    end if;

    -- Go to the next line, or to the next pixel.
    if line_step = '1' then
      v.left  := r.next_left;
      v.right := r.next_right;
    elsif pixel_step = '1' then
      for row in 0 to c_side - 1 loop
        v.left(row)  := r.left(row) - c_side;
        v.right(row) := r.right(row) - c_side;
      end loop;
    end if;
    if load = '1' or line_step = '1' then
      v.row  := (others => '0');
      v.more := '0';
      v.skip := (others => '0');
    end if;
    if load = '1' and c_side > 1 then
      v.skip(side_bits(g_subpixels) - 1 downto 0) :=
        unsigned(init(c_init.y.low + side_bits(g_subpixels) - 1 downto c_init.y.low));
    end if;

    if reset = '1' then
      v.row  := to_unsigned(c_side, row_t'length);
      v.more := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  rows : for row in 0 to c_side - 1 generate
    columns : for column in 0 to c_side - 1 generate
      mask(c_side * row + column) <= flag(r.left(row) <= column and r.right(row) > column);
    end generate;
  end generate;

  ready <= not collects;
  more  <= r.more;

end architecture;
