-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The pipeline of shading processors: triangles to draw and lights to load in, a fragment for each pixel that
--             the triangles cover out.
--             stream_register -> triangle_walker -> z_interpolator, a plane_interpolator for each word of N, P and 1/w
--             -> object_stage (only with shadows) -> shading_pipeline -> saturate a channel -> stream_register
-- Contract    Both streams are valid/ready; a fragment stands still while it waits. A vector is a triangle, or it loads
--             (define, redefine, delete, new_frame): a load waits until the objects before it are in the pipeline, so
--             that all come to the processors in order. With shadows the host sends the triangles line by line, and a
--             line in the rounds that object_stage names; without, it sends neither depth nor shadow. An object's
--             command says whether it lies on another line than the one before (the first of a frame too), at the same
--             pixel, or at another one. One channel (g_channels = 1) is given out as red, green and blue.
--             fault stays '1' from when a shadow counter has left its range: the fragments are worth nothing then.
-- Formats     formats_pkg: depth, colour; processors_pkg says where the blocks of a vector lie
-- Latency     4 clocks from a vector taken to its first object at the pipeline (its first line covering a pixel), 1 more
--             with shadows; then shading_pipeline's, and 1
-- Throughput  what shading_pipeline takes: unrolled 1 fragment a clock, with no bubble between spans, lines and
--             triangles, but that a triangle takes 2 clocks at least; a load costs 3 clocks, a line that covers no pixel one where no span is drawn meanwhile
-- Error       see plane_sum in formats_pkg, shading_processor; the colour is rounded once
-- Source      processors paper, sections 3 and 4
-- Golden twin model/golden/processors_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;

entity processors_shader is
  generic (
    g_exact       : boolean  := true;
    g_channels    : positive := 3;
    g_directional : natural  := 1;     -- lights of each kind
    g_positional  : natural  := 0;
    g_spots       : natural  := 0;
    g_diffuse     : boolean  := true;
    g_specular    : boolean  := true;
    g_normalize   : boolean  := true;  -- the ambient processor can normalize N
    g_shadows     : boolean  := false;
    g_unrolled    : boolean  := true   -- a token a clock; false: a processor as published
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    init_valid        : in  std_logic;
    init_ready        : out std_logic;
    init_data         : in  std_logic_vector(init_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows)) - 1 downto 0);
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
    fault             : out std_logic -- a shadow counter has left its range
  );
end entity;

architecture rtl of processors_shader is

  constant c_config      : config_t         := config(g_exact, g_channels, g_directional, g_positional, g_spots,
    g_diffuse, g_specular, g_normalize, g_shadows);
  constant c_formats     : formats_t        := formats(g_exact);
  constant c_request     : request_header_t := request_header(g_exact);
  constant c_pixel       : pixel_header_t   := pixel_header(g_exact);
  constant c_walk_bits   : positive         := init_channel_low(true, 0);
  constant c_plane_bits  : positive         := plane_channel_low(g_exact, 0);
  constant c_vector_bits : positive         := c_formats.vector.bits;
  constant c_planes      : positive         := planes(c_config);
  constant c_colour      : positive         := c_formats.colour.bits;
  constant c_radiance    : positive         := c_formats.radiance.bits;

  subtype command_t  is std_logic_vector(c_formats.command.bits - 1 downto 0);
  subtype request_t  is std_logic_vector(c_request.normalize.high downto 0);
  subtype material_t is std_logic_vector(material_bits(c_config) - 1 downto 0);
  subtype token_t    is std_logic_vector(token_bits(c_config) - 1 downto 0);
  subtype radiance_t is std_logic_vector(c_radiance - 1 downto 0);
  subtype pixel_t    is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length - 1 downto 0);

  function command_word (command : natural) return command_t is
  begin
    return std_logic_vector(to_unsigned(command, command_t'length));
  end function;

  -- The colour before the first processor: what rounds it, where it has a fraction.
  function first_radiance return radiance_t is
    variable value : radiance_t := (others => '0');
  begin
    if c_formats.radiance.fraction > 0 then
      value(c_formats.radiance.fraction - 1) := '1';
    end if;
    return value;
  end function;

  constant c_first_radiance : radiance_t := first_radiance;

  -- Where the object before lies.
  type reg_t is record
    drawn : std_logic; -- there is one in this frame
    y     : std_logic_vector(fragment_y'range);
    x     : std_logic_vector(fragment_x'range);
  end record;

  signal r, r_next : reg_t;

  signal init                      : std_logic_vector(init_data'range);
  signal waiting                   : std_logic; -- a vector in the init buffer
  signal taken                     : std_logic;
  signal command                   : command_t;
  signal loads                     : std_logic; -- that vector
  signal load_valid                : std_logic;
  signal walk                      : std_logic_vector(c_walk_bits - 1 downto 0);
  signal walk_valid, walk_ready    : std_logic;
  signal line_load, line_step      : std_logic;
  signal line_carry                : std_logic;
  signal span_load, span_step      : std_logic;
  signal line_goes, span_goes      : std_logic; -- a step that is no load, too
  signal y                         : std_logic_vector(fragment_y'range);
  signal x                         : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal triangle                  : std_logic_vector(fragment_triangle'range);
  signal z                         : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal walking                   : std_logic;
  signal drawn, drawn_ready        : std_logic;
  signal line_request              : request_t;
  signal span_request              : request_t;
  signal line_material             : material_t;
  signal span_material             : material_t;
  signal vectors                   : std_logic_vector(c_planes * c_vector_bits - 1 downto 0); -- N lowest
  signal span_token                : token_t;
  signal objects_clear             : std_logic;
  signal objects_busy              : std_logic;
  signal objects_idle              : std_logic; -- nothing is in the object stage, and it is not being cleared
  signal object_valid              : std_logic;
  signal object_token              : token_t;
  signal place_command             : command_t; -- of an object
  signal token_valid, token_ready  : std_logic;
  signal token                     : token_t;
  signal shading                   : std_logic;
  signal shaded_valid              : std_logic;
  signal shaded_ready, shaded_step : std_logic;
  signal shaded                    : token_t;
  signal results                   : std_logic_vector(g_channels * c_colour - 1 downto 0);
  signal colours, fragment_colours : std_logic_vector(3 * c_colour - 1 downto 0); -- red lowest
  signal shaded_pixel, out_pixel   : pixel_t;
  signal out_valid                 : std_logic;

begin

  assert g_channels = 1 or g_channels = 3
    report "processors_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;
  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "processors_shader: depth_sum has "
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

  command <= init(c_request.command.high downto c_request.command.low);
  loads   <= '1' when command = command_word(c_new_frame) or command = command_word(c_define) or
    command = command_word(c_redefine) or command = command_word(c_delete) else '0';

  -- A load goes past the walker, which holds nothing then.
  walk_valid <= waiting and not loads;
  load_valid <= waiting and loads and not walking and objects_idle;
  taken      <= token_ready and load_valid when loads = '1' else line_load;

  walk <= init(walk_low(c_config) + c_walk_bits - 1 downto walk_low(c_config));

  walker : entity work.triangle_walker
    generic map (
      g_exact => true
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => walk_valid,
      init_ready     => walk_ready,
      init           => walk,
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
      fragment_valid => drawn,
      fragment_ready => drawn_ready,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => walking
      );

  line_goes <= line_step and not line_load;
  span_goes <= span_step and not span_load;

  depth : entity work.z_interpolator
    generic map (
      g_exact => true
      )
    port map (
      clk        => clk,
      init       => walk,
      line_load  => line_load,
      line_step  => line_goes,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_goes,
      value      => z
      );

  interpolated : for plane in 0 to c_planes - 1 generate

    constant c_sum_bits : positive := c_formats.plane_sum.bits;
    constant c_low      : natural  := plane_low(c_config, plane);

    signal value : std_logic_vector(c_sum_bits - 1 downto 0);

    begin

      interpolator : entity work.plane_interpolator
        generic map (
          g_bits => c_sum_bits
          )
        port map (
          clk        => clk,
          plane      => init(c_low + c_plane_bits - 1 downto c_low),
          line_load  => line_load,
          line_step  => line_goes,
          line_carry => line_carry,
          span_load  => span_load,
          span_step  => span_goes,
          value      => value
          );

        -- The host has added half a step of what this drops.
      vectors((plane + 1) * c_vector_bits - 1 downto plane * c_vector_bits) <=
        value(c_sum_bits - 1 downto c_sum_bits - c_vector_bits);

  end generate;

  line_request_register : entity work.parameter_register
    generic map (
      g_bits => request_t'length
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(request_t'range),
      value => line_request
      );

  line_material_register : entity work.parameter_register
    generic map (
      g_bits => material_t'length
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => init(init_material_low(c_config) + material_t'high downto init_material_low(c_config)),
      value => line_material
      );

    -- The line stage may hold the next triangle already.
  span_request_register : entity work.parameter_register
    generic map (
      g_bits => request_t'length
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => line_request,
      value => span_request
      );

  span_material_register : entity work.parameter_register
    generic map (
      g_bits => material_t'length
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => line_material,
      value => span_material
      );

  make_token : process (all)
    variable v : token_t;
  begin
    v := (others => '0');
    v(request_t'range)                              := span_request;
    v(c_pixel.triangle.high downto c_pixel.triangle.low) := triangle;
    v(c_pixel.y.high downto c_pixel.y.low)               := y;
    v(c_pixel.x.high downto c_pixel.x.low)               := x(fragment_x'range);
    v(c_pixel.z.high downto c_pixel.z.low)               := z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);
    -- N, P and 1/w follow one another in a token too.
    v(normal_low(c_config, 0) + vectors'high downto normal_low(c_config, 0)) := vectors;
    v(material_low(c_config) + material_t'high downto material_low(c_config)) := span_material;
    for channel in 0 to g_channels - 1 loop
      v(radiance_low(c_config, channel) + c_radiance - 1 downto radiance_low(c_config, channel)) := c_first_radiance;
    end loop;
    span_token <= v;
  end process;

  with_objects : if g_shadows generate

    begin

      objects : entity work.object_stage
        generic map (
          g_exact => g_exact,
          g_bits  => token_t'length
          )
        port map (
          clk       => clk,
          reset     => reset,
          clear     => objects_clear,
          in_valid  => drawn,
          in_ready  => drawn_ready,
          in_token  => span_token,
          out_valid => object_valid,
          out_ready => token_ready,
          out_token => object_token,
          busy      => objects_busy,
          idle      => objects_idle
          );

  else generate

    object_valid <= drawn;
    object_token <= span_token;
    drawn_ready  <= token_ready;
    objects_busy <= '0';
    objects_idle <= '1';

  end generate;

  place_command <= command_word(c_new_scanline) when r.drawn = '0' or object_token(c_pixel.y.high downto c_pixel.y.low)
    /= r.y else command_word(c_new_object) when object_token(c_pixel.x.high downto c_pixel.x.low) = r.x else
    command_word(c_new_pixel);

  token_valid   <= object_valid or load_valid;
  objects_clear <= '1' when load_valid = '1' and token_ready = '1' and command = command_word(c_new_frame) else '0';

  choose_token : process (all)
    variable v : token_t;
  begin
    if load_valid = '1' then
      v := (others => '0');
      v(load_bits(c_config) - 1 downto 0) := init(load_bits(c_config) - 1 downto 0);
    else
      v := object_token;
      if object_token(c_pixel.command.high downto c_pixel.command.low) /= command_word(c_shadow) then
        v(c_pixel.command.high downto c_pixel.command.low) := place_command;
      end if;
    end if;
    token <= v;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if object_valid = '1' and token_ready = '1' and object_token(c_pixel.command.high downto c_pixel.command.low)
      /= command_word(c_shadow) then
      v.drawn := '1';
      v.y     := object_token(c_pixel.y.high downto c_pixel.y.low);
      v.x     := object_token(c_pixel.x.high downto c_pixel.x.low);
    end if;
    if reset = '1' or objects_clear = '1' then
      v.drawn := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  pipeline : entity work.shading_pipeline
    generic map (
      g_exact       => g_exact,
      g_channels    => g_channels,
      g_directional => g_directional,
      g_positional  => g_positional,
      g_spots       => g_spots,
      g_diffuse     => g_diffuse,
      g_specular    => g_specular,
      g_normalize   => g_normalize,
      g_shadows     => g_shadows,
      g_unrolled    => g_unrolled
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => token_valid,
      in_ready  => token_ready,
      in_token  => token,
      out_valid => shaded_valid,
      out_ready => shaded_ready,
      out_token => shaded,
      busy      => shading,
      fault     => fault
      );

  channels : for channel in 0 to g_channels - 1 generate

    constant c_low : natural := radiance_low(c_config, channel);

    signal value : std_logic_vector(c_radiance + 1 downto 0);

    begin

      value <= "00" & shaded(c_low + c_radiance - 1 downto c_low);

      to_result : entity work.saturate
        generic map (
          g_value_bits    => c_radiance + 2,
          g_fraction_bits => c_formats.radiance.fraction,
          g_result_bits   => c_colour
          )
        port map (
          value  => value,
          result => results((channel + 1) * c_colour - 1 downto channel * c_colour)
          );

  end generate;

  to_colours : for colour in 0 to 2 generate

    -- One channel is all three.
    constant c_from : natural := colour * boolean'pos(g_channels > 1) * c_colour;

    begin

      colours((colour + 1) * c_colour - 1 downto colour * c_colour) <= results(c_from + c_colour - 1 downto c_from);

  end generate;

  shaded_pixel <= shaded(c_pixel.triangle.high downto c_pixel.triangle.low)
    & shaded(c_pixel.y.high downto c_pixel.y.low) & shaded(c_pixel.x.high downto c_pixel.x.low);
  shaded_step  <= shaded_valid and shaded_ready;

  -- The register behind the shader.
  out_stage : entity work.stream_register
    generic map (
      g_bits => pixel_t'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => shaded_valid,
      in_ready  => shaded_ready,
      in_data   => shaded_pixel,
      out_valid => out_valid,
      out_ready => fragment_ready,
      out_data  => out_pixel
      );

  depth_out : entity work.parameter_register
    generic map (
      g_bits => c_formats.depth.bits
      )
    port map (
      clk   => clk,
      load  => shaded_step,
      start => shaded(c_pixel.z.high downto c_pixel.z.low),
      value => fragment_z
      );

  colour_out : entity work.parameter_register
    generic map (
      g_bits => 3 * c_colour
      )
    port map (
      clk   => clk,
      load  => shaded_step,
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
  busy           <= waiting or walking or objects_busy or shading or out_valid;

end architecture;
