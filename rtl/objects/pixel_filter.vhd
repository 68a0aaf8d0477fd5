-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The filter stage: converts the shaded objects of a strip's pixels to filtered fragments. A pixel's colour
--             is the sum of its objects' colours, each weighted by the number of subpixels that it covers; the rest is
--             background. A filtered pixel is the weighted sum over 2x2 pixels: itself, left, above, above left
--             (filter_pkg). A filtered pixel whose support has an object is a fragment, with triangle and depth of the
--             support's nearest object.
--
--               token --> difference --> product --> pixel --+--> 2x2 pixels --> sums --> stream_queue --> fragment
--                                                            +--> line memory --^
--
--             The stages carry differences from the background: what is not covered, and what is outside, is 0.
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. token_ready is a register.
--             Tokens, by their command:
--               new_scanline, new_pixel   the head of a pixel, with y and x. new_scanline: the first one of a line. Each
--                                         pixel of the strip has one, in raster order
--               new_object                an object of this pixel, the nearest first, with triangle, z, radiance and
--                                         token_weight. The weights of a pixel have a sum of g_subpixels at most: a
--                                         simulation stops otherwise
--               new_frame                 the strip has ended: its last pixel is output. Needed after each strip
--             Other tokens, and objects outside a strip, are ignored. Pixels above and to the left of a strip are
--             background. Where the weights reach to the left, the first column of a strip that does not start at x = 0
--             is only the neighbour of the second one: it gives no fragments. The same holds for the first line, where
--             they reach up and it is not y = 0. A strip has at most 2**g_column_bits columns. background is stable from a strip's first token until its last fragment. Of objects with equal
--             depth that of the pixel itself is the nearest, then left, above, above left; within a pixel the first
--             one. With one channel, red, green and blue are equal, as is the background: its red. busy: a strip has
--             started and not ended, or a fragment is inside.
-- Formats     token: token_pkg; token_weight: 0 to g_subpixels; background: three colours, red lowest; fragment:
--             formats_pkg, colour and depth
-- Latency     8 clocks from the token that ends a pixel: the next head, or new_frame
-- Throughput  1 token per clock
-- Error       colours above white are white; the rest is exact and rounded once, to the nearest, halves up. The colours
--             already contain half a step (first_radiance of token_pkg)
-- Source      Schneider and Claussen 1988 (a subpixel mask, filtered over 2x2 pixels); the rest is ours
-- Golden twin model/golden/pixel_filter.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.filter_pkg.all;

entity pixel_filter is
  generic (
    g_config      : config_t         := c_default_config;
    g_subpixels   : positive         := 1; -- 1, 4 or 16
    g_weights     : filter_weights_t := c_filter_weights;
    g_column_bits : positive         := 12
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    background        : in  std_logic_vector(3 * formats(g_config.exact).colour.bits - 1 downto 0);
    token_valid       : in  std_logic;
    token_ready       : out std_logic;
    token             : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    token_weight      : in  std_logic_vector(weight_bits(g_subpixels) - 1 downto 0);
    fragment_valid    : out std_logic;
    fragment_ready    : in  std_logic;
    fragment_triangle : out std_logic_vector(formats(g_config.exact).triangle.bits - 1 downto 0);
    fragment_y        : out std_logic_vector(formats(g_config.exact).pixel_y.bits - 1 downto 0);
    fragment_x        : out std_logic_vector(formats(g_config.exact).pixel_x.bits - 1 downto 0);
    fragment_z        : out std_logic_vector(formats(g_config.exact).depth.bits - 1 downto 0);
    fragment_red      : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0);
    fragment_green    : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0);
    fragment_blue     : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0);
    busy              : out std_logic
  );
end entity;

architecture rtl of pixel_filter is

  constant c_exact        : boolean        := g_config.exact;
  constant c_header       : pixel_header_t := pixel_header(c_exact);
  constant c_channels     : positive       := g_config.channels;
  constant c_radiance     : format_t       := formats(c_exact).radiance;
  constant c_colour       : positive       := formats(c_exact).colour.bits;
  constant c_colours      : positive       := c_channels * c_colour;
  constant c_x_bits       : positive       := formats(c_exact).pixel_x.bits;
  constant c_reaches_left : boolean        := g_weights(c_left) + g_weights(c_above_left) > 0;
  constant c_reaches_up   : boolean        := g_weights(c_above) + g_weights(c_above_left) > 0;

  -- Half a step of the radiance's integers, as the colours contain it; 0 if they have no fraction.
  constant c_half  : natural := 2 ** c_radiance.fraction / 2; -- evaluated at elaboration
  constant c_white : natural := (2 ** c_colour - 1) * 2 ** c_radiance.fraction + c_half;

  -- A colour up to white, a difference of two, the sum of a pixel's subpixels, and the sum of the support's pixels.
  constant c_light_bits   : positive := c_colour + c_radiance.fraction;
  constant c_pixel_bits   : positive := c_light_bits + 1 + log2(g_subpixels);
  constant c_weights_bits : natural  := log2(sum_of(g_weights));
  constant c_total_bits   : positive := c_pixel_bits + c_weights_bits;
  constant c_fraction     : natural  := c_total_bits - 1 - c_colour; -- of the sum of the support's pixels
  constant c_round        : natural  := 2 ** c_fraction / 2; -- evaluated at elaboration

  subtype light_t is unsigned(c_light_bits - 1 downto 0);
  subtype difference_t is signed(c_light_bits downto 0);
  subtype pixel_t is signed(c_pixel_bits - 1 downto 0);
  subtype total_t is signed(c_total_bits - 1 downto 0);

  type differences_t is array (0 to c_channels - 1) of difference_t;

  type pixels_t is array (0 to c_channels - 1) of pixel_t;

  type totals_t is array (0 to c_channels - 1) of total_t;

  -- A pixel's nearest object, from its highest bit: '1' if there is none, depth, triangle. Those two are the lowest
  -- bits.
  constant c_key_bits : positive := 1 + fragment_z'length;

  subtype nearest_t is std_logic_vector(c_key_bits + fragment_triangle'length - 1 downto 0);

  -- Lowest bits of the colours in a word of the queue. With one channel, all are the same.
  constant c_red   : positive := nearest_t'length;
  constant c_green : positive := c_red + boolean'pos(c_channels > 1) * c_colour;
  constant c_blue  : positive := c_red + c_colours - c_colour;

  constant c_none : nearest_t := '1' & (nearest_t'high - 1 downto 0 => '0');

  -- A pixel: the nearest object, and per channel the sum over its subpixels, the first channel lowest.
  subtype entry_t is std_logic_vector(nearest_t'length + c_channels * c_pixel_bits - 1 downto 0);

  constant c_empty : entry_t := '1' & (entry_t'high - 1 downto 0 => '0');

  type place_t is record
    y            : std_logic_vector(fragment_y'range);
    x            : std_logic_vector(fragment_x'range);
    first_line   : std_logic; -- of the strip
    first_column : std_logic;
  end record;

  -- What a token does.
  type step_t is record
    ends    : std_logic; -- the pixel before it is complete
    starts  : std_logic; -- the head of a pixel
    adds    : std_logic; -- an object
    place   : place_t;
    nearest : nearest_t;
  end record;

  type reg_t is record
    in_strip      : std_logic; -- a strip has started: the last token belongs to a pixel
    first_line    : std_logic; -- of this strip
    -- The token: its difference from the background, then its weight's product.
    weigh         : step_t;
    weight        : std_logic_vector(token_weight'range);
    differences   : differences_t;
    add           : step_t;
    products      : pixels_t;
    -- A pixel: its objects are collected; it is complete; the pixel above is read; all its neighbours are known.
    pixel         : entry_t;
    place         : place_t;
    done_valid    : std_logic;
    done          : entry_t;
    done_place    : place_t;
    read_valid    : std_logic;
    read          : entry_t;
    read_place    : place_t;
    current_valid : std_logic;
    current       : entry_t;
    current_place : place_t;
    above         : entry_t;
    left          : entry_t;
    above_left    : entry_t;
    -- The support in two halves: this line and the line above.
    sum_valid     : std_logic;
    sum_place     : place_t;
    this_line     : totals_t;
    line_above    : totals_t;
    this_near     : nearest_t;
    above_near    : nearest_t;
  end record;

  signal r, r_next : reg_t;

  type memory_t is array (2 ** g_column_bits - 1 downto 0) of entry_t;

  signal memory_line : memory_t; -- the last pixel of each column

  attribute ram_style                : string;
  attribute ram_style of memory_line : signal is "block";

  signal memory_q                       : entry_t;
  signal column                         : unsigned(g_column_bits - 1 downto 0);
  signal command                        : command_t;
  signal head                           : std_logic;
  signal room, take, ends               : std_logic;
  signal nearest                        : nearest_t;
  signal colours                        : std_logic_vector(c_colours - 1 downto 0);
  signal queue_in, queue_out            : std_logic_vector(nearest_t'length + c_colours + fragment_y'length
    + fragment_x'length - 1 downto 0);
  signal queue_valid, shown, queue_take : std_logic;
  signal held                           : std_logic; -- a pixel has ended, and its fragment has not left

  -- The colour minus the background. A colour above white counts as white.
  function difference_of (radiance, colour : std_logic_vector) return difference_t is
    alias flat : std_logic_vector(radiance'length - 1 downto 0) is radiance;

    variable light, backing : light_t;
  begin
    light := to_unsigned(c_white, light_t'length);
    if unsigned(flat) < c_white then
      light := unsigned(flat(light_t'range));
    end if;
    backing := shift_left(resize(unsigned(colour), light_t'length), c_radiance.fraction) + c_half;
    return signed('0' & light) - signed('0' & backing);
  end function;

  function product_of (difference : difference_t; weight : std_logic_vector) return pixel_t is
    variable product : signed(difference_t'length + weight'length downto 0);
  begin
    product := difference * signed('0' & weight);
    return product(pixel_t'range);
  end function;

  function nearest_of (entry : entry_t) return nearest_t is
  begin
    return entry(entry_t'high downto entry_t'length - nearest_t'length);
  end function;

  function sum_of (entry : entry_t; channel : natural) return pixel_t is
  begin
    return signed(entry((channel + 1) * c_pixel_bits - 1 downto channel * c_pixel_bits));
  end function;

  -- The pixel with one more object.
  function with_object (entry : entry_t; object : nearest_t; products : pixels_t) return entry_t is
    variable changed : entry_t := entry;
  begin
    if entry(entry_t'high) = '1' then
      changed(entry_t'high downto entry_t'length - nearest_t'length) := object;
    end if;
    for channel in 0 to c_channels - 1 loop
      changed((channel + 1) * c_pixel_bits - 1 downto channel * c_pixel_bits) :=
        std_logic_vector(sum_of(entry, channel) + products(channel));
    end loop;
    return changed;
  end function;

  -- A pixel of the support, empty if it is outside.
  function member_of (entry : entry_t; weight : natural; outside : std_logic) return entry_t is
  begin
    if outside = '1' or weight = 0 then
      return c_empty;
    end if;
    return entry;
  end function;

  function nearer_of (first, second : nearest_t) return nearest_t is
    constant c_low : natural := nearest_t'length - c_key_bits;
  begin
    if unsigned(second(nearest_t'high downto c_low)) < unsigned(first(nearest_t'high downto c_low)) then
      return second;
    end if;
    return first;
  end function;

  -- The weighted sum of two pixels.
  function half_of (first : entry_t; first_weight : natural; second : entry_t; second_weight : natural; channel : natural)
    return total_t is
    variable products : signed(total_t'length + c_weights_bits + 1 downto 0);
  begin
    products := resize(sum_of(first, channel), total_t'length) * to_signed(first_weight, c_weights_bits + 2)
      + resize(sum_of(second, channel), total_t'length) * to_signed(second_weight, c_weights_bits + 2);
    return products(total_t'range);
  end function;

begin

  assert g_subpixels = 1 or g_subpixels = 4 or g_subpixels = 16
    report "pixel_filter: g_subpixels is " & integer'image(g_subpixels) & ", not 1, 4 or 16"
    severity failure;

  assert 2 ** c_weights_bits = sum_of(g_weights)
    report "pixel_filter: the sum of g_weights is " & integer'image(sum_of(g_weights)) & ", not a power of two"
    severity failure;

  assert g_column_bits <= c_x_bits
    report "pixel_filter: g_column_bits is " & integer'image(g_column_bits) & ", but x has " & integer'image(c_x_bits)
    & " bits"
    severity failure;

  token_ready <= room;
  take        <= token_valid and room;
  command     <= command_of(c_exact, token);
  head        <= is_head(command);
  ends        <= take and r.in_strip and (head or flag(command = c_new_frame));

  combinational : process (all)
    variable v                           : reg_t;
    variable itself, left, over, diagonal : entry_t; -- the support
  begin
    v := r;

    -- Take a token.
    v.weigh.ends               := ends;
    v.weigh.starts             := take and head;
    v.weigh.adds               := take and is_object(command);
    v.weigh.place.y            := field_of(token, c_header.y);
    v.weigh.place.x            := field_of(token, c_header.x);
    v.weigh.place.first_line   := not r.in_strip or (r.first_line and not flag(command = c_new_scanline));
    v.weigh.place.first_column := not r.in_strip or flag(command = c_new_scanline);
    v.weigh.nearest            := '0' & field_of(token, c_header.z) & field_of(token, c_header.triangle);
    if take = '1' and head = '1' then
      v.in_strip   := '1';
      v.first_line := v.weigh.place.first_line;
    elsif take = '1' and command = c_new_frame then
      v.in_strip := '0';
    end if;
    v.weight := token_weight;
    for channel in 0 to c_channels - 1 loop
      v.differences(channel) := difference_of(
        radiance_of(g_config, token)((channel + 1) * c_radiance.bits - 1 downto channel * c_radiance.bits),
        background((channel + 1) * c_colour - 1 downto channel * c_colour));
    end loop;

    -- Weight the difference.
    v.add := r.weigh;
    for channel in 0 to c_channels - 1 loop
      v.products(channel) := product_of(r.differences(channel), r.weight);
    end loop;

    -- Collect the objects of a pixel.
    v.done_valid := r.add.ends;
    if r.add.ends = '1' then
      v.done       := r.pixel;
      v.done_place := r.place;
    end if;
    if r.add.starts = '1' then
      v.pixel := c_empty;
      v.place := r.add.place;
    elsif r.add.adds = '1' then
      v.pixel := with_object(r.pixel, r.add.nearest, r.products);
    end if;

    -- Read the pixel above.
    v.read_valid    := r.done_valid;
    v.read          := r.done;
    v.read_place    := r.done_place;
    v.current_valid := r.read_valid;
    v.current       := r.read;
    v.current_place := r.read_place;
    v.above         := memory_q;
    if r.current_valid = '1' then
      v.left       := r.current;
      v.above_left := r.above;
    end if;

    -- Add the two halves of the support.
    itself   := member_of(r.current, g_weights(c_itself), '0');
    left     := member_of(r.left, g_weights(c_left), r.current_place.first_column);
    over     := member_of(r.above, g_weights(c_above), r.current_place.first_line);
    diagonal := member_of(r.above_left, g_weights(c_above_left), r.current_place.first_column or r.current_place.first_line);
    for channel in 0 to c_channels - 1 loop
      v.this_line(channel)  := half_of(itself, g_weights(c_itself), left, g_weights(c_left), channel);
      v.line_above(channel) := half_of(over, g_weights(c_above), diagonal, g_weights(c_above_left), channel);
    end loop;
    v.sum_valid  := r.current_valid;
    v.sum_place  := r.current_place;
    v.this_near  := nearer_of(nearest_of(itself), nearest_of(left));
    v.above_near := nearer_of(nearest_of(over), nearest_of(diagonal));

    if reset = '1' then
      v.in_strip      := '0';
      v.weigh.ends    := '0';
      v.weigh.starts  := '0';
      v.weigh.adds    := '0';
      v.add.ends      := '0';
      v.add.starts    := '0';
      v.add.adds      := '0';
      v.done_valid    := '0';
      v.read_valid    := '0';
      v.current_valid := '0';
      v.sum_valid     := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  column <= unsigned(r.done_place.x(column'range));

  memory : process (clk)
  begin
    if rising_edge(clk) then
      if r.done_valid = '1' then
        memory_q                        <= memory_line(to_integer(column));
        memory_line(to_integer(column)) <= r.done;
      end if;
    end if;
  end process;

  -- Add the halves and the background with half a step, and cut the fraction.
  to_colours : for channel in 0 to c_channels - 1 generate

    signal backing, total : total_t;

  begin

    backing <= shift_left(resize(signed('0' & background((channel + 1) * c_colour - 1 downto channel * c_colour)),
      total_t'length), c_fraction) + c_round;
    total   <= r.this_line(channel) + r.line_above(channel) + backing;
    colours((channel + 1) * c_colour - 1 downto channel * c_colour) <=
      std_logic_vector(total(c_fraction + c_colour - 1 downto c_fraction));

  end generate;

  choose_nearest : process (all)
    variable chosen : nearest_t;
  begin
    chosen := nearer_of(r.this_near, r.above_near);
    if (c_reaches_left and r.sum_place.first_column = '1' and unsigned(r.sum_place.x) /= 0)
      or (c_reaches_up and r.sum_place.first_line = '1' and unsigned(r.sum_place.y) /= 0) then
      chosen := c_none;
    end if;
    nearest <= chosen;
  end process;

  queue_in <= r.sum_place.y & r.sum_place.x & colours & nearest;

  -- All pixels have a place in the queue. Those without a fragment are dropped at its end.
  fragments : entity work.stream_queue
    generic map (
      g_bits       => queue_in'length,
      g_index_bits => 4
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => ends,
      room      => room,
      pending   => held,
      in_valid  => r.sum_valid,
      in_data   => queue_in,
      out_valid => queue_valid,
      out_ready => queue_take,
      out_data  => queue_out
      );

  shown             <= not queue_out(nearest_t'high);
  queue_take        <= fragment_ready or not shown;
  fragment_valid    <= queue_valid and shown;
  fragment_triangle <= queue_out(fragment_triangle'range);
  fragment_z        <= queue_out(nearest_t'high - 1 downto fragment_triangle'length);
  fragment_x        <= queue_out(queue_out'high - fragment_y'length downto nearest_t'length + c_colours);
  fragment_y        <= queue_out(queue_out'high downto queue_out'high - fragment_y'length + 1);

  fragment_red      <= queue_out(c_red + c_colour - 1 downto c_red);
  fragment_green    <= queue_out(c_green + c_colour - 1 downto c_green);
  fragment_blue     <= queue_out(c_blue + c_colour - 1 downto c_blue);

  busy <= r.in_strip or held;

  -- Report a broken contract in the user's simulation.
  check_weights : process (clk)
    variable sum : natural; -- of this pixel; objects outside a strip do not count
  begin
    if rising_edge(clk) then
      if take = '1' and head = '1' then
        sum := 0;
      elsif take = '1' and command = c_new_object and r.in_strip = '1' and reset = '0' then
        sum := sum + to_integer(unsigned(token_weight));
        assert sum <= g_subpixels
          report "pixel_filter: the weights of a pixel have a sum of " & integer'image(sum) & ", g_subpixels is "
          & integer'image(g_subpixels)
          severity failure;
      end if;
    end if;
  end process;

end architecture;
