-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Dot product of two vectors of three components: the products, in g_clocks - 1 clocks; then their sum.
-- Formats     a, b: components of g_bits, signed, x lowest; sum: signed, 2 g_bits + 1
-- Latency     g_clocks clocks: dot_product_latency of shading_pkg
-- Throughput  1 vector per clock
-- Error       none
-- Source      processors paper, figures 1 and 2
-- Golden twin model/golden/dot_product.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

entity dot_product is
  generic (
    g_bits   : positive;
    g_clocks : positive range 2 to 3
  );
  port (
    clk    : in  std_logic;
    a      : in  std_logic_vector(c_axes * g_bits - 1 downto 0);
    b      : in  std_logic_vector(c_axes * g_bits - 1 downto 0);
    sum    : out std_logic_vector(2 * g_bits downto 0)
  );
end entity;

architecture rtl of dot_product is

  subtype product_t is std_logic_vector(2 * g_bits - 1 downto 0);

  type products_t is array (0 to c_axes - 1) of product_t;

  signal products : products_t;

begin

  axes : for axis in 0 to c_axes - 1 generate

    multiply : entity work.signed_multiplier
      generic map (
        g_a_bits => g_bits,
        g_b_bits => g_bits,
        g_clocks => g_clocks - 1
        )
      port map (
        clk     => clk,
        a       => std_logic_vector(axis_of(a, axis)),
        b       => std_logic_vector(axis_of(b, axis)),
        product => products(axis)
        );

  end generate;

  registers : process (clk)
    variable whole : signed(sum'range);
  begin
    if rising_edge(clk) then
      whole := (others => '0');
      for axis in 0 to c_axes - 1 loop
        whole := whole + signed(products(axis));
      end loop;
      sum <= std_logic_vector(whole);
    end if;
  end process;

end architecture;
