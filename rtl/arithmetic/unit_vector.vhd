-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The unit vector in the direction of a vector: block shift, dot product with itself, 1/sqrt,
--             multiplication, rounding.
-- Formats     components: g_vector_bits each, signed, of any scale, x lowest; unit: format direction
-- Latency     unit_vector_latency of terms_pkg, in clocks
-- Throughput  1 vector per clock
-- Error       of the length: see reciprocal_root; of the direction: 2**-20.7 exact, 2**-13.2 published, see direction
--             in formats_pkg
-- Source      processors paper, figure 2
-- Golden twin model/golden/unit_vector.hpp (normalized)

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity unit_vector is
  generic (
    g_exact       : boolean := true;
    g_vector_bits : positive
  );
  port (
    clk        : in  std_logic;
    components : in  std_logic_vector(c_axes * g_vector_bits - 1 downto 0);
    unit       : out std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of unit_vector is

  constant c_bits       : positive := formats(g_exact).direction.bits;
  constant c_root       : positive := formats(g_exact).root.bits + 1;
  constant c_product    : positive := c_bits + c_root + 1;
  constant c_square_low : natural  := 2 * (c_bits - 1) - formats(g_exact).square.fraction;

  signal shifted  : std_logic_vector(unit'range);
  signal waited   : std_logic_vector(unit'range);
  signal dot      : std_logic_vector(2 * c_bits downto 0);
  signal square   : std_logic_vector(formats(g_exact).square.bits - 1 downto 0);
  signal root     : std_logic_vector(c_root - 1 downto 0);
  signal factor   : std_logic_vector(c_root downto 0);
  signal products : std_logic_vector(c_axes * c_product - 1 downto 0);

begin

  block_shift : entity work.vector_shift
    generic map (
      g_vector_bits => g_vector_bits,
      g_result_bits => c_bits,
      g_clocks      => vector_shift_latency(true)
      )
    port map (
      clk        => clk,
      enable     => '1',
      components => components,
      shifted    => shifted
      );

  length : entity work.dot_product
    generic map (
      g_bits   => c_bits,
      g_clocks => dot_product_latency(g_exact, true)
      )
    port map (
      clk    => clk,
      a      => shifted,
      b      => shifted,
      sum    => dot
      );

  square <= dot(c_square_low + square'high downto c_square_low);

  reciprocal_root : entity work.reciprocal_root
    generic map (
      g_exact => g_exact
      )
    port map (
      clk        => clk,
      square     => square,
      reciprocal => root
      );

  align_shifted : entity work.delay_line
    generic map (
      g_bits  => shifted'length,
      g_depth => dot_product_latency(g_exact, true) + reciprocal_root_latency(g_exact)
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => shifted,
      delayed => waited
      );

  factor <= '0' & root;

  scale : entity work.vector_multiply
    generic map (
      g_a_bits => c_bits,
      g_b_bits => c_root + 1,
      g_clocks => vector_multiply_latency(g_exact)
      )
    port map (
      clk      => clk,
      a        => waited,
      b        => factor & factor & factor,
      products => products
      );

  to_direction : process (clk)
  begin
    if rising_edge(clk) then
      for axis in 0 to c_axes - 1 loop
        unit((axis + 1) * c_bits - 1 downto axis * c_bits) <= unit_direction(g_exact, axis_of(products, axis));
      end loop;
    end if;
  end process;

end architecture;
