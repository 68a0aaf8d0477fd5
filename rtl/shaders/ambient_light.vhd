-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The ambient light of each pixel, as one term per channel of the sum of colours.
--               span      the ambient light of the span's triangle: the line stage may already hold the next one
--               delay     g_depth clocks, to align with the products of the lights
--             Zeros are appended, so that a term has the fraction bits of a product.
-- Contract    span_load takes the ambient light of the span's triangle
-- Formats     formats_pkg: ambient; terms: term_bits of spherical_pkg, one per channel, the first channel lowest
-- Latency     1 clock from span_load to the span's ambient light, g_depth to terms
-- Throughput  1 span per clock
-- Error       none
-- Source      spherical paper, section 4 and figure 12 (a further input of the adders of red, green and blue); the
--             ambient light is ours
-- Golden twin model/golden/ambient_light.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;

entity ambient_light is
  generic (
    g_exact     : boolean  := true;
    g_channels  : positive := 3;
    g_data_bits : positive := 8; -- of a light's sample
    g_depth     : natural  := 4  -- clocks from the span to terms
  );
  port (
    clk       : in  std_logic;
    ambient   : in  std_logic_vector(ambient_bits(g_exact, g_channels) - 1 downto 0); -- of the triangle's header
    span_load : in  std_logic;
    terms     : out std_logic_vector(g_channels * term_bits(g_exact, g_data_bits) - 1 downto 0)
  );
end entity;

architecture rtl of ambient_light is

  constant c_term_bits : positive := term_bits(g_exact, g_data_bits);
  constant c_ambient   : slice_t  := ambient_channel(g_exact).ambient;

  subtype ambient_t is std_logic_vector(ambient'range);

  signal span_ambient, delayed_ambient : ambient_t;

begin

  span_register : entity work.parameter_register
    generic map (
      g_bits => ambient_t'length
      )
    port map (
      clk   => clk,
      load  => span_load,
      start => ambient,
      value => span_ambient
      );

  align_ambient : entity work.delay_line
    generic map (
      g_bits  => ambient_t'length,
      g_depth => g_depth
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => span_ambient,
      delayed => delayed_ambient
      );

  channels : for channel in 0 to g_channels - 1 generate

    constant c_low : natural := ambient_bits(g_exact, channel);

  begin

    terms((channel + 1) * c_term_bits - 1 downto channel * c_term_bits) <=
      delayed_ambient(c_low + c_ambient.high downto c_low + c_ambient.low) & (g_data_bits - 1 downto 0 => '0');

  end generate;

end architecture;
