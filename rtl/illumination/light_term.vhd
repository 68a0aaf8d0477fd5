-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The diffuse or the specular term of one light, with one unit per step of the paper's datapath:
--
--               token --> light_vector --> half_vector --> cosine_power --> light_weight --> reflected_term --> terms
--                P            L               H             (N.A)**x         cone of a spot    k I weight
--                             |                               ^                   ^
--                             +---- A = L (diffuse) ----------+                   |
--                             +---------------------------------------------------+
--
--             Each step takes the result of the step before it immediately. Delay lines bring its other inputs (V, N,
--             exponent, k) from the token. Clocks from the token at the input to each result, from times of terms_pkg.
--             The column is the kind of light that the processor can draw. 0: a directional light has a constant L, and
--             in preset published a constant H. -: the term does not need it: a diffuse term has no H; as the paper
--             prints it, a highlight needs L only for a spot's cone.
--
--               published   directional        positional         spot
--                           diffuse specular   diffuse specular   diffuse specular
--               L           0       -          8       -          8       8
--               H           -       0          -       8          -       8
--               (N.A)**x    3       9          11      17         11      17
--               weight      3       9          11      17         19      19
--               terms       4       10         12      18         20      20
--
--               exact       directional        positional         spot
--                           diffuse specular   diffuse specular   diffuse specular
--               L           0       0          18      18         18      18
--               H           -       16         -       34         -       34
--               (N.A)**x    4       30         22      48         22      48
--               weight      4       30         22      48         30      49
--               terms       6       32         24      50         32      51
--
--             Preset exact has no highlight below the light's horizon: `above` is '1' where N.L > 0.
-- Contract    light must not change while a token is in the stages
-- Formats     token, light: token_pkg; terms: reflected_term
-- Latency     `term` of `times` (terms_pkg): the last row above
-- Throughput  1 token per clock
-- Error       that of its units: light_vector, half_vector, cosine_power, light_weight, reflected_term
-- Source      processors paper, equations 2, 3 and 5, figures 1 and 2; ours: spots, perspective, horizon
-- Golden twin model/golden/light_term.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;

entity light_term is
  generic (
    g_config : config_t;
    g_kind   : natural range c_diffuse to c_specular;
    g_light  : positive
  );
  port (
    clk    : in  std_logic;
    light  : in  std_logic_vector(light_bits(g_config) - 1 downto 0);
    token  : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    terms  : out std_logic_vector(g_config.channels * product_bits(g_config.exact) - 1 downto 0);
    above  : out std_logic -- with terms: the light is above the horizon; always '1' for a diffuse term and in preset published
  );
end entity;

architecture rtl of light_term is

  constant c_exact   : boolean             := g_config.exact;
  constant c_formats : formats_t           := formats(c_exact);
  constant c_shape   : shape_t             := shape(g_config, g_kind, g_light);
  constant c_at      : times_t             := times(g_config, g_kind, g_light);
  constant c_header  : light_axes_header_t := light_axes_header(c_exact);

  subtype directions_t is std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);
  subtype weight_t is std_logic_vector(c_formats.weight.bits - 1 downto 0);
  subtype exponent_t is std_logic_vector(c_formats.exponent.bits - 1 downto 0);

  signal positional   : std_logic;    -- the light has a position
  signal spot         : std_logic;    -- and a cone
  signal to_light     : directions_t; -- L
  signal direction    : directions_t; -- A: L, or H of a highlight
  signal aligned      : std_logic_vector(directions_t'length + exponent_t'length - 1 downto 0);
  signal normal       : directions_t; -- N, aligned with A
  signal exponent     : exponent_t;   -- aligned with A
  signal cosine       : weight_t;     -- (N.A)**x
  signal weight       : weight_t;
  signal coefficients : std_logic_vector(g_config.channels * c_formats.coefficient.bits - 1 downto 0);

begin

  positional <= light(c_header.positional.low) when c_shape.positional else '0';
  spot       <= light(c_header.spot.low) when c_shape.spots else '0';

  light_vector : entity work.light_vector
    generic map (
      g_exact      => c_exact,
      g_positional => c_shape.first
      )
    port map (
      clk        => clk,
      positional => positional,
      place      => light_place(c_exact, light),
      shift      => light_shift(c_exact, light),
      point      => place_of(g_config, token),
      distance   => distance_of(g_config, token),
      to_light   => to_light
      );

  highlight : if g_kind = c_specular generate

    signal way    : std_logic_vector(c_axes * half_light_bits(c_exact) - 1 downto 0); -- L; in preset published P_p - P, as the paper prints it
    signal to_eye : directions_t;                                                     -- V; in preset published E

  begin

    halfway : if c_exact generate

      signal vectors     : std_logic_vector(2 * to_eye'length - 1 downto 0);
      signal normal_now  : directions_t; -- N, aligned with L
      signal horizon_dot : std_logic_vector(2 * c_formats.direction.bits downto 0);
      signal above_now   : std_logic;

    begin

      way <= to_light;

      align_vectors : entity work.delay_line
        generic map (
          g_bits  => vectors'length,
          g_depth => c_at.to_light
          )
        port map (
          clk     => clk,
          enable  => '1',
          word    => view_of(g_config, token) & direction_of(g_config, token),
          delayed => vectors
          );

      to_eye     <= vectors(vectors'high downto to_eye'length);
      normal_now <= vectors(normal_now'range);

      horizon : entity work.dot_product
        generic map (
          g_bits   => c_formats.direction.bits,
          g_clocks => dot_product_latency(c_exact, true)
          )
        port map (
          clk    => clk,
          a      => normal_now,
          b      => to_light,
          sum    => horizon_dot
          );

      above_now <= is_positive(signed(horizon_dot));

      align_horizon : entity work.delay_line
        generic map (
          g_bits  => 1,
          g_depth => c_at.term - c_at.to_light - dot_product_latency(c_exact, true)
          )
        port map (
          clk        => clk,
          enable     => '1',
          word(0)    => above_now,
          delayed(0) => above
          );

    else generate

      way    <= offsets(c_exact, light_place(c_exact, light), place_of(g_config, token), light_shift(c_exact, light));
      to_eye <= light_half(c_exact, light);
      above  <= '1';

    end generate;

    half_vector : entity work.half_vector
      generic map (
        g_exact     => c_exact,
        g_normalize => c_shape.second
        )
      port map (
        clk        => clk,
        positional => positional,
        to_light   => way,
        to_eye     => to_eye,
        half       => direction
        );

  else generate

    direction <= to_light;
    above     <= '1';

  end generate;

  align_angle : entity work.delay_line
    generic map (
      g_bits  => aligned'length,
      g_depth => c_at.cosine
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => direction_of(g_config, token) & exponent_of(g_config, token),
      delayed => aligned
      );

  normal   <= aligned(aligned'high downto exponent'length);
  exponent <= aligned(exponent'range);

  cosine_power : entity work.cosine_power
    generic map (
      g_exact     => c_exact,
      g_highlight => g_kind = c_specular
      )
    port map (
      clk       => clk,
      normal    => normal,
      direction => direction,
      exponent  => exponent,
      result    => cosine
      );

  light_weight : entity work.light_weight
    generic map (
      g_exact => c_exact,
      g_spot  => c_shape.spots,
      g_lead  => c_at.raised - c_at.to_light
      )
    port map (
      clk      => clk,
      spot     => spot,
      axis     => light_axis(c_exact, light),
      outer    => field_of(light, c_header.outer),
      slope    => field_of(light, c_header.slope),
      to_light => to_light,
      cosine   => cosine,
      weight   => weight
      );

  align_coefficients : entity work.delay_line
    generic map (
      g_bits  => coefficients'length,
      g_depth => c_at.weight - reflection_latency(c_exact)
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => coefficients_of(g_config, g_kind, token),
      delayed => coefficients
      );

  reflected_term : entity work.reflected_term
    generic map (
      g_exact    => c_exact,
      g_channels => g_config.channels
      )
    port map (
      clk          => clk,
      coefficients => coefficients,
      intensities  => intensities_of(g_config, light),
      weight       => weight,
      terms        => terms
      );

end architecture;
