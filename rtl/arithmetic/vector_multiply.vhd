-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Multiplies two vectors of three components component by component: a vector by a scalar, a colour by a
--             colour.
-- Formats     a: components of g_a_bits, b: of g_b_bits, products: of g_a_bits + g_b_bits; signed, x lowest
-- Latency     g_clocks clocks: vector_multiply_latency of shading_pkg
-- Throughput  1 vector per clock
-- Error       none
-- Source      processors paper, figures 1 and 2
-- Golden twin model/golden/vector_multiply.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

entity vector_multiply is
  generic (
    g_a_bits : positive;
    g_b_bits : positive;
    g_clocks : positive range 1 to 2
  );
  port (
    clk      : in  std_logic;
    a        : in  std_logic_vector(c_axes * g_a_bits - 1 downto 0);
    b        : in  std_logic_vector(c_axes * g_b_bits - 1 downto 0);
    products : out std_logic_vector(c_axes * (g_a_bits + g_b_bits) - 1 downto 0)
  );
end entity;

architecture rtl of vector_multiply is

  constant c_bits : positive := g_a_bits + g_b_bits;

begin

  axes : for axis in 0 to c_axes - 1 generate

    multiply : entity work.signed_multiplier
      generic map (
        g_a_bits => g_a_bits,
        g_b_bits => g_b_bits,
        g_clocks => g_clocks
        )
      port map (
        clk     => clk,
        a       => std_logic_vector(axis_of(a, axis)),
        b       => std_logic_vector(axis_of(b, axis)),
        product => products((axis + 1) * c_bits - 1 downto axis * c_bits)
        );

  end generate;

end architecture;
