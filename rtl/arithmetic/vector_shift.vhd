-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Block shift: shifts the three components of a vector left by the same number of bits, as far as no
--             component loses its sign. The magnitude of the largest component is then from 1/2 to 1, so a
--             normalization need not handle other lengths. A zero vector stays zero.
-- Formats     components: g_vector_bits each, signed, of any scale, x lowest; shifted: g_result_bits each, signed, all
--             bits except the sign are fraction
-- Latency     g_clocks clocks with enable. With 2 the first one finds the number of bits, the second one shifts.
-- Throughput  1 vector per clock
-- Error       (-1, 0] of the result's last bit: lower bits are dropped
-- Source      ours: the processors paper's text gives no word lengths
-- Golden twin model/golden/vector_shift.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

entity vector_shift is
  generic (
    g_vector_bits : positive;
    g_result_bits : positive;
    g_clocks      : positive range 1 to 2
  );
  port (
    clk        : in  std_logic;
    enable     : in  std_logic;
    components : in  std_logic_vector(c_axes * g_vector_bits - 1 downto 0);
    shifted    : out std_logic_vector(c_axes * g_result_bits - 1 downto 0)
  );
end entity;

architecture rtl of vector_shift is

  -- A stage for each bit of the number: it shifts by 2**stage.
  constant c_stages : positive := index_bits(g_vector_bits);

  constant c_high  : natural                           := g_vector_bits - 1;
  constant c_zeros : std_logic_vector(c_high downto 0) := (others => '0');

  subtype word_t is std_logic_vector(c_high downto 0);
  subtype result_t is std_logic_vector(c_axes * g_result_bits - 1 downto 0);

  subtype flat_t is std_logic_vector(c_axes * g_vector_bits - 1 downto 0);
  subtype amount_t is std_logic_vector(c_stages - 1 downto 0);

  -- The number of bits by which the vector can be shifted.
  function amount_of (flat : flat_t) return amount_t is
    variable word   : word_t;
    variable signs  : word_t;
    variable moving : word_t   := c_zeros;
    variable amount : amount_t := (others => '0');
  begin
    -- Mark the bits in which some component differs from its sign. The lowest bit is always marked: it ends the search.
    for axis in 0 to c_axes - 1 loop
      word   := flat((axis + 1) * g_vector_bits - 1 downto axis * g_vector_bits);
      signs  := (others => word(c_high));
      moving := moving or (word xor signs);
    end loop;
    moving := moving(c_high - 1 downto 0) & '1';
    for stage in amount'range loop
      if moving(c_high downto c_high - 2 ** stage + 1) = c_zeros(2 ** stage - 1 downto 0) then
        moving        := moving(c_high - 2 ** stage downto 0) & c_zeros(2 ** stage - 1 downto 0);
        amount(stage) := '1';
      end if;
    end loop;
    return amount;
  end function;

  function shift_all (flat : flat_t; amount : amount_t) return result_t is
    variable word   : word_t;
    variable result : result_t := (others => '0');
  begin
    for axis in 0 to c_axes - 1 loop
      word := flat((axis + 1) * g_vector_bits - 1 downto axis * g_vector_bits);
      for stage in amount'range loop
        if amount(stage) = '1' then
          word := word(c_high - 2 ** stage downto 0) & c_zeros(2 ** stage - 1 downto 0);
        end if;
      end loop;
      if g_vector_bits >= g_result_bits then
        result((axis + 1) * g_result_bits - 1 downto axis * g_result_bits) :=
          word(c_high downto g_vector_bits - g_result_bits);
      else
        result((axis + 1) * g_result_bits - 1 downto (axis + 1) * g_result_bits - g_vector_bits) := word;
      end if;
    end loop;
    return result;
  end function;

  signal found, searched : std_logic_vector(c_stages + flat_t'length - 1 downto 0); -- the vector, above it the number

begin

  found <= amount_of(components) & components;

  between : entity work.delay_line
    generic map (
      g_bits  => found'length,
      g_depth => g_clocks - 1
      )
    port map (
      clk     => clk,
      enable  => enable,
      word    => found,
      delayed => searched
      );

  shift : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        shifted <= shift_all(searched(flat_t'range), searched(searched'high downto flat_t'length));
      end if;
    end if;
  end process;

end architecture;
