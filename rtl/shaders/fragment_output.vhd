-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The last stage of the processors shader: converts a shaded object to a fragment. The colour is cut to
--             eight bits and clamped to the largest value. With one channel, red, green and blue are equal. The colour
--             already contains the half that turns the cut into rounding (first_radiance of token_pkg).
-- Contract    Both streams are valid/ready; a fragment does not change while it waits
-- Formats     token: token_pkg; fragment: formats_pkg, colour and depth
-- Latency     1 clock
-- Throughput  1 fragment per clock
-- Error       the colour is rounded once
-- Source      ours
-- Golden twin model/golden/fragment_output.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

entity fragment_output is
  generic (
    g_config : config_t := c_default_config
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    token_valid       : in  std_logic;
    token_ready       : out std_logic;
    token             : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    fragment_valid    : out std_logic;
    fragment_ready    : in  std_logic;
    fragment_triangle : out std_logic_vector(formats(g_config.exact).triangle.bits - 1 downto 0);
    fragment_y        : out std_logic_vector(formats(g_config.exact).pixel_y.bits - 1 downto 0);
    fragment_x        : out std_logic_vector(formats(g_config.exact).pixel_x.bits - 1 downto 0);
    fragment_z        : out std_logic_vector(formats(g_config.exact).depth.bits - 1 downto 0);
    fragment_red      : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0);
    fragment_green    : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0);
    fragment_blue     : out std_logic_vector(formats(g_config.exact).colour.bits - 1 downto 0)
  );
end entity;

architecture rtl of fragment_output is

  constant c_exact    : boolean        := g_config.exact;
  constant c_formats  : formats_t      := formats(c_exact);
  constant c_header   : pixel_header_t := pixel_header(c_exact);
  constant c_colour   : positive       := c_formats.colour.bits;
  constant c_radiance : positive       := c_formats.radiance.bits;

  subtype pixel_t is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length - 1 downto 0);

  signal take           : std_logic;
  signal pixel, pixel_q : pixel_t;
  signal radiance       : std_logic_vector(g_config.channels * c_radiance - 1 downto 0);
  signal results        : std_logic_vector(g_config.channels * c_colour - 1 downto 0);
  signal colours        : std_logic_vector(3 * c_colour - 1 downto 0); -- red lowest
  signal colours_q      : std_logic_vector(3 * c_colour - 1 downto 0);

begin

  take     <= token_valid and token_ready;
  radiance <= radiance_of(g_config, token);
  pixel    <= field_of(token, c_header.triangle) & field_of(token, c_header.y) & field_of(token, c_header.x);

  channels : for channel in 0 to g_config.channels - 1 generate

    signal value : std_logic_vector(c_radiance + 1 downto 0);

  begin

    value <= "00" & radiance((channel + 1) * c_radiance - 1 downto channel * c_radiance);

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

    -- With one channel, copy it to all three colours.
    constant c_from : natural := colour * boolean'pos(g_config.channels > 1) * c_colour;

  begin

    colours((colour + 1) * c_colour - 1 downto colour * c_colour) <= results(c_from + c_colour - 1 downto c_from);

  end generate;

  pixel_register : entity work.stream_register
    generic map (
      g_bits => pixel'length
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => token_valid,
      in_ready  => token_ready,
      in_data   => pixel,
      out_valid => fragment_valid,
      out_ready => fragment_ready,
      out_data  => pixel_q
      );

  depth_register : entity work.parameter_register
    generic map (
      g_bits => fragment_z'length
      )
    port map (
      clk   => clk,
      load  => take,
      start => field_of(token, c_header.z),
      value => fragment_z
      );

  colour_register : entity work.parameter_register
    generic map (
      g_bits => colours'length
      )
    port map (
      clk   => clk,
      load  => take,
      start => colours,
      value => colours_q
      );

  fragment_x        <= pixel_q(fragment_x'range);
  fragment_y        <= pixel_q(fragment_x'length + fragment_y'length - 1 downto fragment_x'length);
  fragment_triangle <= pixel_q(pixel_q'high downto fragment_x'length + fragment_y'length);
  fragment_red      <= colours_q(c_colour - 1 downto 0);
  fragment_green    <= colours_q(2 * c_colour - 1 downto c_colour);
  fragment_blue     <= colours_q(3 * c_colour - 1 downto 2 * c_colour);

end architecture;
