-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     k I (N.A)**x: the light that a surface reflects, one product per channel.
--
--                                                                                  | clocks
--               k * I                    vector_multiply                             | 1, exact 2
--               k I                      rounded half up, clamped to reflected       | 1
--               (k I) * weight           vector_multiply, only with g_weighted       | 1, exact 2
--
--             Without g_weighted the weight is 1: the ambient term, where x is 0.
-- Contract    intensities must not change while a point is in the stages
-- Formats     coefficients: coefficient, intensities: light_intensity, a word per channel, the first lowest; weight:
--             weight, reflection_latency of terms_pkg after its coefficients; terms: product_bits of terms_pkg per channel, with the fraction
--             bits of reflected and weight
-- Latency     clocks to terms: vector_multiply_latency of shading_pkg from weight; without g_weighted
--             reflection_latency from coefficients
-- Throughput  1 term per clock
-- Error       half a step of reflected
-- Source      processors paper, equation 5 and figure 1: the vector multiplications
-- Golden twin model/golden/reflected_term.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.vector_pkg.all;

entity reflected_term is
  generic (
    g_exact    : boolean              := true;
    g_channels : natural range 1 to 3 := 3;
    g_weighted : boolean              := true
  );
  port (
    clk          : in  std_logic;
    coefficients : in  std_logic_vector(g_channels * formats(g_exact).coefficient.bits - 1 downto 0);
    intensities  : in  std_logic_vector(g_channels * formats(g_exact).light_intensity.bits - 1 downto 0);
    weight       : in  std_logic_vector(formats(g_exact).weight.bits - 1 downto 0);
    terms        : out std_logic_vector(g_channels * product_bits(g_exact) - 1 downto 0)
  );
end entity;

architecture rtl of reflected_term is

  -- Of the operands, which are positive, with a sign.
  constant c_k         : positive := formats(g_exact).coefficient.bits + 1;
  constant c_intensity : positive := formats(g_exact).light_intensity.bits + 1;
  constant c_reflected : positive := formats(g_exact).reflected.bits + 1;
  constant c_weight    : positive := formats(g_exact).weight.bits + 1;

  signal k           : std_logic_vector(c_axes * c_k - 1 downto 0);
  signal intensity   : std_logic_vector(c_axes * c_intensity - 1 downto 0);
  signal k_i         : std_logic_vector(c_axes * (c_k + c_intensity) - 1 downto 0);
  signal reflections : std_logic_vector(c_axes * c_reflected - 1 downto 0);

begin

  k         <= positive_words(coefficients, g_channels);
  intensity <= positive_words(intensities, g_channels);

  reflect : entity work.vector_multiply
    generic map (
      g_a_bits => c_k,
      g_b_bits => c_intensity,
      g_clocks => vector_multiply_latency(g_exact)
      )
    port map (
      clk      => clk,
      a        => k,
      b        => intensity,
      products => k_i
      );

  round : process (clk)
  begin
    if rising_edge(clk) then
      reflections <= (others => '0');
      for channel in 0 to g_channels - 1 loop
        reflections((channel + 1) * c_reflected - 2 downto channel * c_reflected) <=
          reflected(g_exact, unsigned(k_i((channel + 1) * (c_k + c_intensity) - 3
          downto channel * (c_k + c_intensity))));
      end loop;
    end if;
  end process;

  weighted : if g_weighted generate

    constant c_product : positive := c_reflected + c_weight;

    signal factor   : std_logic_vector(c_weight - 1 downto 0);
    signal products : std_logic_vector(c_axes * c_product - 1 downto 0);

  begin

    factor <= '0' & weight;

    weigh : entity work.vector_multiply
      generic map (
        g_a_bits => c_reflected,
        g_b_bits => c_weight,
        g_clocks => vector_multiply_latency(g_exact)
        )
      port map (
        clk      => clk,
        a        => reflections,
        b        => factor & factor & factor,
        products => products
        );

    channels : for channel in 0 to g_channels - 1 generate

      terms((channel + 1) * product_bits(g_exact) - 1 downto channel * product_bits(g_exact)) <=
        products((channel + 1) * c_product - 3 downto channel * c_product);

    end generate;

  else generate

    channels : for channel in 0 to g_channels - 1 generate

      terms((channel + 1) * product_bits(g_exact) - 1 downto channel * product_bits(g_exact)) <=
        unweighted(g_exact, reflections((channel + 1) * c_reflected - 2 downto channel * c_reflected));

    end generate;

  end generate;

end architecture;
