-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Sum of unsigned fixed-point terms as an integer of fewer bits. The sum is wide enough for the largest
--             terms, so it never wraps. Its fraction is dropped. Sums above the largest result give the largest. One of
--             the terms contains the 0.5 that turns this into rounding.
-- Contract    result does not change without enable
-- Formats     terms: g_terms of g_term_bits each, of which g_fraction_bits are fraction, the first lowest; result:
--             unsigned, g_result_bits
-- Latency     1 clock from terms with enable to their result
-- Throughput  1 result per clock
-- Error       inside the range, the result is 0 to 1 (exclusive) below the sum
-- Source      spherical paper, figure 12 (the adders of red, green and blue)
-- Golden twin model/golden/saturating_sum.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity saturating_sum is
  generic (
    g_terms         : positive;
    g_term_bits     : positive;
    g_fraction_bits : natural;
    g_result_bits   : positive
  );
  port (
    clk    : in  std_logic;
    enable : in  std_logic;
    terms  : in  std_logic_vector(g_terms * g_term_bits - 1 downto 0);
    result : out std_logic_vector(g_result_bits - 1 downto 0)
  );
end entity;

architecture rtl of saturating_sum is

  -- Bits that g_terms terms add to the width of one: 2**bits >= g_terms.
  function carry_bits return natural is
    variable bits : natural := 0;
  begin
    while 2 ** bits < g_terms loop
      bits := bits + 1;
    end loop;
    return bits;
  end function;

  constant c_sum_bits : positive := g_term_bits + carry_bits;

  type reg_t is record
    sum : unsigned(c_sum_bits - 1 downto 0);
  end record;

  signal r : reg_t;

  signal value : std_logic_vector(c_sum_bits downto 0);

begin

  registers : process (clk)
    variable v    : unsigned(c_sum_bits - 1 downto 0);
    variable high : std_logic; -- the highest bit of any term is set
  begin
    if rising_edge(clk) then
      if enable = '1' then
        v := resize(unsigned(terms(g_term_bits - 1 downto 0)), c_sum_bits);
        for i in 1 to g_terms - 1 loop
          v := v + resize(unsigned(terms((i + 1) * g_term_bits - 1 downto i * g_term_bits)), c_sum_bits);
        end loop;
        -- Clear the sum's highest bit if no term has its highest bit set. The bit is zero in that case. The sum's
        -- highest cell then is a lookup table with its carry.
        high := '0';
        for i in 0 to g_terms - 1 loop
          high := high or terms((i + 1) * g_term_bits - 1);
        end loop;
        v(v'high) := v(v'high) and high;
        r.sum <= v;
      end if;
    end if;
  end process;

  value <= '0' & std_logic_vector(r.sum);

  to_result : entity work.saturate
    generic map (
      g_value_bits    => c_sum_bits + 1,
      g_fraction_bits => g_fraction_bits,
      g_result_bits   => g_result_bits
      )
    port map (
      value  => value,
      result => result
      );

end architecture;
