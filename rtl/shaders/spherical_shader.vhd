-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The spherical shader: a header a triangle and a record for each of its lines in, a fragment for each
--             pixel that the triangle covers out.
--             stream_register -> triangle_walker -> z_interpolator, a diffuse_slice and a specular_slice a light
--             -> a saturating_sum a channel -> stream_register
--             What no effect asks for is not there: no diffuse_slice where neither diffuse light nor (preset exact) the
--             horizon of a highlight needs one, no line records where a light has no part in them.
-- Contract    Both streams are valid/ready; a fragment stands still while it waits. A triangle's header (walk, depth,
--             ambient) is followed by a record for every line of its walk, those without a pixel included;
--             spherical_pkg says where the lights' parts lie. One channel (g_channels = 1) is given out as red, green
--             and blue.
-- Formats     formats_pkg: init (header), ambient, diffuse, specular, depth, colour
-- Latency     7 clocks from a header taken to the triangle's first fragment (its first line covering a pixel)
-- Throughput  1 fragment a clock, with no bubble between spans and lines; between triangles two clocks are lost where
--             the last span has a single pixel, one where it has two; without line records one behind a triangle of a
--             single pixel. Lines that cover no pixel cost a clock each
--             where no span is being drawn meanwhile.
-- Error       the sum of the terms is exact, and rounded once; their factors and samples: see formats_pkg, cosine_rom
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
    g_highlight_channels : positive := 3;    -- 1: every highlight is grey, one multiplier a light does
    g_powers             : natural  := 2;    -- bit i: the table of cosine to the power 2**i is there
    g_address_bits       : positive := 9;
    g_data_bits          : positive := 8;
    g_probe              : boolean  := false -- bring the stages' registers out
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
    busy              : out std_logic; -- something is on its way
    fault             : out std_logic; -- nothing here can go wrong
    probe             : out std_logic_vector(probe_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
      g_highlight_channels) - 1 downto 0)
  );
end entity;

architecture rtl of spherical_shader is

  constant c_formats     : formats_t      := formats(g_exact);
  constant c_probe       : probe_header_t := probe_header(g_exact);
  constant c_header_bits : positive       := init_channel_low(g_exact, 0);
  constant c_colour      : positive       := c_formats.colour.bits;

  -- The parts of a light in a line record, and in the probe.
  constant c_diffuse_part     : boolean := has_diffuse_part(g_exact, g_diffuse, g_specular);
  constant c_diffuse_channels : natural := diffuse_channels(g_channels, g_diffuse);
  constant c_diffuse_bits     : natural := diffuse_part_bits(g_exact, g_channels, g_diffuse, g_specular);
  constant c_specular_bits    : natural := specular_part_bits(g_exact, g_specular, g_highlight_channels);
  constant c_diffuse_probe    : natural := diffuse_part_probe_bits(g_exact, g_channels, g_diffuse, g_specular);
  constant c_specular_probe   : natural := specular_part_probe_bits(g_exact, g_specular, g_highlight_channels);
  constant c_records          : boolean := record_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
    g_highlight_channels) > 0;

  -- What a channel sums: ambient, then for each light its diffuse and its specular product.
  constant c_term_bits   : positive := c_formats.factor.bits + g_data_bits;
  constant c_light_terms : natural  := boolean'pos(g_diffuse) + boolean'pos(g_specular);
  constant c_terms       : positive := 1 + g_lights * c_light_terms;

  subtype pixel_t   is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length - 1 downto 0);
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
  signal line_carry                   : std_logic;
  signal span_load, span_step         : std_logic;
  signal line_y, y                    : std_logic_vector(fragment_y'range);
  signal line_start, line_stop, x     : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal triangle                     : std_logic_vector(fragment_triangle'range);
  signal line_z, z                    : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal walking                      : std_logic;
  signal drawn, drawn_ready           : std_logic;
  signal sample_valid, sample_ready   : std_logic;
  signal product_valid, product_ready : std_logic;
  signal out_valid                    : std_logic;

  -- The strobes that hand a pixel on to the next stage.
  signal sample_step, product_step : std_logic;

  -- Beside the angles, stage by stage.
  signal span_pixel, sample_pixel, product_pixel, out_pixel  : pixel_t;
  signal span_depth, sample_depth, product_depth             : depth_t;
  signal line_ambient, span_ambient                          : ambient_t;
  signal sample_ambient, product_ambient                     : ambient_t;
  signal terms                                               : terms_of_channels_t;
  signal results                                             : std_logic_vector(g_channels * c_colour - 1 downto 0);
  signal colours, fragment_colours                           : std_logic_vector(3 * c_colour - 1 downto 0); -- red lowest

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
      g_bits => init_data'length
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
      line_y         => line_y,
      line_start     => line_start,
      line_stop      => line_stop,
      fragment_valid => drawn,
      fragment_ready => drawn_ready,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => walking
      );

    -- While the line stage holds a line, the buffer's vector is that line's record; else it is a header.
  with_records : if c_records generate

    header_valid <= waiting and not line_held;
    line_ready   <= waiting;
    taken        <= line_step or header_ready;

  else generate

    header_valid <= waiting;
    line_ready   <= '1';
    taken        <= header_ready;

  end generate;

  depth : entity work.z_interpolator
    generic map (
      g_exact => g_exact
      )
    port map (
      clk        => clk,
      init       => init(c_header_bits - 1 downto 0),
      line_load  => line_load,
      line_step  => line_step,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_step,
      line_value => line_z,
      value      => z
      );

  line_ambient_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(c_header_bits + ambient_t'length - 1 downto c_header_bits),
      value => line_ambient
      );

    -- The line stage may hold the next triangle already.
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

  span_pixel <= triangle & y & x(fragment_x'range);
  span_depth <= z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);

  -- The sample stage: one stream_register, its payload in words of at most 64 bits.
  sample_stage : entity work.stream_register
    generic map (
      g_bits => pixel_t'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => drawn,
      in_ready  => drawn_ready,
      in_data   => span_pixel,
      out_valid => sample_valid,
      out_ready => sample_ready,
      out_data  => sample_pixel
      );

  sample_depth_register : entity work.parameter_register
    generic map (
      g_bits => depth_t'length
      )
    port map (
      clk   => clk,
      load  => span_step,
      start => span_depth,
      value => sample_depth
      );

  sample_ambient_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => span_step,
      start => span_ambient,
      value => sample_ambient
      );

  sample_step <= sample_valid and sample_ready;

  -- The product stage, alike.
  product_stage : entity work.stream_register
    generic map (
      g_bits => pixel_t'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => sample_valid,
      in_ready  => sample_ready,
      in_data   => sample_pixel,
      out_valid => product_valid,
      out_ready => product_ready,
      out_data  => product_pixel
      );

  product_depth_register : entity work.parameter_register
    generic map (
      g_bits => depth_t'length
      )
    port map (
      clk   => clk,
      load  => sample_step,
      start => sample_depth,
      value => product_depth
      );

  product_ambient_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => sample_step,
      start => sample_ambient,
      value => product_ambient
      );

  product_step <= product_valid and product_ready;

  lights : for light in 0 to g_lights - 1 generate

    constant c_low            : natural := light * (c_diffuse_bits + c_specular_bits);
    constant c_probe_low      : natural := probe_channel_low(g_exact, 0) + light * (c_diffuse_probe + c_specular_probe);
    constant c_specular_low   : natural := c_probe_low + c_diffuse_probe;
    constant c_diffuse_term   : natural := (1 + light * c_light_terms) * c_term_bits;
    constant c_highlight_term : natural := c_diffuse_term + boolean'pos(g_diffuse) * c_term_bits;

    signal lit : std_logic;

    begin

      diffuse : if c_diffuse_part generate

        constant c_fields  : diffuse_probe_header_t  := diffuse_probe_header(g_exact);
        constant c_product : diffuse_probe_channel_t := diffuse_probe_channel(g_exact);

        signal angle    : std_logic_vector(c_formats.angle.bits - 1 downto 0);
        signal in_range : std_logic;
        signal sample   : std_logic_vector(g_data_bits - 1 downto 0);
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
              span_step   => span_step,
              sample_step => sample_step,
              lit         => lit,
              angle       => angle,
              in_range    => in_range,
              sample      => sample,
              products    => products
              );

          diffuse_terms : for channel in 0 to c_diffuse_channels - 1 generate

            terms(channel)(c_diffuse_term + c_term_bits - 1 downto c_diffuse_term) <=
              products((channel + 1) * c_term_bits - 1 downto channel * c_term_bits);

          end generate;

          probed_diffuse : if g_probe generate

            probe(c_probe_low + c_fields.angle.high downto c_probe_low + c_fields.angle.low) <= angle;
            probe(c_probe_low + c_fields.in_range.low)                                         <= in_range;
            probe(c_probe_low + c_fields.sample.high downto c_probe_low + c_fields.sample.low) <=
              std_logic_vector(resize(unsigned(sample), c_formats.sample_word.bits));

            probed_products : for channel in 0 to c_diffuse_channels - 1 generate

              constant c_block : natural := c_probe_low + diffuse_probe_channel_low(g_exact, channel);

              begin

                probe(c_block + c_product.product.high downto c_block + c_product.product.low) <=
                  std_logic_vector(resize(unsigned(products((channel + 1) * c_term_bits - 1 downto channel
                  * c_term_bits)), c_formats.product_word.bits));

            end generate;

          end generate;

      else generate

        lit <= '1';

      end generate;

      specular : if g_specular generate

        constant c_fields  : specular_probe_header_t  := specular_probe_header(g_exact);
        constant c_product : specular_probe_channel_t := specular_probe_channel(g_exact);

        signal angle    : std_logic_vector(c_formats.angle.bits - 1 downto 0);
        signal in_range : std_logic;
        signal sample   : std_logic_vector(g_data_bits - 1 downto 0);
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
              span_step   => span_step,
              sample_step => sample_step,
              lit         => lit,
              angle       => angle,
              in_range    => in_range,
              sample      => sample,
              products    => products
              );

          highlight_terms : for channel in 0 to g_channels - 1 generate

            -- A grey highlight goes to every channel.
            constant c_from : natural := channel * boolean'pos(g_highlight_channels > 1) * c_term_bits;

            begin

              terms(channel)(c_highlight_term + c_term_bits - 1 downto c_highlight_term) <=
                products(c_from + c_term_bits - 1 downto c_from);

          end generate;

          probed_specular : if g_probe generate

            probe(c_specular_low + c_fields.angle.high downto c_specular_low + c_fields.angle.low) <= angle;
            probe(c_specular_low + c_fields.in_range.low)                                            <= in_range;
            probe(c_specular_low + c_fields.sample.high downto c_specular_low + c_fields.sample.low) <=
              std_logic_vector(resize(unsigned(sample), c_formats.sample_word.bits));

            probed_products : for channel in 0 to g_highlight_channels - 1 generate

              constant c_block : natural := c_specular_low + specular_probe_channel_low(g_exact, channel);

              begin

                probe(c_block + c_product.product.high downto c_block + c_product.product.low) <=
                  std_logic_vector(resize(unsigned(products((channel + 1) * c_term_bits - 1 downto channel
                  * c_term_bits)), c_formats.product_word.bits));

            end generate;

          end generate;

      end generate;

  end generate;

  channels : for channel in 0 to g_channels - 1 generate

    constant c_ambient : slice_t  := ambient_channel(g_exact).ambient;
    constant c_low     : natural  := ambient_channel_low(g_exact, channel);

    begin

      -- As many fraction bits as a product has.
      terms(channel)(c_term_bits - 1 downto 0) <=
        product_ambient(c_low + c_ambient.high downto c_low + c_ambient.low) & (g_data_bits - 1 downto 0 => '0');

      sum : entity work.saturating_sum
        generic map (
          g_terms         => c_terms,
          g_term_bits     => c_term_bits,
          g_fraction_bits => c_formats.factor.fraction + g_data_bits,
          g_result_bits   => c_colour
          )
        port map (
          terms  => terms(channel),
          result => results((channel + 1) * c_colour - 1 downto channel * c_colour)
          );

  end generate;

  to_colours : for colour in 0 to 2 generate

    -- One channel is all three.
    constant c_from : natural := colour * boolean'pos(g_channels > 1) * c_colour;

    begin

      colours((colour + 1) * c_colour - 1 downto colour * c_colour) <= results(c_from + c_colour - 1 downto c_from);

  end generate;

  -- The register behind the shader.
  out_stage : entity work.stream_register
    generic map (
      g_bits => pixel_t'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => product_valid,
      in_ready  => product_ready,
      in_data   => product_pixel,
      out_valid => out_valid,
      out_ready => fragment_ready,
      out_data  => out_pixel
      );

  depth_out : entity work.parameter_register
    generic map (
      g_bits => depth_t'length
      )
    port map (
      clk   => clk,
      load  => product_step,
      start => product_depth,
      value => fragment_z
      );

  colour_out : entity work.parameter_register
    generic map (
      g_bits => 3 * c_colour
      )
    port map (
      clk   => clk,
      load  => product_step,
      start => colours,
      value => fragment_colours
      );

  fragment_x        <= out_pixel(fragment_x'range);
  fragment_y        <= out_pixel(fragment_x'length + fragment_y'length - 1 downto fragment_x'length);
  fragment_triangle <= out_pixel(out_pixel'high downto fragment_x'length + fragment_y'length);

  fragment_red   <= fragment_colours(c_colour - 1 downto 0);
  fragment_green <= fragment_colours(2 * c_colour - 1 downto c_colour);
  fragment_blue  <= fragment_colours(3 * c_colour - 1 downto 2 * c_colour);

  fragment_valid <= out_valid;
  busy           <= waiting or walking or sample_valid or product_valid or out_valid;
  fault          <= '0';

  probed : if g_probe generate

    probe(c_probe.line_event.low)                                <= span_load;
    probe(c_probe.span_event.low)                                <= span_step;
    probe(c_probe.sample_event.low)                              <= sample_step;
    probe(c_probe.product_event.low)                             <= product_step;
    probe(c_probe.line_y.high downto c_probe.line_y.low)         <= line_y;
    probe(c_probe.line_start.high downto c_probe.line_start.low) <= line_start;
    probe(c_probe.line_stop.high downto c_probe.line_stop.low)   <= line_stop;
    probe(c_probe.line_z.high downto c_probe.line_z.low)         <= line_z;
    probe(c_probe.span_y.high downto c_probe.span_y.low)         <= y;
    probe(c_probe.span_x.high downto c_probe.span_x.low)         <= x;
    probe(c_probe.span_z.high downto c_probe.span_z.low)         <= z;

    probed_carry : if g_exact generate
      probe(c_probe.line_carry.low) <= line_carry;
    end generate;

  else generate

    probe <= (others => '0');

  end generate;

end architecture;
