-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One processor of the chain. It stores one triangle, an object or a shadow polygon, and inserts its element into
--             the list of each pixel that the triangle covers.
--
--               words in --> stream_queue --> next word ------> object_merge --> words out
--                                 |                                  ^
--                               parts                             element
--                                 v                                  |
--                               store --> object_edges, raster_interpolators
--
--             The edges step when a head becomes the next word. Its element is registered when the head enters
--             object_merge: so a clock contains either the choice of the point, or the comparison of depths.
--             A processor without a triangle, or whose triangle has ended, takes the next one that enters the chain.
--             An element has one depth, N, P and 1/w: those of the pixel's centre if the four subpixels around it are
--             covered, otherwise those of the first covered subpixel. A shadow polygon counts where it covers the
--             subpixel right of and below the centre.
-- Contract    Both streams are valid/ready; out_word does not change while it waits. in_ready does not depend on out_ready
--             in the same clock. An object enters directly before the head of its first line. After the strip's end
--             the processor has no triangle.
--             busy: a word is in the queue, or the next word.
-- Formats     objects_pkg; an object is the host's vector of a triangle (processors_pkg) in parts of 64 bits, the lowest
--             first. Its walk is in subpixels, its z, planes, z_dx and dx are per pixel, z_de0 and de0 per line, at
--             the strip's first column. With subpixels, the lowest bits of z_de1 and de1 are the three bits above dx
--             and the three above de0
-- Latency     3 clocks from a word to the same word
-- Throughput  1 word per clock. A line takes at least side + 1 clocks; a head waits for side + 2 clocks after an object
-- Error       z and planes: see raster_interpolator
-- Source      processors paper, section 2; Schneider and Claussen 1988: each object processor stores and scan-converts
--             one object and interpolates depth and normal across it. Masks, order and loading are ours
-- Golden twin model/golden/object_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.objects_pkg.all;

entity object_processor is
  generic (
    g_config    : config_t := c_default_config;
    g_subpixels : positive := 1 -- 1, 4 or 16
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_word   : in  std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_word  : out std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    busy      : out std_logic
  );
end entity;

architecture rtl of object_processor is

  constant c_exact       : boolean          := g_config.exact;
  constant c_formats     : formats_t        := formats(c_exact);
  constant c_request     : request_header_t := request_header(c_exact);
  constant c_pixel       : pixel_header_t   := pixel_header(c_exact);
  constant c_init        : init_header_t    := init_header(true);
  constant c_plane       : plane_header_t   := plane_header(c_exact);
  constant c_side        : positive         := side_of(g_subpixels);
  constant c_parts       : positive         := object_parts(g_config);
  constant c_planes      : positive         := planes(g_config);
  constant c_vector_bits : positive         := c_formats.vector.bits;

  -- Bits of the number of a part: there are fewer than 2**6.
  subtype index_t is unsigned(5 downto 0);
  subtype request_t is std_logic_vector(c_request.normalize.high downto 0);
  subtype word_t is std_logic_vector(in_word'range);
  subtype mask_t is std_logic_vector(g_subpixels - 1 downto 0);
  subtype index_bits_t is std_logic_vector(1 downto 0);

  type reg_t is record
    stored : std_logic; -- the store holds a triangle with lines up to this one or the next
    taking : std_logic; -- parts of a triangle enter
    index  : index_t; -- of the next part
    load   : std_logic; -- the last part was taken in the clock before
    full   : std_logic; -- there is a next word
    own    : std_logic; -- the last head in object_merge has an element
  end record;

  signal r, r_next : reg_t;

  signal enters, room, queued     : std_logic;
  signal next_valid, next_ready   : std_logic;
  signal word, next_word          : word_t;
  signal element, own_word        : word_t; -- of the next word, if it is a head; of the last head in object_merge
  signal part, last_part          : std_logic; -- the word is a part
  signal line_head, pixel_head    : std_logic;
  signal waits                    : std_logic; -- until the edges are ready
  signal free, merges, taken      : std_logic;
  signal takes_part, passes       : std_logic; -- the word enters the store, or becomes the next word
  signal head_merges              : std_logic;
  signal clear, dropped           : std_logic;
  signal line_step, pixel_step    : std_logic;
  signal spans_ready, more        : std_logic;
  signal store                    : std_logic_vector(c_parts * c_part_bits - 1 downto 0);
  signal walk                     : std_logic_vector(init_bits(true, 0) - 1 downto 0);
  signal mask                     : mask_t;
  signal shadow, covers           : std_logic;
  signal centre                   : std_logic; -- the subpixels around the centre are covered
  signal row, column              : index_bits_t; -- the first covered subpixel
  signal z, upper_z               : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0); -- upper_z: above dx, de0
  signal vectors                  : std_logic_vector(c_planes * c_vector_bits - 1 downto 0); -- N lowest

begin

  assert c_parts < 2 ** index_t'length
    report "object_processor: " & integer'image(c_parts) & " parts, at most " & integer'image(2 ** index_t'length - 1)
    severity failure;

  enters   <= in_valid and room;
  in_ready <= room;
  busy     <= queued or r.full;

  words : entity work.stream_queue
    generic map (
      g_bits       => word_t'length,
      g_index_bits => 2
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => enters,
      room      => room,
      pending   => queued,
      in_valid  => enters,
      in_data   => in_word,
      out_valid => next_valid,
      out_ready => next_ready,
      out_data  => word
      );

  last_part  <= flag(kind_of(word) = kind_word(c_last_part));
  part       <= flag(kind_of(word) = kind_word(c_part)) or last_part;
  line_head  <= flag(kind_of(word) = kind_word(c_item) and command_of(c_exact, word) = c_new_scanline);
  pixel_head <= flag(kind_of(word) = kind_word(c_item) and command_of(c_exact, word) = c_new_pixel);
  clear      <= flag(kind_of(word) = kind_word(c_strip_end));

  -- Whether the triangle has ended is known when the edges are ready.
  waits      <= (part or line_head or clear) and (r.load or not spans_ready);
  free       <= not r.full or merges;
  next_ready <= free and not waits;
  taken      <= next_valid and next_ready;

  takes_part <= part and (r.taking or not (r.stored and more));
  line_step  <= taken and line_head;
  pixel_step <= taken and pixel_head and r.stored;
  dropped    <= taken and clear;

  passes      <= taken and not takes_part;
  head_merges <= r.full and merges and flag(kind_of(next_word) = kind_word(c_item))
    and is_head(command_of(c_exact, next_word));

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.load := '0';
    -- Take a triangle.
    if taken = '1' and takes_part = '1' then
      v.taking := not last_part;
      v.index  := r.index + 1;
      v.stored := last_part;
      v.load   := last_part;
      if last_part = '1' then
        v.index := (others => '0');
      end if;
    end if;
    -- The line before was its last.
    if line_step = '1' then
      v.stored := r.stored and more;
    end if;
    v.full := passes or not free;
    if head_merges = '1' then
      v.own := covers;
    end if;
    if reset = '1' then
      v.full   := '0';
      v.own    := '0';
      v.stored := '0';
      v.taking := '0';
      v.index  := (others => '0');
      v.load   := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  parts : process (clk)
  begin
    if rising_edge(clk) then
      for i in 0 to c_parts - 1 loop
        if taken = '1' and takes_part = '1' and r.index = i then
          store((i + 1) * c_part_bits - 1 downto i * c_part_bits) <= word(c_part_bits - 1 downto 0);
        end if;
      end loop;
    end if;
  end process;

  next_word_register : entity work.parameter_register
    generic map (
      g_bits => word_t'length
      )
    port map (
      clk   => clk,
      load  => passes,
      start => word,
      value => next_word
      );

  walk    <= store(walk_low(g_config) + walk'high downto walk_low(g_config));
  upper_z <= field_of(walk, c_init.z_de1);
  shadow  <= flag(g_config.shadows and command_of(c_exact, store) = c_shadow);

  edges : entity work.object_edges
    generic map (
      g_subpixels => g_subpixels
      )
    port map (
      clk        => clk,
      reset      => reset or dropped,
      load       => r.load,
      line_step  => line_step,
      pixel_step => pixel_step,
      init       => walk,
      ready      => spans_ready,
      more       => more,
      mask       => mask
      );

    -- Select the point of the pixel at which the element is interpolated.
  select_point : process (all)
    variable around : std_logic;
  begin
    around := '1';
    row    <= "00";
    column <= "00";
    for y in c_side - 1 downto 0 loop
      for x in c_side - 1 downto 0 loop
        if mask(c_side * y + x) = '1' then
          row    <= std_logic_vector(to_unsigned(y, index_bits_t'length));
          column <= std_logic_vector(to_unsigned(x, index_bits_t'length));
        elsif 2 * y >= c_side - 2 and 2 * y <= c_side and 2 * x >= c_side - 2 and 2 * x <= c_side then
          around := '0';
        end if;
      end loop;
    end loop;
    centre <= around;
  end process;

  depth : entity work.raster_interpolator
    generic map (
      g_bits => c_formats.depth_sum.bits,
      g_side => c_side
      )
    port map (
      clk        => clk,
      load       => r.load,
      line_step  => line_step,
      pixel_step => pixel_step,
      start      => field_of(walk, c_init.z),
      dx         => upper_z(2 downto 0) & field_of(walk, c_init.z_dx),
      dy         => upper_z(5 downto 3) & field_of(walk, c_init.z_de0),
      centre     => centre,
      row        => row,
      column     => column,
      value      => z
      );

  interpolated : for plane in 0 to c_planes - 1 generate

    constant c_low      : natural  := plane_low(g_config, plane);
    constant c_sum_bits : positive := c_formats.plane_sum.bits;

    signal plane_words : std_logic_vector(plane_bits(c_exact) - 1 downto 0);
    signal value : std_logic_vector(c_sum_bits - 1 downto 0);
    signal upper : std_logic_vector(c_sum_bits - 1 downto 0); -- bits above dx and de0

  begin

    plane_words <= store(c_low + plane_words'high downto c_low);
    upper       <= field_of(plane_words, c_plane.de1);

    interpolator : entity work.raster_interpolator
      generic map (
        g_bits => c_sum_bits,
        g_side => c_side
        )
      port map (
        clk        => clk,
        load       => r.load,
        line_step  => line_step,
        pixel_step => pixel_step,
        start      => field_of(plane_words, c_plane.value),
        dx         => upper(2 downto 0) & field_of(plane_words, c_plane.dx),
        dy         => upper(5 downto 3) & field_of(plane_words, c_plane.de0),
        centre     => centre,
        row        => row,
        column     => column,
        value      => value
        );

      -- The host has added half a step of the dropped bits.
    vectors((plane + 1) * c_vector_bits - 1 downto plane * c_vector_bits) <=
      value(c_sum_bits - 1 downto c_sum_bits - c_vector_bits);

  end generate;

  covers <= r.stored and mask(c_side * (c_side / 2) + c_side / 2) when shadow = '1' else -- evaluated at elaboration
    r.stored and flag(mask /= (mask'range => '0'));

  make_word : process (all)
    variable v : word_t;
  begin
    v := word_of(g_config, g_subpixels, c_item, store(request_t'range));
    v(c_pixel.triangle.high downto c_pixel.triangle.low) := field_of(walk, c_init.triangle);
    v(c_pixel.z.high downto c_pixel.z.low)               :=
      z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);
    if shadow = '0' then
      v(normal_low(g_config, 0) + vectors'high downto normal_low(g_config, 0)) := vectors;
      v(material_low(g_config) + material_bits(g_config) - 1 downto material_low(g_config)) :=
        store(init_material_low(g_config) + material_bits(g_config) - 1 downto init_material_low(g_config));
      v := with_mask(v, mask);
    end if;
    element <= v;
  end process;

  own_word_register : entity work.parameter_register
    generic map (
      g_bits => word_t'length
      )
    port map (
      clk   => clk,
      load  => head_merges,
      start => element,
      value => own_word
      );

  merge : entity work.object_merge
    generic map (
      g_config    => g_config,
      g_subpixels => g_subpixels
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => r.full,
      in_ready  => merges,
      in_word   => next_word,
      own       => r.own,
      own_word  => own_word,
      out_valid => out_valid,
      out_ready => out_ready,
      out_word  => out_word
      );

end architecture;
