-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The quadratic shader: one init vector per triangle in, one fragment per covered pixel out.
--
--                                                +--> triangle, y, x --> positions --------------------+
--                                                |                                                     |
--           init --> init_buffer --+--> walker --+--> strobes --> 1 clock --+--> depth --------> z ----+--> queue --> fragment
--                                  |                                        |                          |
--                                  +--> word_buffer ------------------------+--> channels, saturate ---+
--
--             Only the walker waits when fragments are not taken. The stages after it never stall: the queue has a place for
--             every pixel that the walker has started.
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. With one channel (g_channels = 1)
--             red, green and blue are equal. With g_degree = 1 the colours are planes, as in Gouraud's shading: the words
--             of second differences do not exist, and the fragments equal those of g_degree = 2 with zeros in these words.
-- Formats     formats_pkg: init (header, then one block per channel), depth, colour
-- Latency     8 clocks from an init vector taken to the triangle's first fragment, if its first line covers a pixel
-- Throughput  1 fragment per clock, with no bubble between spans, lines and triangles. Exceptions: a triangle takes at
--             least 2 clocks, and a line without a pixel takes 1 clock if no span is drawn meanwhile
-- Error       preset exact: the colour is within 0.65 steps of the quadratic through the six samples (0.5 rounding,
--             0.15 differences), and the depth within 0.69 depth steps of the triangle's plane. Where a depth is within one
--             step of 0 or of the largest value, its error is one step larger; setup avoids these depths. Preset
--             published: the colour is within 16.5 steps, without the rounding of the edges
-- Source      quadratic paper, section 5 and figure 6
-- Golden twin model/golden/quadratic_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.quadratic_pkg.all;

entity quadratic_shader is
  generic (
    g_exact    : boolean  := true;
    g_channels : positive := 3;
    g_degree   : positive := 2  -- 1: planes, as in Gouraud's shading
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    init_valid        : in  std_logic;
    init_ready        : out std_logic;
    init_data         : in  std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0);
    fragment_valid    : out std_logic;
    fragment_ready    : in  std_logic;
    fragment_triangle : out std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
    fragment_y        : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    fragment_x        : out std_logic_vector(formats(g_exact).pixel_x.bits - 1 downto 0);
    fragment_z        : out std_logic_vector(formats(g_exact).depth.bits - 1 downto 0);
    fragment_red      : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_green    : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_blue     : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    busy              : out std_logic; -- a vector or a fragment is inside
    fault             : out std_logic  -- always '0'
  );
end entity;

architecture rtl of quadratic_shader is

  constant c_formats     : formats_t := formats(g_exact);
  constant c_header_bits : positive  := init_bits(g_exact, 0);
  constant c_colour      : positive  := c_formats.colour.bits;

  -- Parts of the interpolators' skewed words (skew_pkg): clocks from a strobe to its word, at most the 2 that a vector
  -- stays in the init buffer.
  constant c_parts : integer range 1 to 2 := 2;

  subtype colour_t is std_logic_vector(c_colour - 1 downto 0);

  type colours_t is array (0 to 2) of colour_t;

  -- A pixel's position.
  type position_t is record
    triangle : std_logic_vector(fragment_triangle'range);
    y        : std_logic_vector(fragment_y'range);
    x        : std_logic_vector(fragment_x'range);
  end record;

  type positions_t is array (1 to c_parts) of position_t;

  type fragment_t is record
    position : position_t;
    z        : std_logic_vector(fragment_z'range);
    red      : colour_t;
    green    : colour_t;
    blue     : colour_t;
  end record;

  -- A fragment as a word of the queue.
  subtype fragment_word_t is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length
    + fragment_z'length + 3 * c_colour - 1 downto 0);

  function packed (f : fragment_t) return fragment_word_t is
  begin
    return f.position.triangle & f.position.y & f.position.x & f.z & f.red & f.green & f.blue;
  end function;

  function unpacked (word : fragment_word_t) return fragment_t is
    variable f : fragment_t;
  begin
    (f.position.triangle, f.position.y, f.position.x, f.z, f.red, f.green, f.blue) := word;
    return f;
  end function;

  type reg_t is record
    walk_taken  : std_logic; -- the walker read the header one clock ago: the upper word parts are copied now
    -- The walker's strobes, one clock ago.
    line_load   : std_logic;
    line_step   : std_logic;
    line_carry  : std_logic;
    span_load   : std_logic;
    span_step   : std_logic;
    pixel_valid : std_logic_vector(positions_t'range); -- of positions
  end record;

  signal r, r_next : reg_t;
  signal positions : positions_t; -- one clock ago, and so on

  signal waiting                      : std_logic;
  signal init, words                  : std_logic_vector(init_data'range);
  signal walk_valid, walk_ready       : std_logic;
  signal line_load, line_step         : std_logic;
  signal line_carry                   : std_logic;
  signal span_load, span_step         : std_logic;
  signal triangle                     : std_logic_vector(fragment_triangle'range);
  signal y                            : std_logic_vector(fragment_y'range);
  signal x                            : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal walking                      : std_logic;
  signal z                            : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal colours                      : colours_t;
  signal pixel_valid                  : std_logic;
  signal pixel, fragment              : fragment_t;
  signal pixel_word, fragment_word    : fragment_word_t;
  signal room, queue_busy             : std_logic;

begin

  assert g_channels = 1 or g_channels = 3
    report "quadratic_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;
  assert g_degree = 1 or g_degree = 2
    report "quadratic_shader: g_degree is " & integer'image(g_degree) & ", not 1 (planes) or 2 (quadratics)"
    severity failure;
  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "quadratic_shader: depth_sum has " & integer'image(c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction)
    & " whole bits, depth " & integer'image(c_formats.depth.bits)
    severity failure;

  -- Hold the next triangle.
  init_buffer : entity work.stream_register
    generic map (g_bits => init_data'length)
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => init_valid,
      in_ready  => init_ready,
      in_data   => init_data,
      out_valid => waiting,
      out_ready => r.walk_taken,
      out_data  => init);

  walk_valid <= waiting and not r.walk_taken;

  walker : entity work.triangle_walker
    generic map (g_exact => g_exact)
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => walk_valid,
      init_ready     => walk_ready,
      init           => init(c_header_bits - 1 downto 0),
      line_ready     => '1',
      line_held      => open,
      line_load      => line_load,
      line_step      => line_step,
      line_carry     => line_carry,
      span_load      => span_load,
      span_step      => span_step,
      fragment_valid => open,
      fragment_ready => room,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => walking);

  interpolator_words : entity work.word_buffer
    generic map (g_exact => g_exact, g_channels => g_channels, g_degree => g_degree, g_parts => c_parts)
    port map (
      clk      => clk,
      reset    => reset,
      in_valid => waiting,
      in_data  => init,
      start    => line_load,
      out_data => words);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.walk_taken := walk_valid and walk_ready;
    -- Delay the strobes by one clock, so that a register drives the interpolators. A load has priority over a step.
    v.line_load  := line_load;
    v.line_step  := line_step and not line_load;
    v.line_carry := line_carry;
    v.span_load  := span_load;
    v.span_step  := span_step and not span_load;
    -- Every step of the span is a pixel; its words follow c_parts clocks later.
    v.pixel_valid := span_step & r.pixel_valid(1 to c_parts - 1);
    if reset = '1' then
      v.walk_taken := '0';
      v.line_load := '0';
      v.pixel_valid := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r         <= r_next;
      positions <= position_t'(triangle, y, x(fragment_x'range)) & positions(1 to c_parts - 1);
    end if;
  end process;

  depth : entity work.z_interpolator
    generic map (g_exact => g_exact, g_parts => c_parts)
    port map (
      clk        => clk,
      init       => words(c_header_bits - 1 downto 0),
      line_load  => r.line_load,
      line_step  => r.line_step,
      line_carry => r.line_carry,
      span_load  => r.span_load,
      span_step  => r.span_step,
      value      => z);

  channels : for channel in 0 to g_channels - 1 generate

    alias block_words : std_logic_vector(channel_bits(g_exact, g_degree) - 1 downto 0) is
      words(channel_low(g_exact, g_degree, channel + 1) - 1 downto channel_low(g_exact, g_degree, channel));

    signal value : std_logic_vector(c_formats.intensity.bits - 1 downto 0);

  begin

    -- Step the colour over the triangle.
    colour : if g_degree = 2 generate

      interpolator : entity work.quadratic_interpolator
        generic map (g_exact => g_exact, g_parts => c_parts)
        port map (
          clk        => clk,
          init       => block_words,
          line_load  => r.line_load,
          line_step  => r.line_step,
          line_carry => r.line_carry,
          span_load  => r.span_load,
          span_step  => r.span_step,
          value      => value);

    else generate

      interpolator : entity work.plane_interpolator
        generic map (g_bits => c_formats.intensity.bits, g_carries => g_exact, g_parts => c_parts)
        port map (
          clk        => clk,
          plane      => block_words,
          line_load  => r.line_load,
          line_step  => r.line_step,
          line_carry => r.line_carry,
          span_load  => r.span_load,
          span_step  => r.span_step,
          value      => value);

    end generate;

    to_colour : entity work.saturate
      generic map (
        g_value_bits    => c_formats.intensity.bits,
        g_fraction_bits => c_formats.intensity.fraction,
        g_result_bits   => c_colour)
      port map (value => value, result => colours(channel));

  end generate;

  grey : if g_channels = 1 generate
    colours(1) <= colours(0);
    colours(2) <= colours(0);
  end generate;

  -- Queue the pixel: its position, the whole bits of its depth, its colours.
  pixel_valid <= r.pixel_valid(c_parts);
  pixel       <= (positions(c_parts), z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction),
    colours(0), colours(1), colours(2));
  pixel_word  <= packed(pixel);

  queue : entity work.stream_queue
    generic map (g_bits => fragment_word_t'length)
    port map (
      clk       => clk,
      reset     => reset,
      claim     => span_step,
      room      => room,
      pending   => queue_busy,
      in_valid  => pixel_valid,
      in_data   => pixel_word,
      out_valid => fragment_valid,
      out_ready => fragment_ready,
      out_data  => fragment_word);

  fragment          <= unpacked(fragment_word);
  fragment_triangle <= fragment.position.triangle;
  fragment_y        <= fragment.position.y;
  fragment_x        <= fragment.position.x;
  fragment_z        <= fragment.z;
  fragment_red      <= fragment.red;
  fragment_green    <= fragment.green;
  fragment_blue     <= fragment.blue;

  busy  <= waiting or walking or queue_busy;
  fault <= '0';

end architecture;
