-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Converts the host's vectors to tokens of the shading processors. A triangle (new_object) becomes one token per
--             covered pixel, with the depth, N, P and 1/w of the pixel, and the material. A load passes as it is. Line and
--             span keep their own copy of the triangle's words: the line stage may already hold the next triangle while
--             the span stage walks this one.
--
--               vector --+--> triangle_walker --> z_interpolator, a plane_interpolator per word of N, P and 1/w --+--> token
--                        +--> request and material, of line and span ---------------------------------------------+
--                        +--> loads ------------------------------------------------------------------------------+
--
-- Contract    Both streams are valid/ready. in_ready is '1' when the triangle's first line is loaded. in_vector must be
--             stable from the clock before, in which the walker reads it. A load waits until no triangle is inside. A token
--             does not change while it waits. A vector with another command is dropped; fault stays '1' from then on.
--             busy: a triangle is inside.
-- Formats     in_vector: processors_pkg; token: token_pkg, without a colour
-- Latency     3 clocks from a triangle offered (in_valid) to its first token, if its first line covers a pixel; 0 for a
--             load
-- Throughput  1 token per clock, with no bubble between spans, lines and triangles. Exceptions: a triangle takes at
--             least 2 clocks; a line without a pixel takes 1 clock if no span is drawn meanwhile; the first load after a
--             triangle takes 4 clocks, each further load 1
-- Error       see plane_sum in formats_pkg
-- Source      processors paper, section 2: the object processors interpolate N and P linearly
-- Golden twin model/golden/token_rasterizer.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

entity token_rasterizer is
  generic (
    g_config : config_t := c_default_config
  );
  port (
    clk         : in  std_logic;
    reset       : in  std_logic;
    in_valid    : in  std_logic;
    in_ready    : out std_logic;
    in_vector   : in  std_logic_vector(init_bits(g_config) - 1 downto 0);
    token_valid : out std_logic;
    token_ready : in  std_logic;
    token       : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    busy        : out std_logic;
    fault       : out std_logic
  );
end entity;

architecture rtl of token_rasterizer is

  constant c_exact       : boolean          := g_config.exact;
  constant c_formats     : formats_t        := formats(c_exact);
  constant c_request     : request_header_t := request_header(c_exact);
  constant c_pixel       : pixel_header_t   := pixel_header(c_exact);
  constant c_planes      : positive         := planes(g_config);
  constant c_plane_bits  : positive         := plane_bits(c_exact);
  constant c_vector_bits : positive         := c_formats.vector.bits;

  -- The headers of a request and of a token begin with the same fields.
  subtype request_t is std_logic_vector(c_request.normalize.high downto 0);
  subtype material_t is std_logic_vector(material_bits(g_config) - 1 downto 0);

  type reg_t is record
    fault : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal command       : command_t;
  signal draws, loads  : std_logic; -- kind of the vector
  signal drawn_valid   : std_logic;
  signal drawing       : std_logic; -- a triangle is inside
  -- The walk is that of preset exact in either preset.
  signal walk          : std_logic_vector(init_bits(true, 0) - 1 downto 0);
  signal walk_ready    : std_logic; -- the walker reads the triangle
  signal line_load     : std_logic;
  signal line_step     : std_logic;
  signal line_carry    : std_logic;
  signal line_advance  : std_logic; -- a step without a load
  signal span_load     : std_logic;
  signal span_step     : std_logic;
  signal span_advance  : std_logic;
  signal triangle      : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal y             : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal x             : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal z             : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal vectors       : std_logic_vector(c_planes * c_vector_bits - 1 downto 0); -- N lowest
  signal line_request  : request_t;
  signal line_material : material_t;
  signal span_request  : request_t;
  signal span_material : material_t;

begin

  assert c_request.normalize.high = c_pixel.normalize.high
    report "token_rasterizer: normalize is bit " & integer'image(c_request.normalize.high) & " of a request, bit "
    & integer'image(c_pixel.normalize.high) & " of a token"
    severity failure;

  command <= command_of(c_exact, in_vector);
  draws   <= is_object(command);
  loads   <= is_load(command) and not drawing;
  walk    <= in_vector(walk_low(g_config) + walk'high downto walk_low(g_config));

  in_ready    <= line_load when draws = '1' else token_ready and loads when is_load(command) = '1' else '1';
  token_valid <= drawn_valid or (in_valid and loads);
  busy        <= drawing;
  fault       <= r.fault;

  walker : entity work.triangle_walker
    generic map (
      g_exact => true
      )
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => in_valid and draws,
      init_ready     => walk_ready,
      init           => walk,
      line_ready     => '1',
      line_held      => open,
      line_load      => line_load,
      line_step      => line_step,
      line_carry     => line_carry,
      span_load      => span_load,
      span_step      => span_step,
      fragment_valid => drawn_valid,
      fragment_ready => token_ready,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => drawing
      );

  line_advance <= line_step and not line_load;
  span_advance <= span_step and not span_load;

  depth : entity work.z_interpolator
    generic map (
      g_exact => true
      )
    port map (
      clk        => clk,
      init       => walk,
      line_load  => line_load,
      line_step  => line_advance,
      line_carry => line_carry,
      span_load  => span_load,
      span_step  => span_advance,
      value      => z
      );

  interpolated : for plane in 0 to c_planes - 1 generate

    constant c_sum_bits : positive := c_formats.plane_sum.bits;
    constant c_low      : natural  := plane_low(g_config, plane);

    signal value : std_logic_vector(c_sum_bits - 1 downto 0);

  begin

    interpolator : entity work.plane_interpolator
      generic map (
        g_bits => c_sum_bits
        )
      port map (
        clk        => clk,
        plane      => in_vector(c_low + c_plane_bits - 1 downto c_low),
        line_load  => line_load,
        line_step  => line_advance,
        line_carry => line_carry,
        span_load  => span_load,
        span_step  => span_advance,
        value      => value
        );

      -- The host has added half a step of the dropped bits.
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
      start => in_vector(request_t'range),
      value => line_request
      );

  line_material_register : entity work.parameter_register
    generic map (
      g_bits => material_t'length
      )
    port map (
      clk   => clk,
      load  => line_load,
      start => in_vector(init_material_low(g_config) + material_t'high downto init_material_low(g_config)),
      value => line_material
      );

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
    variable v : std_logic_vector(token'range);
  begin
    v := (others => '0');
    v(request_t'range) := span_request;
    v(c_pixel.triangle.high downto c_pixel.triangle.low) := triangle;
    v(c_pixel.y.high downto c_pixel.y.low)               := y;
    v(c_pixel.x.high downto c_pixel.x.low)               := x(c_formats.pixel_x.bits - 1 downto 0);
    v(c_pixel.z.high downto c_pixel.z.low)               :=
      z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);
    -- N, P and 1/w follow one another in a token too
    v(normal_low(g_config, 0) + vectors'high downto normal_low(g_config, 0))  := vectors;
    v(material_low(g_config) + material_t'high downto material_low(g_config)) := span_material;
    if drawn_valid = '0' then
      v                                    := (others => '0');
      v(load_bits(g_config) - 1 downto 0) := in_vector(load_bits(g_config) - 1 downto 0);
    end if;
    token <= v;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v       := r;
    v.fault := r.fault or (in_valid and not draws and not is_load(command));
    if reset = '1' then
      v.fault := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

end architecture;
