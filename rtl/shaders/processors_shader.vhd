-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The processors shader: triangles to draw and lights to load in, one fragment per covered pixel out.
--
--               init --> stream_register --+--> token_rasterizer --> object_stage --+--> token_order --> shading_pipeline
--                                          |     triangles         (with shadows)   |                          |
--                                          +------ loads ---------------------------+      fragment_output <---+
--
--             A stream_queue before the pipeline separates the multiplexers of token_order from its first step, and its
--             ready from the rasterizer.
--
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. A vector is a triangle or a load
--             (define, redefine, delete, new_frame). A load waits until the rasterizer and the object stage are empty,
--             so that all reach the processors in order. With shadows, the host sends the triangles line by line, and each
--             line in the rounds of object_stage. Without shadows it sends neither depth nor shadow: depth would be
--             drawn like a triangle, shadow would draw nothing, and fault would stay '0'. A load of a light that does
--             not exist changes nothing, and fault stays '0'. A command with an unknown bit stops the simulation. With
--             one channel (g_channels = 1) red, green and blue are equal.
--             fault stays '1' once a shadow counter has left its range. On a fault, discard all fragments.
-- Formats     formats_pkg: depth, colour; processors_pkg gives the positions of the blocks of a vector
-- Latency     6 clocks from a vector taken to its first object at the pipeline, if its first line covers a pixel, 1
--             more with shadows; then that of shading_pipeline, and 1
-- Throughput  that of shading_pipeline: in the unrolled form 1 fragment per clock, with no bubble between spans, lines
--             and triangles. Exceptions: a triangle takes at least 2 clocks; a line without a pixel takes 1 clock if no
--             span is drawn meanwhile; the first load after a triangle takes 4 clocks, each further load 1. In the
--             unrolled form define, redefine and delete also wait, in each processor of their light, until it is empty.
--             With shadows, objects after new_frame wait until the columns are cleared
-- Error       see plane_sum in formats_pkg, shading_processor; the colour is rounded once
-- Source      processors paper, sections 3 and 4
-- Golden twin model/golden/processors_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

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
    g_unrolled    : boolean  := true   -- unrolled: 1 token per clock; false: folded, as published
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
    fault             : out std_logic -- a shadow counter has left its range
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
  signal command      : command_t;
  signal load_command : std_logic; -- the vector is a load
  signal load_valid   : std_logic;
  signal load_ready   : std_logic;
  signal draw_valid   : std_logic;
  signal draw_ready   : std_logic;
  signal drawing      : std_logic; -- the rasterizer holds a triangle
  signal drawn_valid  : std_logic;
  signal drawn_ready  : std_logic;
  signal drawn        : token_t;
  signal object_valid : std_logic;
  signal object_ready : std_logic;
  signal object       : token_t;
  signal objects_busy : std_logic;
  signal objects_idle : std_logic; -- the object stage is empty and is not being cleared
  signal frame_start  : std_logic;
  signal token_valid  : std_logic;
  signal token_ready  : std_logic;
  signal token        : token_t;
  signal token_taken  : std_logic;
  signal queued       : std_logic; -- a token waits for the pipeline
  signal next_valid   : std_logic;
  signal next_ready   : std_logic;
  signal next_token   : token_t;
  signal shading      : std_logic;
  signal shaded_valid : std_logic;
  signal shaded_ready : std_logic;
  signal shaded       : token_t;

begin

  assert g_channels = 1 or g_channels = 3
    report "processors_shader: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
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

  command      <= command_of(g_exact, init);
  load_command <= '1' when command = c_new_frame or command = c_define or command = c_redefine or command = c_delete
    else '0';

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

  -- A load bypasses the rasterizer, which is empty at that time.
  draw_valid <= waiting and not load_command;
  load_valid <= waiting and load_command and not drawing and objects_idle;
  taken      <= load_ready and load_valid when load_command = '1' else draw_ready;

  rasterizer : entity work.token_rasterizer
    generic map (
      g_config => c_config
      )
    port map (
      clk         => clk,
      reset       => reset,
      init_valid  => draw_valid,
      init_ready  => draw_ready,
      init        => init,
      token_valid => drawn_valid,
      token_ready => drawn_ready,
      token       => drawn,
      busy        => drawing
      );

  objects : if g_shadows generate

    stage : entity work.object_stage
      generic map (
        g_exact => g_exact,
        g_bits  => token_t'length
        )
      port map (
        clk       => clk,
        reset     => reset,
        clear     => frame_start,
        in_valid  => drawn_valid,
        in_ready  => drawn_ready,
        in_token  => drawn,
        out_valid => object_valid,
        out_ready => object_ready,
        out_token => object,
        busy      => objects_busy,
        idle      => objects_idle
        );

  else generate

    object_valid <= drawn_valid;
    object       <= drawn;
    drawn_ready  <= object_ready;
    objects_busy <= '0';
    objects_idle <= '1';

  end generate;

  order : entity work.token_order
    generic map (
      g_config => c_config
      )
    port map (
      clk          => clk,
      reset        => reset,
      load_valid   => load_valid,
      load_ready   => load_ready,
      load         => init(load_bits(c_config) - 1 downto 0),
      object_valid => object_valid,
      object_ready => object_ready,
      object       => object,
      token_valid  => token_valid,
      token_ready  => token_ready,
      token        => token,
      frame_start  => frame_start
      );

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
      fault     => fault
      );

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

  busy <= waiting or drawing or objects_busy or queued or shading or fragment_valid;

end architecture;
