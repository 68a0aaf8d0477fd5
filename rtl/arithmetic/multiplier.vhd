-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Product of two unsigned words in three stages. g_multiplier_bits selects what they do, not what they output:
--               0         products in lookup tables: each quarter of a times b; the sums of two quarters; the sum of both
--                         halves
--               otherwise products in multipliers of this width: the operands; the products of their pieces of at most
--                         g_multiplier_bits bits; the sum of these products
-- Contract    There is no reset: words in the stages are output. product changes only three clocks after enable.
-- Formats     a: g_a_bits, b: g_b_bits, product: g_a_bits + g_b_bits; unsigned
-- Latency     3 clocks from operands with enable to their product, for any g_multiplier_bits
-- Throughput  1 product per clock
-- Error       none
-- Source      spherical paper, figure 12
-- Golden twin model/golden/multiplier.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity multiplier is
  generic (
    g_a_bits          : positive;
    g_b_bits          : positive;
    g_gated           : boolean := true; -- a comes through a gate and not directly from registers; of lookup tables
    g_multiplier_bits : natural := 0     -- width of the device's multipliers; 0: lookup tables
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    a       : in  std_logic_vector(g_a_bits - 1 downto 0);
    b       : in  std_logic_vector(g_b_bits - 1 downto 0);
    product : out std_logic_vector(g_a_bits + g_b_bits - 1 downto 0)
  );
end entity;

architecture rtl of multiplier is

begin

  tables : if g_multiplier_bits = 0 generate

    -- Bits of a quarter of a. a is padded with zeros, so that no quarter is empty.
    constant c_digit : positive := (g_a_bits + 3) / 4; -- evaluated at elaboration

    subtype digit_t is unsigned(c_digit + g_b_bits - 1 downto 0);
    subtype half_t  is unsigned(2 * c_digit + g_b_bits - 1 downto 0);
    subtype whole_t is unsigned(4 * c_digit + g_b_bits - 1 downto 0);

    type digits_t is array (0 to 3) of digit_t;

    type halves_t is array (0 to 1) of half_t;

    type reg_t is record
      filled  : std_logic_vector(1 to 2); -- the quarters, or the halves, belong to new operands
      digits  : digits_t;
      halves  : halves_t;
      product : whole_t;
    end record;

    -- Multiply a quarter of a by b.
    function product_of (digit, word : unsigned) return digit_t is
      variable result : digit_t;
    begin
      if g_gated then
        return digit * word;
      end if;
      -- Add b under an `if`: the cells of the sum then include the gate for b, and only one term needs lookup tables. If
      -- a gate drives a, such a cell would need one input too many.
      result := (others => '0');
      for place in digit'range loop
        result := shift_left(result, 1);
        if digit(place) = '1' then
          result := result + word;
        end if;
      end loop;
      return result;
    end function;

    signal r : reg_t;

    signal padded : std_logic_vector(4 * c_digit - 1 downto 0);

  begin

    padded <= std_logic_vector(resize(unsigned(a), padded'length));

    registers : process (clk)
      variable digit  : unsigned(c_digit - 1 downto 0);
      variable result : digit_t;
    begin
      if rising_edge(clk) then
        r.filled <= enable & r.filled(1);
        if enable = '1' then
          for i in digits_t'range loop
            digit  := unsigned(padded((i + 1) * c_digit - 1 downto i * c_digit));
            result := product_of(digit, unsigned(b));
            -- If the quarter's highest bit is zero, so is the highest bit of its product. With this gate written out,
            -- that bit is the sum's own cell.
            result(digit_t'high) := result(digit_t'high) and digit(digit'high);
            r.digits(i) <= result;
          end loop;
        end if;
        if r.filled(1) = '1' then
          for i in halves_t'range loop
            r.halves(i)(half_t'high downto c_digit) <= resize(r.digits(2 * i + 1), half_t'length - c_digit)
              + resize(r.digits(2 * i)(digit_t'high downto c_digit), half_t'length - c_digit);
            r.halves(i)(c_digit - 1 downto 0) <= r.digits(2 * i)(c_digit - 1 downto 0);
          end loop;
        end if;
        if r.filled(2) = '1' then
          r.product(whole_t'high downto 2 * c_digit) <= resize(r.halves(1), whole_t'length - 2 * c_digit)
            + resize(r.halves(0)(half_t'high downto 2 * c_digit), whole_t'length - 2 * c_digit);
          r.product(2 * c_digit - 1 downto 0) <= r.halves(0)(2 * c_digit - 1 downto 0);
        end if;
      end if;
    end process;

    product <= std_logic_vector(r.product(product'range));

  else generate

    -- Pieces of a and of b, both padded with zeros to whole pieces.
    constant c_a_pieces : positive := (g_a_bits + g_multiplier_bits - 1) / g_multiplier_bits; -- evaluated at elaboration
    constant c_b_pieces : positive := (g_b_bits + g_multiplier_bits - 1) / g_multiplier_bits; -- evaluated at elaboration

    subtype piece_t is unsigned(g_multiplier_bits - 1 downto 0);
    subtype a_t     is unsigned(c_a_pieces * g_multiplier_bits - 1 downto 0);
    subtype b_t     is unsigned(c_b_pieces * g_multiplier_bits - 1 downto 0);
    subtype whole_t is unsigned(a_t'length + b_t'length - 1 downto 0);

    type products_t is array (0 to c_a_pieces * c_b_pieces - 1) of unsigned(2 * g_multiplier_bits - 1 downto 0);

    type reg_t is record
      filled   : std_logic_vector(1 to 2); -- operands, or products of pieces, are new
      a        : a_t;
      b        : b_t;
      products : products_t;
      product  : whole_t;
    end record;

    -- The piece of the word with this number, from the lowest one.
    function piece_of (word : unsigned; number : natural) return piece_t is
    begin
      return word((number + 1) * g_multiplier_bits - 1 downto number * g_multiplier_bits);
    end function;

    signal r : reg_t;

  begin

    registers : process (clk)
      variable sum : whole_t;
    begin
      if rising_edge(clk) then
        r.filled <= enable & r.filled(1);
        if enable = '1' then
          r.a <= resize(unsigned(a), a_t'length);
          r.b <= resize(unsigned(b), b_t'length);
        end if;
        if r.filled(1) = '1' then
          for i in 0 to c_a_pieces - 1 loop
            for j in 0 to c_b_pieces - 1 loop
              r.products(i * c_b_pieces + j) <= piece_of(r.a, i) * piece_of(r.b, j);
            end loop;
          end loop;
        end if;
        if r.filled(2) = '1' then
          sum := (others => '0');
          for i in 0 to c_a_pieces - 1 loop
            for j in 0 to c_b_pieces - 1 loop
              sum := sum + shift_left(resize(r.products(i * c_b_pieces + j), sum'length), (i + j) * g_multiplier_bits);
            end loop;
          end loop;
          r.product <= sum;
        end if;
      end if;
    end process;

    product <= std_logic_vector(r.product(product'range));

  end generate;

end architecture;
