-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The quadratic shader: an init vector a triangle in, a fragment for each pixel that the triangle covers out.
--             stream_register -> triangle_walker -> z_interpolator and a quadratic_interpolator a channel -> saturate
--             -> stream_queue
--             The walker alone waits for whoever takes the fragments. What it tells the interpolators goes through
--             registers, and all behind it runs on; the queue has a place for every pixel that is on its way.
-- Contract    Both streams are valid/ready; a fragment stands still while it waits. One channel (g_channels = 1) is
--             given out as red, green and blue.
-- Formats     formats_pkg: init (header, then a block a channel), depth, colour
-- Latency     8 clocks from an init vector taken to the triangle's first fragment (its first line covering a pixel)
-- Throughput  1 fragment a clock, with no bubble between spans, lines and triangles, but that a triangle takes 2 clocks
--             at least; lines that cover no pixel cost a clock each where no span is being drawn meanwhile
-- Error       preset exact: the colour is within 0.65 steps of the quadratic through the six samples (0.5 rounding,
--             0.15 differences), depth within 0.69 of the triangle's plane, and a step more within a step of 0 or of
--             its largest value, which setup keeps clear
-- Source      quadratic paper, section 5 and figure 6
-- Golden twin model/golden/quadratic_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity quadratic_shader is
  generic (
    g_exact    : boolean  := true;
    g_channels : positive := 3
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    init_valid        : in  std_logic;
    init_ready        : out std_logic;
    init_data         : in  std_logic_vector(init_bits(g_exact, g_channels) - 1 downto 0);
    fragment_valid    : out std_logic;
    fragment_ready    : in  std_logic;
    fragment_triangle : out std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
    fragment_y        : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    fragment_x        : out std_logic_vector(formats(g_exact).pixel_x.bits - 1 downto 0);
    fragment_z        : out std_logic_vector(formats(g_exact).depth.bits - 1 downto 0);
    fragment_red      : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_green    : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_blue     : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    busy              : out std_logic; -- something is on its way
    fault             : out std_logic -- nothing here can go wrong
  );
end entity;

architecture rtl of quadratic_shader is

  constant c_formats      : formats_t := formats(g_exact);
  constant c_header_bits  : positive  := init_channel_low(g_exact, 0);
  constant c_channel_bits : positive  := init_channel_low(g_exact, 1) - c_header_bits;
  constant c_colour       : positive  := c_formats.colour.bits;

  -- The interpolators' words: depth's are the header's last.
  constant c_depth_low     : positive := init_header(g_exact).z.low;
  constant c_depth_bits    : positive := c_formats.depth_sum.bits;
  constant c_depth_words   : positive := (c_header_bits - c_depth_low) / c_depth_bits; -- elaboration only
  constant c_value_bits    : positive := c_formats.intensity.bits;
  constant c_channel_words : positive := c_channel_bits / c_value_bits; -- elaboration only

  subtype intensity_t is std_logic_vector(c_formats.intensity.bits - 1 downto 0);
  subtype span_x_t    is std_logic_vector(c_formats.span_x.bits - 1 downto 0);

  -- A pixel of the walker's.
  type pixel_t is record
    triangle : std_logic_vector(fragment_triangle'range);
    y        : std_logic_vector(fragment_y'range);
    x        : span_x_t;
  end record;

  -- The interpolators' words come in parts, the lowest first, a clock from part to part: so a word is whole c_parts clocks
  -- after the walker's strobe.
  constant c_parts : positive := 2;

  type pixels_t is array (1 to c_parts) of pixel_t;

  -- What the walker has said, a clock ago and more: for each part of the words.
  subtype strobe_t is std_logic_vector(1 to c_parts);

  -- Behind the buffer the interpolators' words have a second place, from which they load: so the buffer is free when the
  -- last part has gone there, a clock behind the walker's reading.
  type reg_t is record
    walk_valid : std_logic; -- a triangle that the walker has not taken is in the buffer
    walk_taken : std_logic; -- the walker took it in the clock before: the buffer lets it go
    copy_waits : std_logic; -- the buffer holds a triangle whose words have not gone on
    placed     : std_logic; -- the second place holds words of a triangle that has not begun
    copy       : strobe_t;  -- words go on, now (the lowest parts) or clocks ago
    line_load  : strobe_t;
    line_step  : std_logic;
    line_carry : std_logic;
    span_load  : std_logic;
    span_step  : strobe_t;
    span_goes  : std_logic; -- a step that is no load, too
  end record;

  -- Where a fragment's fields begin in the queue's words.
  constant c_triangle_low : natural := 0;
  constant c_y_low        : natural := c_triangle_low + fragment_triangle'length;
  constant c_x_low        : natural := c_y_low + fragment_y'length;
  constant c_z_low        : natural := c_x_low + fragment_x'length;
  constant c_red_low      : natural := c_z_low + fragment_z'length;
  constant c_green_low    : natural := c_red_low + fragment_red'length;
  constant c_blue_low     : natural := c_green_low + fragment_green'length;

  signal r, r_next : reg_t;
  signal pixels    : pixels_t;

  signal init, words                   : std_logic_vector(init_data'range); -- in the buffer; in the second place
  signal buffer_free                   : std_logic;
  signal waiting, walk_ready           : std_logic;
  signal line_load, line_step          : std_logic;
  signal line_carry                    : std_logic;
  signal span_load, span_step          : std_logic;
  signal y                             : std_logic_vector(fragment_y'range);
  signal x                             : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal triangle                      : std_logic_vector(fragment_triangle'range);
  signal z                             : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal whole_z                       : std_logic_vector(fragment_z'range);
  signal colours                       : std_logic_vector(3 * c_colour - 1 downto 0); -- red lowest
  signal takes                         : std_logic; -- a vector comes into the buffer
  signal room, coming                  : std_logic;
  signal pixel_valid                   : std_logic;
  signal walking                       : std_logic;
  signal pixel, fragment_pixel         : std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length
    + fragment_z'length + 3 * c_colour - 1 downto 0);

begin

  assert g_channels = 1 or g_channels = 3
    report "quadratic_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;
  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "quadratic_shader: depth_sum has " & integer'image(c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction)
    & " whole bits, depth " & integer'image(c_formats.depth.bits)
    severity failure;

  init_buffer : entity work.stream_register
    generic map (
      g_bits => init_data'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => init_valid,
      in_ready  => buffer_free,
      in_data   => init_data,
      out_valid => waiting,
      out_ready => r.walk_taken,
      out_data  => init
      );

  walker : entity work.triangle_walker
    generic map (
      g_exact => g_exact
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => r.walk_valid,
      init_ready     => walk_ready,
      init           => init(c_header_bits - 1 downto 0),
      line_ready     => '1',
      line_held      => open,
      line_load      => line_load,
      line_step      => line_step,
      line_carry     => line_carry,
      span_load      => span_load,
      span_step      => span_step,
      line_y         => open,
      line_start     => open,
      line_stop      => open,
      fragment_valid => open,
      fragment_ready => room,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => walking
      );

  init_ready <= buffer_free;
  takes      <= init_valid and buffer_free;

  combinational : process (all)
    variable v : reg_t;
  begin
    v            := r;
    v.walk_taken := r.walk_valid and walk_ready;
    v.walk_valid := (r.walk_valid and not walk_ready) or takes;
    -- Known a clock before: a register lets all these words in.
    v.copy_waits := (r.copy_waits and not r.copy(1)) or takes;
    v.placed     := (r.copy(1) or r.placed) and not line_load;
    v.copy       := (v.copy_waits and not v.placed) & r.copy(1 to c_parts - 1);
    v.line_load  := line_load & r.line_load(1 to c_parts - 1);
    v.line_step  := line_step and not line_load;
    v.line_carry := line_carry;
    v.span_load  := span_load;
    v.span_step  := span_step & r.span_step(1 to c_parts - 1);
    v.span_goes  := span_step and not span_load;
    if reset = '1' then
      v.walk_valid := '0';
      v.walk_taken := '0';
      v.copy_waits := '0';
      v.placed := '0';
      v.copy := (others => '0');
      v.line_load := (others => '0');
      v.span_step := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r      <= r_next;
      pixels <= pixel_t'(triangle, y, x) & pixels(1 to c_parts - 1);
    end if;
  end process;

  words(c_depth_low - 1 downto 0) <= (others => '0'); -- the walker's alone

  depth_words : for word in 0 to c_depth_words - 1 generate

    parts : for part in 0 to c_parts - 1 generate

      constant c_low  : natural := c_depth_low + word * c_depth_bits + part * c_depth_bits / c_parts; -- elaboration only
      constant c_high : natural := c_depth_low + word * c_depth_bits + (part + 1) * c_depth_bits / c_parts - 1; -- elaboration only

      begin

        place : entity work.parameter_register
          generic map (
            g_bits => c_high - c_low + 1
            )
          port map (
            clk   => clk,
            load  => r.copy(1 + part),
            start => init(c_high downto c_low),
            value => words(c_high downto c_low)
            );

    end generate;

  end generate;

  depth : entity work.z_interpolator
    generic map (
      g_exact => g_exact,
      g_parts => c_parts
      )
    port map (
      clk        => clk,
      init       => words(c_header_bits - 1 downto 0),
      line_load  => r.line_load(1),
      line_step  => r.line_step,
      line_carry => r.line_carry,
      span_load  => r.span_load,
      span_step  => r.span_goes,
      value      => z
      );

  channels : for channel in 0 to g_channels - 1 generate

    constant c_low : natural := init_channel_low(g_exact, channel);

    signal value : intensity_t;

    begin

      channel_words : for word in 0 to c_channel_words - 1 generate

        parts : for part in 0 to c_parts - 1 generate

          constant c_part_low : natural := c_low + word * c_value_bits + part * c_value_bits / c_parts; -- elaboration only
          constant c_high : natural := c_low + word * c_value_bits + (part + 1) * c_value_bits / c_parts - 1; -- elaboration only

          begin

            place : entity work.parameter_register
              generic map (
                g_bits => c_high - c_part_low + 1
                )
              port map (
                clk   => clk,
                load  => r.copy(1 + part),
                start => init(c_high downto c_part_low),
                value => words(c_high downto c_part_low)
                );

        end generate;

      end generate;

      interpolator : entity work.quadratic_interpolator
        generic map (
          g_exact => g_exact,
          g_parts => c_parts
          )
        port map (
          clk        => clk,
          init       => words(c_low + c_channel_bits - 1 downto c_low),
          line_load  => r.line_load(1),
          line_step  => r.line_step,
          line_carry => r.line_carry,
          span_load  => r.span_load,
          span_step  => r.span_goes,
          value      => value
          );

      to_colour : entity work.saturate
        generic map (
          g_value_bits    => c_formats.intensity.bits,
          g_fraction_bits => c_formats.intensity.fraction,
          g_result_bits   => c_colour
          )
        port map (
          value  => value,
          result => colours((channel + 1) * c_colour - 1 downto channel * c_colour)
          );

  end generate;

  grey : if g_channels = 1 generate
    colours(3 * c_colour - 1 downto c_colour) <= colours(c_colour - 1 downto 0) & colours(c_colour - 1 downto 0);
  end generate;

  whole_z     <= z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);
  pixel_valid <= r.span_step(c_parts);

  -- Each for itself: what changes is all that a simulator copies.
  pixel(c_red_low + 3 * c_colour - 1 downto c_red_low)                     <= colours;
  pixel(c_z_low + fragment_z'length - 1 downto c_z_low)                    <= whole_z;
  pixel(c_x_low + fragment_x'length - 1 downto c_x_low)                    <= pixels(c_parts).x(fragment_x'range);
  pixel(c_y_low + fragment_y'length - 1 downto c_y_low)                    <= pixels(c_parts).y;
  pixel(c_triangle_low + fragment_triangle'length - 1 downto c_triangle_low) <= pixels(c_parts).triangle;

  queue : entity work.stream_queue
    generic map (
      g_bits => pixel'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => span_step,
      room      => room,
      holds     => coming,
      in_valid  => pixel_valid,
      in_data   => pixel,
      out_valid => fragment_valid,
      out_ready => fragment_ready,
      out_data  => fragment_pixel
      );

  fragment_triangle <= fragment_pixel(c_triangle_low + fragment_triangle'length - 1 downto c_triangle_low);
  fragment_y        <= fragment_pixel(c_y_low + fragment_y'length - 1 downto c_y_low);
  fragment_x        <= fragment_pixel(c_x_low + fragment_x'length - 1 downto c_x_low);
  fragment_z        <= fragment_pixel(c_z_low + fragment_z'length - 1 downto c_z_low);
  fragment_red      <= fragment_pixel(c_red_low + fragment_red'length - 1 downto c_red_low);
  fragment_green    <= fragment_pixel(c_green_low + fragment_green'length - 1 downto c_green_low);
  fragment_blue     <= fragment_pixel(c_blue_low + fragment_blue'length - 1 downto c_blue_low);

  busy  <= waiting or walking or coming;
  fault <= '0';

end architecture;
