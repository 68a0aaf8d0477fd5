-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One term of the illumination model, folded: I_out = I_in + k I (N.A)**x, with one unit of each kind. The
--             steps use the units one after the other. The ambient processor normalizes N and the view vector for all
--             others.
--
--               in_token --+-- light_state          commands, the light, shadow volumes
--                          +-- shading_sequence     the clock of the token: schedule_pkg
--                          +-- token_register       N, V and the colour change here      --> out_token
--
--               shared_adder --> shared_normalizer <--> shared_multiplier <--> shared_weight
--                  ^  P_p - P, L + V    shift, 1/sqrt     |  squares, N.A,       (N.A)**x
--                  +--------------------------------------+  k I, k I weight
--
-- Contract    A token moves where valid and ready are both '1' at a rising edge; out_token does not change while it
--             waits. Every token is output, in order. define, redefine and delete of g_light act on the tokens after
--             them; after reset the light is not defined. An object leaves with a new colour,
--             from the ambient processor, which starts it, also with new N and view vector. The colour is unchanged if
--             the light is not defined or does not reach the point (shadow volumes).
-- Formats     processors_pkg, formats_pkg; fields of tokens: token_pkg; words between
--             the units: terms_pkg
-- Latency     the clocks of Throughput, minus 1
-- Throughput  1 token per this number of clocks, the clock of the input and of the output included (published, exact):
--             head, load, delete, shadow polygon, object without a light 2, 2; object in a shadow 3, 3; ambient 4, 5; with N
--             normalized 6, 15; with the view vector too -, 26 (without N 16); directional diffuse 6, 9, specular 7, 34;
--             positional diffuse 12, 26, specular 13, 51; spot diffuse 22, 37, specular 28, 54. A step waits only while
--             its unit is busy.
-- Source      processors paper, figures 1 and 2 and table 4: preset published has its clocks. Ours: spots, perspective,
--             the view vector.
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.vector_pkg.all;

entity shading_processor is
  generic (
    g_exact       : boolean                                      := true;
    g_channels    : natural range 1 to 3                         := 3;
    g_directional : natural                                      := 0; -- lights of each kind
    g_positional  : natural                                      := 0;
    g_spots       : natural                                      := 0;
    g_diffuse     : boolean                                      := true;
    g_specular    : boolean                                      := true;
    g_normalize   : boolean                                      := true;
    g_shadows     : boolean                                      := false;
    g_kind        : natural range c_ambient to c_specular        := c_ambient;
    g_light       : natural                                      := 0 -- 0: the ambient one
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_token  : in  std_logic_vector(token_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows)) - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_token : out std_logic_vector(token_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows)) - 1 downto 0);
    busy      : out std_logic -- holds a token
  );
end entity;

architecture rtl of shading_processor is

  constant c_config       : config_t            := config(g_exact, g_channels, g_directional, g_positional, g_spots,
    g_diffuse, g_specular, g_normalize, g_shadows);
  constant c_shape        : shape_t             := shape(c_config, g_kind, g_light);
  constant c_at           : schedule_t          := schedule(c_config, g_kind, g_light);
  constant c_header       : pixel_header_t      := pixel_header(g_exact);
  constant c_light_header : light_axes_header_t := light_axes_header(g_exact);

  subtype directions_t is std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);
  subtype weight_t is std_logic_vector(formats(g_exact).weight.bits - 1 downto 0);

  signal free       : std_logic;
  signal take       : std_logic;
  signal object     : std_logic; -- the token offered is one
  signal cycle      : natural range 0 to c_at.leave; -- 0: no token
  signal taken      : std_logic; -- an object, in the clock before
  signal token      : std_logic_vector(in_token'range);
  signal light      : std_logic_vector(light_bits(c_config) - 1 downto 0);
  signal defined    : std_logic; -- the light
  signal lit        : std_logic;
  signal positional : std_logic; -- the light has a position
  signal spot       : std_logic; -- and a cone

  -- Between the shared units.
  signal dot      : std_logic_vector(2 * formats(g_exact).direction.bits downto 0);
  signal products : std_logic_vector(c_axes * shared_product_bits(c_config, g_kind, g_light) - 1 downto 0);
  signal vector   : std_logic_vector(c_axes * normalized_bits(c_config, g_kind, g_light) - 1 downto 0);
  signal shifted  : directions_t;
  signal root     : std_logic_vector(formats(g_exact).root.bits downto 0);
  signal unit     : directions_t;
  signal to_light : directions_t; -- L
  signal half     : directions_t; -- H
  signal weight   : weight_t;
  signal factor   : weight_t;     -- of a spot's cone

begin

  free <= '1' when cycle = 0 else '0';
  take <= in_valid and free;

  in_ready  <= free;
  out_valid <= '1' when cycle = c_at.leave else '0';
  out_token <= token;
  busy      <= '0' when cycle = 0 else '1';

  positional <= light(c_light_header.positional.low) when c_shape.positional else '0';
  spot       <= light(c_light_header.spot.low) when c_shape.spots else '0';

  light_state : entity work.light_state
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk     => clk,
      reset   => reset,
      take    => take,
      token   => in_token,
      object  => object,
      changes => open,
      defined => defined,
      light   => light,
      lit     => lit
      );

  shading_sequence : entity work.shading_sequence
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk             => clk,
      reset           => reset,
      take            => take,
      object          => object,
      normalize       => in_token(c_header.normalize.low),
      defined         => defined,
      positional      => positional,
      spot            => spot,
      lit             => lit,
      normalize_token => token(c_header.normalize.low),
      above           => is_positive(signed(dot)),
      leave           => out_ready,
      taken           => taken,
      cycle           => cycle
      );

  token_register : entity work.token_register
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk      => clk,
      take     => take,
      object   => object,
      in_token => in_token,
      cycle    => cycle,
      defined  => defined,
      unit     => unit,
      products => products,
      token    => token
      );

  shared_multiplier : entity work.shared_multiplier
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk      => clk,
      cycle    => cycle,
      token    => token,
      light    => light,
      shifted  => shifted,
      normal   => direction_of(c_config, token),
      to_light => to_light,
      half     => half,
      root     => root,
      weight   => weight,
      factor   => factor,
      products => products,
      dot      => dot
      );

  normalization : if c_shape.first or c_shape.second generate

    shared_normalizer : entity work.shared_normalizer
      generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
      port map (
        clk      => clk,
        cycle    => cycle,
        vector   => vector,
        dot      => dot,
        products => products,
        shifted  => shifted,
        root     => root,
        unit     => unit
        );

  else generate

    shifted <= (others => '0');
    root    <= (others => '0');
    unit    <= (others => '0');

  end generate;

  kind : if g_kind = c_ambient generate

    -- N while it is taken, then the way to the eye
    vector <= negated(place_of(c_config, token)) when c_shape.second and cycle /= 0 else normal_of(c_config, in_token);

    to_light <= (others => '0');
    half     <= (others => '0');
    weight   <= (others => '0');
    factor   <= (others => '0');

  else generate

    shared_adder : entity work.shared_adder
      generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
      port map (
        clk        => clk,
        cycle      => cycle,
        positional => positional,
        token      => token,
        light      => light,
        products   => products,
        unit       => unit,
        sum        => vector,
        to_light   => to_light,
        half       => half
        );

    shared_weight : entity work.shared_weight
      generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
      port map (
        clk      => clk,
        cycle    => cycle,
        spot     => spot,
        outer    => field_of(light, c_light_header.outer),
        slope    => field_of(light, c_light_header.slope),
        exponent => exponent_of(c_config, token),
        dot      => dot,
        products => products,
        weight   => weight,
        factor   => factor
        );

  end generate;

end architecture;
