-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The processors shader: triangles to draw and lights to load in, fragments out. Two fronts find the objects to
--             shade: the rasterizer (g_objects = 0) outputs each pixel of each triangle; g_objects object processors, as the
--             processors paper draws them, output what is visible at each pixel of a strip, and shadow polygons.
--
--               init --> stream_register --> token_rasterizer --> stream_queue --> shading_pipeline --> fragment_output
--
--               init --> stream_register --> object_front ------> stream_queue --> shading_pipeline --> fragment_output
--
--               init --> stream_register --> object_front --> filter_queue --> stream_queue --> shading_pipeline --.
--                                                                  |  <-------------------------------------------'
--                                                                  '--> pixel_filter, with several subpixels
--
--             The stream_queue separates the front's multiplexers from the first step of the pipeline, and its ready from
--             the front.
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. Vectors: token_rasterizer or, in
--             their order, object_source. Filtered pixels have the background that new_frame gives (filter_queue). A
--             command with an unknown bit stops the simulation. With one channel (g_channels = 1) red, green and blue are
--             equal.
--             fault stays '1' as in token_rasterizer or object_front, and after a load or a shadow polygon of a light that
--             does not exist. On a fault, discard all fragments.
-- Formats     formats_pkg: depth, colour; processors_pkg gives the positions of the blocks of a vector
-- Latency     with the rasterizer 6 clocks from a vector taken to its first object at the pipeline, if its first line
--             covers a pixel; then that of shading_pipeline, and 1. With object processors that of object_front and
--             shading_pipeline, and 4; with the filter that of pixel_filter and 5
-- Throughput  that of shading_pipeline: in the unrolled form 1 fragment per clock, with no bubble between spans, lines
--             and triangles, except as in token_rasterizer; with object processors 1 pixel or 1 element of its list per
--             clock. In the unrolled form define, redefine and delete also wait, in each processor of their light, until
--             it is empty
-- Error       see plane_sum in formats_pkg, shading_processor; the colour is rounded once
-- Source      processors paper, sections 2 to 4; Schneider and Claussen 1988
-- Golden twin model/golden/processors_shader.hpp; with object processors model/golden/objects_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.objects_pkg.all;
use work.filter_pkg.all;

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
    g_shadows     : boolean  := false; -- only with object processors
    g_unrolled    : boolean  := true;  -- unrolled: 1 token per clock; false: folded, as published
    g_objects     : natural  := 0;     -- object processors; 0: the rasterizer
    g_subpixels   : positive := 1      -- of a pixel, with object processors: 1, 4 or 16
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
    busy              : out std_logic; -- a vector, an object or a fragment is inside
    fault             : out std_logic -- a vector was refused
  );
end entity;

architecture rtl of processors_shader is

  constant c_config  : config_t  := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_formats : formats_t := formats(g_exact);

  -- The command has the same position in a request and in a token.
  constant c_command : slice_t := pixel_header(g_exact).command;

  subtype token_t is std_logic_vector(token_bits(c_config) - 1 downto 0);

  signal init         : std_logic_vector(init_data'range);
  signal waiting      : std_logic; -- a vector is in the init buffer
  signal taken        : std_logic;
  signal front_valid  : std_logic;
  signal front_ready  : std_logic;
  signal front_token  : token_t;
  signal front_mask   : std_logic_vector(g_subpixels - 1 downto 0);
  signal front_ends   : std_logic;
  signal front_busy   : std_logic;
  signal front_fault  : std_logic;
  signal token_valid  : std_logic; -- a token for the pipeline
  signal token_ready  : std_logic;
  signal token        : token_t;
  signal token_taken  : std_logic;
  signal queued       : std_logic; -- a token waits for the pipeline
  signal next_valid   : std_logic;
  signal next_ready   : std_logic;
  signal next_token   : token_t;
  signal shading      : std_logic;
  signal light_fault  : std_logic; -- fault of the pipeline
  signal shaded_valid : std_logic;
  signal shaded_ready : std_logic;
  signal shaded       : token_t;
  signal ending       : std_logic; -- a pixel or a fragment is behind the pipeline

begin

  assert g_channels = 1 or g_channels = 3
    report "processors_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;
  assert g_objects > 0 or not (g_shadows or has_filter(g_subpixels))
    report "processors_shader: no object processors, but g_shadows is " & boolean'image(g_shadows) & " and g_subpixels "
    & integer'image(g_subpixels)
    severity failure;
  assert g_objects < 2 ** (c_formats.shadow_count.bits - 1)
    report "processors_shader: " & integer'image(g_objects) & " object processors, and shadow_count has "
    & integer'image(c_formats.shadow_count.bits) & " bits"
    severity failure;
  assert lights(c_config) <= c_most_lights
    report "processors_shader: " & integer'image(lights(c_config)) & " lights, at most " & to_string(c_most_lights)
    severity failure;
  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "processors_shader: depth_sum has "
    & integer'image(c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction) & " whole bits, depth "
    & integer'image(c_formats.depth.bits)
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

  -- Report an unknown command: as a number it would be a triangle to draw. A synthesizer has no unknown bits.
  check_command : process (clk)
  begin
    if rising_edge(clk) then
      if is_x(field_of(init, c_command)) then
        assert waiting = '0' or reset /= '0'
          report "processors_shader: a vector's command is " & to_string(field_of(init, c_command))
          severity failure;
      end if;
    end if;
  end process;

  in_front : if g_objects = 0 generate

    rasterizer : entity work.token_rasterizer
      generic map (
        g_config => c_config
        )
      port map (
        clk         => clk,
        reset       => reset,
        in_valid    => waiting,
        in_ready    => taken,
        in_vector   => init,
        token_valid => front_valid,
        token_ready => front_ready,
        token       => front_token,
        busy        => front_busy,
        fault       => front_fault
        );

    front_mask <= (others => '0');
    front_ends <= '0';

  else generate

    objects : entity work.object_front
      generic map (
        g_config    => c_config,
        g_subpixels => g_subpixels,
        g_objects   => g_objects
        )
      port map (
        clk         => clk,
        reset       => reset,
        in_valid    => waiting,
        in_ready    => taken,
        in_vector   => init,
        token_valid => front_valid,
        token_ready => front_ready,
        token       => front_token,
        token_mask  => front_mask,
        token_ends  => front_ends,
        busy        => front_busy,
        fault       => front_fault
        );

  end generate;

  token_taken <= token_valid and token_ready;

  token_queue : entity work.stream_queue
    generic map (
      g_bits       => token_t'length,
      g_index_bits => 2
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => token_taken,
      room      => token_ready,
      pending   => queued,
      in_valid  => token_taken,
      in_data   => token,
      out_valid => next_valid,
      out_ready => next_ready,
      out_data  => next_token
      );

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
      in_valid  => next_valid,
      in_ready  => next_ready,
      in_token  => next_token,
      out_valid => shaded_valid,
      out_ready => shaded_ready,
      out_token => shaded,
      busy      => shading,
      fault     => light_fault
      );

  pixels : if has_filter(g_subpixels) generate

    signal filter_valid  : std_logic;
    signal filter_ready  : std_logic;
    signal filter_token  : token_t;
    signal filter_weight : std_logic_vector(weight_bits(g_subpixels) - 1 downto 0);
    signal collecting    : std_logic; -- the filter has a strip or a fragment
    signal listed        : std_logic; -- an entry is queued
    signal background    : std_logic_vector(3 * c_formats.colour.bits - 1 downto 0);

  begin

    lists : entity work.filter_queue
      generic map (
        g_config    => c_config,
        g_subpixels => g_subpixels
        )
      port map (
        clk            => clk,
        reset          => reset,
        front_valid    => front_valid,
        front_ready    => front_ready,
        front_token    => front_token,
        front_mask     => front_mask,
        front_ends     => front_ends,
        pipeline_valid => token_valid,
        pipeline_ready => token_ready,
        pipeline_token => token,
        shaded_valid   => shaded_valid,
        shaded_ready   => shaded_ready,
        shaded_token   => shaded,
        filter_valid   => filter_valid,
        filter_ready   => filter_ready,
        filter_token   => filter_token,
        filter_weight  => filter_weight,
        filter_busy    => collecting,
        background     => background,
        busy           => listed
        );

    filter : entity work.pixel_filter
      generic map (
        g_config    => c_config,
        g_subpixels => g_subpixels
        )
      port map (
        clk               => clk,
        reset             => reset,
        background        => background,
        token_valid       => filter_valid,
        token_ready       => filter_ready,
        token             => filter_token,
        token_weight      => filter_weight,
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => fragment_triangle,
        fragment_y        => fragment_y,
        fragment_x        => fragment_x,
        fragment_z        => fragment_z,
        fragment_red      => fragment_red,
        fragment_green    => fragment_green,
        fragment_blue     => fragment_blue,
        busy              => collecting
        );

    ending <= listed or collecting;

  else generate

    token_valid <= front_valid;
    token       <= front_token;
    front_ready <= token_ready;

    fragments : entity work.fragment_output
      generic map (
        g_config => c_config
        )
      port map (
        clk               => clk,
        reset             => reset,
        token_valid       => shaded_valid,
        token_ready       => shaded_ready,
        token             => shaded,
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => fragment_triangle,
        fragment_y        => fragment_y,
        fragment_x        => fragment_x,
        fragment_z        => fragment_z,
        fragment_red      => fragment_red,
        fragment_green    => fragment_green,
        fragment_blue     => fragment_blue
        );

    ending <= fragment_valid;

  end generate;

  busy  <= waiting or front_busy or queued or shading or ending;
  fault <= front_fault or light_fault;

end architecture;
