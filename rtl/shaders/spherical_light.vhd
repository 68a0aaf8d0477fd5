-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One light: a diffuse_slice and a specular_slice, and their products as terms of the sum of colours.
--               diffuse   a product per channel: the channel's term
--               specular  a product per channel, or one product (g_highlight_channels = 1) that is the term of every
--                         channel: a grey highlight
--             Hardware that no effect needs does not exist. A diffuse_slice exists if there is diffuse light or, in
--             preset exact, a highlight, which ends at the horizon that the diffuse_slice computes.
-- Contract    span_load takes the light's part of the line record. span_step passes the pixel to the sample stage and
--             advances the span to the next pixel. sample_step passes the pixel from the sample stage to the product
--             stage. At least one of g_diffuse and g_specular is true.
-- Formats     part: the diffuse part, then the specular part, see spherical_pkg; terms: term_bits of spherical_pkg, one
--             per channel for the diffuse light and then one per channel for the highlight, the first channel lowest
-- Latency     1 clock from span_load to the angles, 1 from span_step to the samples, 3 from sample_step to terms
-- Throughput  1 pixel per clock
-- Error       that of diffuse_slice and specular_slice
-- Source      spherical paper, section 4 and figure 12 (diffuse and specular part)
-- Golden twin model/golden/spherical_light.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.cosine_pkg.all;
use work.spherical_pkg.all;

entity spherical_light is
  generic (
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := g_channels;
    g_powers             : natural  := 2;
    g_cosine             : cosine_t := default_cosine(g_exact);
    g_multiplier_bits    : natural  := 0 -- of multiplier
  );
  port (
    clk         : in  std_logic;
    part        : in  std_logic_vector(light_part_bits(g_exact, g_channels, g_diffuse, g_specular, g_highlight_channels)
      - 1 downto 0);             -- of the line record
    span_load   : in  std_logic; -- start the line
    span_step   : in  std_logic; -- go to the next pixel
    sample_step : in  std_logic; -- pass the pixel to the product stage
    terms       : out std_logic_vector(light_terms(g_diffuse, g_specular) * g_channels
      * term_bits(g_exact, data_bits(g_cosine)) - 1 downto 0)
  );
end entity;

architecture rtl of spherical_light is

  constant c_term_bits        : positive := term_bits(g_exact, data_bits(g_cosine));
  constant c_diffuse_channels : natural  := diffuse_channels(g_channels, g_diffuse);
  constant c_diffuse_bits     : natural  := diffuse_part_bits(g_exact, g_channels, g_diffuse, g_specular);

  signal lit : std_logic; -- at the span stage: the pixel is above the light's horizon

begin

  assert g_diffuse or g_specular
    report "spherical_light: neither g_diffuse nor g_specular: the light has no part"
    severity failure;
  assert g_highlight_channels = 1 or g_highlight_channels = g_channels
    report "spherical_light: g_highlight_channels is " & integer'image(g_highlight_channels)
    & ", not 1 (grey) or g_channels, " & integer'image(g_channels)
    severity failure;

  diffuse : if has_diffuse_part(g_exact, g_diffuse, g_specular) generate

    signal products : std_logic_vector((c_diffuse_channels + boolean'pos(not g_diffuse)) * c_term_bits - 1 downto 0);

  begin

    slice : entity work.diffuse_slice
      generic map (
        g_exact           => g_exact,
        g_channels        => c_diffuse_channels,
        g_cosine          => g_cosine,
        g_multiplier_bits => g_multiplier_bits
        )
      port map (
        clk         => clk,
        part        => part(c_diffuse_bits - 1 downto 0),
        span_load   => span_load,
        span_step   => span_step,
        sample_step => sample_step,
        lit         => lit,
        products    => products
        );

      -- Without diffuse light the slice computes the horizon, and its products are one word of zeros.
    diffuse_terms : if g_diffuse generate

      terms(products'range) <= products;

    end generate;

  else generate

    lit <= '1';

  end generate;

  specular : if g_specular generate

    -- The highlight's term of the first channel.
    constant c_first : natural := c_diffuse_channels;

    signal products : std_logic_vector(g_highlight_channels * c_term_bits - 1 downto 0);

  begin

    slice : entity work.specular_slice
      generic map (
        g_exact           => g_exact,
        g_channels        => g_highlight_channels,
        g_powers          => g_powers,
        g_cosine          => g_cosine,
        g_multiplier_bits => g_multiplier_bits
        )
      port map (
        clk         => clk,
        part        => part(part'high downto c_diffuse_bits),
        span_load   => span_load,
        span_step   => span_step,
        sample_step => sample_step,
        lit         => lit,
        products    => products
        );

    highlight_terms : for channel in 0 to g_channels - 1 generate

      -- Add a grey highlight to every channel.
      constant c_product : natural := channel * boolean'pos(g_highlight_channels > 1);

    begin

      terms((c_first + channel + 1) * c_term_bits - 1 downto (c_first + channel) * c_term_bits) <=
        products((c_product + 1) * c_term_bits - 1 downto c_product * c_term_bits);

    end generate;

  end generate;

end architecture;
