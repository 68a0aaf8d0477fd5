-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The spherical shader: one header per triangle and one record per line in, one fragment per covered pixel
--             out.
--               stream_register -> triangle_walker -> z_interpolator, and per light a diffuse_slice and a specular_slice
--               -> per channel a saturating_sum -> stream_queue
--             Only the walker waits when fragments are not taken. The stages after it never stall: the queue has a
--             place for every pixel that the walker has started.
--             Hardware that no effect needs does not exist: there is no diffuse_slice without diffuse light and (preset
--             exact) without highlights, which need its horizon; there are no line records if no light has a part in
--             them.
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. A triangle's header (walk,
--             depth, ambient) is followed by one record for every line of its walk, also for lines without a pixel.
--             spherical_pkg gives the positions of the lights' parts. With one channel (g_channels = 1) red, green and
--             blue are equal.
-- Formats     formats_pkg: init (header), ambient, diffuse, specular, depth, colour
-- Latency     11 clocks from an accepted header to the triangle's first fragment (its first line covering a pixel)
-- Throughput  1 fragment per clock, with no bubble between spans and lines. With line records, two clocks are lost
--             between triangles if the last span has a single pixel, and one if it has two. Without line records, one
--             clock is lost after a triangle of a single pixel. A line without a pixel costs one clock if no span is
--             drawn meanwhile
-- Error       the sum of the terms is exact and rounded once; for factors and samples see formats_pkg and cosine_rom
-- Source      spherical paper, section 5 and figure 12
-- Golden twin model/golden/spherical_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;

entity spherical_shader is
  generic (
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_lights             : natural  := 1;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := 3;    -- 1: highlights are grey, with one multiplier per light
    g_powers             : natural  := 2;    -- bit i: the table of cosine to the power 2**i exists
    g_address_bits       : positive := 9;
    g_data_bits          : positive := 8
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    init_valid        : in  std_logic;
    init_ready        : out std_logic;
    init_data         : in  std_logic_vector(init_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
      g_highlight_channels) - 1 downto 0);
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
    fault             : out std_logic -- always '0'
  );
end entity;

architecture rtl of spherical_shader is

  constant c_formats     : formats_t := formats(g_exact);
  constant c_header_bits : positive  := init_channel_low(g_exact, 0);
  constant c_colour      : positive  := c_formats.colour.bits;

  -- The parts of a light in a line record.
  constant c_diffuse_part     : boolean := has_diffuse_part(g_exact, g_diffuse, g_specular);
  constant c_diffuse_channels : natural := diffuse_channels(g_channels, g_diffuse);
  constant c_diffuse_bits     : natural := diffuse_part_bits(g_exact, g_channels, g_diffuse, g_specular);
  constant c_specular_bits    : natural := specular_part_bits(g_exact, g_specular, g_highlight_channels);
  constant c_records          : boolean := record_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
    g_highlight_channels) > 0;

  -- The terms of a channel: ambient, then for each light its diffuse and its specular product.
  constant c_term_bits   : positive := c_formats.factor.bits + g_data_bits;
  constant c_light_terms : natural  := boolean'pos(g_diffuse) + boolean'pos(g_specular);
  constant c_terms       : positive := 1 + g_lights * c_light_terms;

  subtype place_t   is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length - 1 downto 0);
  subtype depth_t   is std_logic_vector(c_formats.depth.bits - 1 downto 0);
  subtype ambient_t is std_logic_vector(ambient_bits(g_exact, g_channels) - 1 downto 0);
  subtype terms_t   is std_logic_vector(c_terms * c_term_bits - 1 downto 0);

  type terms_of_channels_t is array (0 to g_channels - 1) of terms_t;

  signal init                         : std_logic_vector(init_data'range);
  signal waiting                      : std_logic; -- a vector in the init buffer
  signal taken                        : std_logic;
  signal header_valid, header_ready   : std_logic;
  signal line_ready, line_held        : std_logic;
  signal line_load, line_step         : std_logic;
  signal header_load                  : std_logic; -- load the triangle's words, with line_load or before
  signal line_carry                   : std_logic;
  signal span_load, span_step         : std_logic;
  signal y                            : std_logic_vector(fragment_y'range);
  signal x                            : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal triangle                     : std_logic_vector(fragment_triangle'range);
  signal z                            : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal walking                      : std_logic;
  signal room, coming                 : std_logic;
  signal pixel_valid                  : std_logic;

  -- Clocks after the span stage: samples, products (three clocks), sums.
  constant c_sampled    : positive := 1;
  constant c_multiplied : positive := 4;
  constant c_summed     : positive := 5;

  -- Depth is two clocks later than its pixel: its words have two parts, and registers drive its strobes.
  constant c_depth : positive := 2;

  type places_t is array (1 to c_summed) of place_t;

  type depths_t is array (c_depth + 1 to c_summed) of depth_t;

  type ambients_t is array (1 to c_multiplied) of ambient_t;

  type reg_t is record
    filled     : std_logic_vector(1 to c_summed);
    line_load  : std_logic;
    line_step  : std_logic;
    line_carry : std_logic;
    span_load  : std_logic;
    span_goes  : std_logic; -- a step without a load
  end record;

  -- The lowest bits of a fragment's fields in the queue's words.
  constant c_x_low        : natural := 0;
  constant c_y_low        : natural := c_x_low + fragment_x'length;
  constant c_triangle_low : natural := c_y_low + fragment_y'length;
  constant c_z_low        : natural := c_triangle_low + fragment_triangle'length;
  constant c_red_low      : natural := c_z_low + fragment_z'length;
  constant c_green_low    : natural := c_red_low + fragment_red'length;
  constant c_blue_low     : natural := c_green_low + fragment_green'length;

  signal r, r_next : reg_t;

  signal places                       : places_t;
  signal depths                       : depths_t;
  signal ambients                     : ambients_t;
  signal header                       : std_logic_vector(c_header_bits - 1 downto 0); -- for depth
  signal span_place                   : place_t;
  signal line_ambient, span_ambient   : ambient_t;
  signal pixel, fragment_pixel        : std_logic_vector(place_t'length + depth_t'length + 3 * c_colour - 1 downto 0);
  signal terms                                               : terms_of_channels_t;
  signal results                                             : std_logic_vector(g_channels * c_colour - 1 downto 0);
  signal colours                                             : std_logic_vector(3 * c_colour - 1 downto 0); -- red lowest

begin

  assert g_channels = 1 or g_channels = 3
    report "spherical_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;
  assert g_highlight_channels = 1 or g_highlight_channels = g_channels
    report "spherical_shader: g_highlight_channels is " & integer'image(g_highlight_channels)
    & ", not 1 (grey) or g_channels, " & integer'image(g_channels)
    severity failure;
  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "spherical_shader: depth_sum has "
    & integer'image(c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction) & " whole bits, depth " & integer'image(c_formats.depth.bits)
    severity failure;

  init_buffer : entity work.stream_register
    generic map (
      g_bits  => init_data'length,
      g_eager => true
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => init_valid,
      in_ready  => init_ready,
      in_data   => init_data,
      out_valid => waiting,
      out_ready => taken,
      out_data  => init
      );

  walker : entity work.triangle_walker
    generic map (
      g_exact => g_exact
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => header_valid,
      init_ready     => header_ready,
      init           => init(c_header_bits - 1 downto 0),
      line_ready     => line_ready,
      line_held      => line_held,
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
      busy           => walking
      );

    -- If the line stage holds a line, the vector in the init buffer is that line's record; otherwise it is a header.
  with_records : if c_records generate

    header_valid <= waiting and not line_held;
    line_ready   <= waiting;
    taken        <= line_step or line_load;
    header_load  <= not line_held;

  else generate

    header_valid <= waiting;
    line_ready   <= '1';
    taken        <= line_load;
    header_load  <= line_load;

  end generate;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.filled     := span_step & r.filled(1 to c_summed - 1);
    v.line_load  := line_load;
    v.line_step  := line_step and not line_load;
    v.line_carry := line_carry;
    v.span_load  := span_load;
    v.span_goes  := span_step and not span_load;
    if reset = '1' then
      v.filled := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r        <= r_next;
      places   <= span_place & places(1 to c_summed - 1);
      depths   <= z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction) & depths(c_depth + 1 to c_summed - 1);
      ambients <= span_ambient & ambients(1 to c_multiplied - 1);
    end if;
  end process;

  -- Keep the header: a record may replace it in the init buffer immediately. Load while no line is held, when only
  -- headers arrive.
  header_register : entity work.parameter_register
    generic map (
      g_bits => c_header_bits
      )
    port map (
      clk   => clk,
      load  => header_load,
      start => init(c_header_bits - 1 downto 0),
      value => header
      );

  depth : entity work.z_interpolator
    generic map (
      g_exact => g_exact,
      g_parts => 2
      )
    port map (
      clk        => clk,
      init       => header,
      line_load  => r.line_load,
      line_step  => r.line_step,
      line_carry => r.line_carry,
      span_load  => r.span_load,
      span_step  => r.span_goes,
      value      => z
      );

  line_ambient_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => header_load,
      start => init(c_header_bits + ambient_t'length - 1 downto c_header_bits),
      value => line_ambient
      );

    -- Keep the ambient light of the span: the line stage may already hold the next triangle.
  span_ambient_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => line_ambient,
      value => span_ambient
      );

  span_place <= triangle & y & x(fragment_x'range);

  lights : for light in 0 to g_lights - 1 generate

    constant c_low            : natural := light * (c_diffuse_bits + c_specular_bits);
    constant c_diffuse_term   : natural := (1 + light * c_light_terms) * c_term_bits;
    constant c_highlight_term : natural := c_diffuse_term + boolean'pos(g_diffuse) * c_term_bits;

    signal lit : std_logic;

    begin

      -- Step the slices whenever the walker may step, with or without a pixel, so that a register enables them.
      -- r.filled marks the clocks with a pixel.

      diffuse : if c_diffuse_part generate

        signal products : std_logic_vector((c_diffuse_channels + boolean'pos(not g_diffuse)) * c_term_bits - 1
          downto 0);

        begin

          slice : entity work.diffuse_slice
            generic map (
              g_exact        => g_exact,
              g_channels     => c_diffuse_channels,
              g_address_bits => g_address_bits,
              g_data_bits    => g_data_bits
              )
            port map (
              clk         => clk,
              part        => init(c_low + c_diffuse_bits - 1 downto c_low),
              span_load   => span_load,
              span_step   => room,
              sample_step => r.filled(c_sampled),
              lit         => lit,
              products    => products
              );

          diffuse_terms : for channel in 0 to c_diffuse_channels - 1 generate

            terms(channel)(c_diffuse_term + c_term_bits - 1 downto c_diffuse_term) <=
              products((channel + 1) * c_term_bits - 1 downto channel * c_term_bits);

          end generate;

      else generate

        lit <= '1';

      end generate;

      specular : if g_specular generate

        signal products : std_logic_vector(g_highlight_channels * c_term_bits - 1 downto 0);

        begin

          slice : entity work.specular_slice
            generic map (
              g_exact        => g_exact,
              g_channels     => g_highlight_channels,
              g_powers       => g_powers,
              g_address_bits => g_address_bits,
              g_data_bits    => g_data_bits
              )
            port map (
              clk         => clk,
              part        => init(c_low + c_diffuse_bits + c_specular_bits - 1 downto c_low + c_diffuse_bits),
              span_load   => span_load,
              span_step   => room,
              sample_step => r.filled(c_sampled),
              lit         => lit,
              products    => products
              );

          highlight_terms : for channel in 0 to g_channels - 1 generate

            -- A grey highlight is added to every channel.
            constant c_from : natural := channel * boolean'pos(g_highlight_channels > 1) * c_term_bits;

            begin

              terms(channel)(c_highlight_term + c_term_bits - 1 downto c_highlight_term) <=
                products(c_from + c_term_bits - 1 downto c_from);

          end generate;

      end generate;

  end generate;

  channels : for channel in 0 to g_channels - 1 generate

    constant c_ambient : slice_t  := ambient_channel(g_exact).ambient;
    constant c_low     : natural  := ambient_channel_low(g_exact, channel);

    begin

      -- Append zeros, so that ambient has the fraction bits of a product.
      terms(channel)(c_term_bits - 1 downto 0) <=
        ambients(c_multiplied)(c_low + c_ambient.high downto c_low + c_ambient.low) & (g_data_bits - 1 downto 0 => '0');

      sum : entity work.saturating_sum
        generic map (
          g_terms         => c_terms,
          g_term_bits     => c_term_bits,
          g_fraction_bits => c_formats.factor.fraction + g_data_bits,
          g_result_bits   => c_colour
          )
        port map (
          clk    => clk,
          enable => r.filled(c_multiplied),
          terms  => terms(channel),
          result => results((channel + 1) * c_colour - 1 downto channel * c_colour)
          );

  end generate;

  to_colours : for colour in 0 to 2 generate

    -- With one channel, copy it to all three colours.
    constant c_from : natural := colour * boolean'pos(g_channels > 1) * c_colour;

    begin

      colours((colour + 1) * c_colour - 1 downto colour * c_colour) <= results(c_from + c_colour - 1 downto c_from);

  end generate;

  pixel_valid <= r.filled(c_summed);
  pixel       <= colours & depths(c_summed) & places(c_summed);

  -- A pixel arrives five clocks after its claim, so seven places are not sufficient.
  queue : entity work.stream_queue
    generic map (
      g_bits       => pixel'length,
      g_index_bits => 4
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

  fragment_x        <= fragment_pixel(c_x_low + fragment_x'length - 1 downto c_x_low);
  fragment_y        <= fragment_pixel(c_y_low + fragment_y'length - 1 downto c_y_low);
  fragment_triangle <= fragment_pixel(c_triangle_low + fragment_triangle'length - 1 downto c_triangle_low);
  fragment_z        <= fragment_pixel(c_z_low + fragment_z'length - 1 downto c_z_low);
  fragment_red      <= fragment_pixel(c_red_low + fragment_red'length - 1 downto c_red_low);
  fragment_green    <= fragment_pixel(c_green_low + fragment_green'length - 1 downto c_green_low);
  fragment_blue     <= fragment_pixel(c_blue_low + fragment_blue'length - 1 downto c_blue_low);

  busy  <= waiting or walking or coming;
  fault <= '0';

end architecture;
