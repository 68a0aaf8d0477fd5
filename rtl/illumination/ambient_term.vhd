-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The steps of the ambient processor, in order: k_a I_a, and the unit vectors N and V that all processors
--             after it need.
--
--               clock                  1 .. unit_vector_latency
--               N                      unit_vector
--               V = -(view ray)        unit_vector
--               k_a I_a                wait                    reflected_term, in the last clocks
--
--             unit_vector exists only for the vectors that config needs. Without any the term takes reflection_latency clocks.
-- Contract    light must not change while a token is in the stages
-- Formats     token, light: token_pkg; terms: reflected_term; normal, view: direction, three components, x lowest
-- Latency     times of terms_pkg: term
-- Throughput  1 token per clock
-- Source      processors paper, equation 1; table 4 (it also normalizes N); section 3.2 (the first processor computes the
--             ambient light)
-- Golden twin model/golden/ambient_term.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.vector_pkg.all;

entity ambient_term is
  generic (
    g_config : config_t
  );
  port (
    clk     : in  std_logic;
    light   : in  std_logic_vector(light_bits(g_config) - 1 downto 0);
    token   : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    terms   : out std_logic_vector(g_config.channels * product_bits(g_config.exact) - 1 downto 0);
    normal  : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    view    : out std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of ambient_term is

  constant c_exact   : boolean   := g_config.exact;
  constant c_formats : formats_t := formats(c_exact);
  constant c_at      : times_t   := times(g_config, c_ambient, 0);

  signal coefficients : std_logic_vector(g_config.channels * c_formats.coefficient.bits - 1 downto 0);

begin

  normals : if g_config.normalize generate

    unit_normal : entity work.unit_vector
      generic map (
        g_exact       => c_exact,
        g_vector_bits => c_formats.vector.bits
        )
      port map (
        clk        => clk,
        components => normal_of(g_config, token),
        unit       => normal
        );

  else generate

    normal <= (others => '0');

  end generate;

  views : if has_view(g_config) generate

    unit_view : entity work.unit_vector
      generic map (
        g_exact       => c_exact,
        g_vector_bits => c_formats.vector.bits
        )
      port map (
        clk        => clk,
        components => negated(place_of(g_config, token)),
        unit       => view
        );

  else generate

    view <= (others => '0');

  end generate;

  align_coefficients : entity work.delay_line
    generic map (
      g_bits  => coefficients'length,
      g_depth => c_at.weight - reflection_latency(c_exact)
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => coefficients_of(g_config, c_ambient, token),
      delayed => coefficients
      );

  reflect : entity work.reflected_term
    generic map (
      g_exact    => c_exact,
      g_channels => g_config.channels,
      g_weighted => false
      )
    port map (
      clk          => clk,
      coefficients => coefficients,
      intensities  => intensities_of(g_config, light),
      weight       => (others => '0'),
      terms        => terms
      );

end architecture;
