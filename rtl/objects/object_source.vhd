-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The start of the chain of object processors. Scans a strip of the frame in raster order, with one head per
--             pixel, and lets each object enter directly before the head of its first line. Loads of the shading
--             processors enter between strips. The vector that waits tells what comes next:
--               draw, shadow    a triangle. If its first line is the next one, it enters; otherwise a line is scanned
--               new_scanline    a strip: first line, number of lines, first column, column after the last. The strip
--                               before is scanned to its end. A strip without a pixel only ends the one before
--               define, redefine, delete, new_frame    a load. It enters between strips
-- Contract    Both streams are valid/ready. in_vector must not change while it waits; out_word does not change while it
--             waits. in_ready depends on in_valid, in_vector and out_ready in the same clock.
--             Triangles come in the order of their first lines, after their strip. fault stays '1' after a triangle out of
--             this order or outside a strip, a strip larger than most_columns or most_lines (objects_pkg), a load in a
--             strip that has not ended, or an unknown command; such a vector is dropped, and its strip goes on.
--             busy: a strip is not scanned to its end. The last strip ends with the strip after it.
-- Formats     in_vector: processors_pkg. Fields of a strip: y, upper_lines, start_x, upper_x of the walk, in pixels. y of
--             a triangle: in subpixels from the strip's first line. out_word: objects_pkg
-- Latency     0
-- Throughput  1 head or 1 part of an object per clock; each line takes a clock more
-- Source      processors paper, section 3.2: the commands of the pixel mode; strips are ours
-- Golden twin model/golden/object_source.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.objects_pkg.all;

entity object_source is
  generic (
    g_config    : config_t := c_default_config;
    g_subpixels : positive := 1 -- 1, 4 or 16
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_vector : in  std_logic_vector(init_bits(g_config) - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_word  : out std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    busy      : out std_logic;
    fault     : out std_logic
  );
end entity;

architecture rtl of object_source is

  constant c_exact : boolean        := g_config.exact;
  constant c_init  : init_header_t  := init_header(true);
  constant c_pixel : pixel_header_t := pixel_header(c_exact);
  constant c_parts : positive       := object_parts(g_config);

  constant c_most_columns : positive := most_columns(c_exact, g_subpixels);
  constant c_most_lines   : positive := most_lines(c_exact, g_subpixels);

  subtype column_t is unsigned(formats(c_exact).pixel_x.bits - 1 downto 0);
  subtype lines_t is unsigned(formats(c_exact).lines.bits - 1 downto 0);
  -- Bits of the number of a part, as in object_processor.
  subtype index_t is unsigned(5 downto 0);

  type reg_t is record
    strip       : std_logic; -- a strip is scanned
    in_line     : std_logic; -- the heads of a line are output
    line_number : lines_t; -- from the strip's first; of this line, or of the next one
    remaining   : lines_t; -- lines that are not scanned, this one included
    y           : pixel_y_t;
    x           : column_t; -- of the next head
    first_x     : column_t;
    last_x      : column_t;
    index       : index_t; -- of the next part of a triangle
    fault       : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal command               : command_t;
  signal walk                  : std_logic_vector(init_bits(true, 0) - 1 downto 0);
  signal draws, loads, strips  : std_logic; -- kind of the vector
  signal early, now            : std_logic; -- the triangle's first line is before the next one; it is the next one
  signal none_left             : std_logic; -- all lines are scanned
  signal last_index            : index_t;
  signal sends_head, sends_end : std_logic;
  signal sends_part            : std_logic;
  signal refuses, starts_line  : std_logic;
  signal passes                : std_logic; -- a load
  signal opens                 : std_logic; -- the strip is opened or refused
  signal too_large             : std_logic; -- the strip is refused
  signal last_part             : std_logic;
  signal parts                 : std_logic_vector(c_parts * c_part_bits - 1 downto 0);
  signal head                  : std_logic_vector(c_pixel.z.low - 1 downto 0);

begin

  command <= command_of(c_exact, in_vector);
  walk    <= in_vector(walk_low(g_config) + walk'high downto walk_low(g_config));
  draws   <= flag(command = c_new_object or (command = c_shadow and g_config.shadows));
  strips  <= flag(command = c_new_scanline);
  loads   <= is_load(command);

  none_left <= flag(r.remaining = 0);

  compare_lines : process (all)
    variable first_line : lines_t;
  begin
    first_line := (others => '0');
    first_line(c_init.y.high - c_init.y.low - side_bits(g_subpixels) downto 0) :=
      unsigned(walk(c_init.y.high downto c_init.y.low + side_bits(g_subpixels)));
    early <= flag(first_line < r.line_number);
    now   <= flag(first_line = r.line_number);
  end process;

  measure_strip : process (all)
    variable columns : signed(c_init.start_x.high - c_init.start_x.low + 1 downto 0);
  begin
    columns := resize(signed(field_of(walk, c_init.upper_x)), columns'length)
      - resize(signed(field_of(walk, c_init.start_x)), columns'length);
    too_large <= flag(columns > c_most_columns or unsigned(field_of(walk, c_init.upper_lines)) > c_most_lines);
  end process;

  -- Choose what is output. A line is scanned to its end.
  choose : process (all)
    variable waits : std_logic;
  begin
    waits       := in_valid and not r.in_line;
    sends_head  <= r.in_line;
    refuses     <= waits and ((draws and (not r.strip or none_left or early))
      or (not draws and not strips and (r.strip or not loads)));
    sends_part  <= waits and draws and r.strip and not none_left and now;
    starts_line <= waits and r.strip and not none_left and (strips or (draws and not early and not now));
    sends_end   <= waits and strips and r.strip and none_left;
    opens       <= waits and strips and not r.strip;
    passes      <= in_valid and loads and not r.strip;
  end process;

  last_index <= to_unsigned(shadow_parts(g_config) - 1, index_t'length) when command = c_shadow else
    to_unsigned(c_parts - 1, index_t'length);
  last_part  <= flag(r.index = last_index);

  out_valid <= sends_head or sends_part or sends_end or passes;
  in_ready  <= refuses or opens or (((sends_part and last_part) or passes) and out_ready);

  make_head : process (all)
    variable v : std_logic_vector(head'range);
  begin
    v := (others => '0');
    v(c_pixel.command.high downto c_pixel.command.low) :=
      std_logic_vector(to_unsigned(c_new_pixel, formats(c_exact).command.bits));
    if r.x = r.first_x then
      v(c_pixel.command.high downto c_pixel.command.low) :=
        std_logic_vector(to_unsigned(c_new_scanline, formats(c_exact).command.bits));
    end if;
    v(c_pixel.y.high downto c_pixel.y.low) := std_logic_vector(r.y);
    v(c_pixel.x.high downto c_pixel.x.low) := std_logic_vector(r.x);
    head <= v;
  end process;

  make_parts : process (all)
  begin
    parts                   <= (others => '0');
    parts(in_vector'range) <= in_vector;
  end process;

  make_word : process (all)
    variable kind : natural;
    variable item : std_logic_vector(item_bits(g_config) - 1 downto 0);
  begin
    kind := c_item;
    item := (others => '0');
    if sends_head = '1' then
      item(head'range) := head;
    elsif sends_part = '1' then
      for i in 0 to c_parts - 1 loop
        if r.index = i then
          item(c_part_bits - 1 downto 0) := parts((i + 1) * c_part_bits - 1 downto i * c_part_bits);
        end if;
      end loop;
      kind := c_part;
      if last_part = '1' then
        kind := c_last_part;
      end if;
    elsif r.strip = '1' then
      kind := c_strip_end;
    else
      item(load_bits(g_config) - 1 downto 0) := in_vector(load_bits(g_config) - 1 downto 0);
    end if;
    out_word <= word_of(g_config, g_subpixels, kind, item);
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Scan the line.
    if sends_head = '1' and out_ready = '1' then
      v.x := r.x + 1;
      if r.x = r.last_x then
        v.in_line     := '0';
        v.x           := r.first_x;
        v.y           := r.y + 1;
        v.line_number := r.line_number + 1;
        v.remaining   := r.remaining - 1;
      end if;
    end if;
    if starts_line = '1' then
      v.in_line := '1';
    end if;
    if sends_part = '1' and out_ready = '1' then
      v.index := r.index + 1;
      if last_part = '1' then
        v.index := (others => '0');
      end if;
    end if;
    if sends_end = '1' and out_ready = '1' then
      v.strip := '0';
    end if;
    -- Open a strip.
    if opens = '1' then
      v.strip       := flag(unsigned(field_of(walk, c_init.upper_lines)) /= 0
        and signed(field_of(walk, c_init.start_x)) < signed(field_of(walk, c_init.upper_x))) and not too_large;
      v.line_number := (others => '0');
      v.remaining   := unsigned(field_of(walk, c_init.upper_lines));
      v.y           := unsigned(field_of(walk, c_init.y));
      v.first_x     := unsigned(walk(c_init.start_x.low + column_t'high downto c_init.start_x.low));
      v.x           := v.first_x;
      v.last_x      := unsigned(walk(c_init.upper_x.low + column_t'high downto c_init.upper_x.low)) - 1;
    end if;
    if refuses = '1' or (opens = '1' and too_large = '1') then
      v.fault := '1';
    end if;
    if reset = '1' then
      v.strip   := '0';
      v.in_line := '0';
      v.index   := (others => '0');
      v.fault   := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  busy  <= r.strip;
  fault <= r.fault;

end architecture;
