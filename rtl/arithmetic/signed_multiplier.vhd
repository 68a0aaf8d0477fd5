-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Product of two signed words, cut to fit the multipliers of 18 bits that FPGAs have. A word of more than 18
--             bits is cut into pieces of 17 bits; its highest piece has the sign and at most 18 bits.
--               clock 1  the products of all pieces; with g_clocks = 1 also their sum
--               clock 2  their sum, with g_clocks = 2
--             Products of small pieces are sums of rows, in lookup tables.
-- Formats     a: g_a_bits, b: g_b_bits, product: g_a_bits + g_b_bits; signed
-- Latency     g_clocks clocks
-- Throughput  1 product per clock
-- Error       none
-- Source      ours: the papers have no multipliers of a given width
-- Golden twin model/golden/vector_multiply.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity signed_multiplier is
  generic (
    g_a_bits : positive;
    g_b_bits : positive;
    g_clocks : positive range 1 to 2
  );
  port (
    clk     : in  std_logic;
    a       : in  std_logic_vector(g_a_bits - 1 downto 0);
    b       : in  std_logic_vector(g_b_bits - 1 downto 0);
    product : out std_logic_vector(g_a_bits + g_b_bits - 1 downto 0)
  );
end entity;

architecture rtl of signed_multiplier is

  constant c_piece : positive := 17; -- bits of a piece without sign
  constant c_small : positive := 16; -- bits of a product that is a sum of rows
  constant c_few   : positive := 4;  -- bits of a factor whose product is a sum of rows

  function pieces (bits : positive) return positive is
  begin
    return (bits - 2) / c_piece + 1; -- evaluated at elaboration
  end function;

  constant c_a_pieces : positive := pieces(g_a_bits);
  constant c_b_pieces : positive := pieces(g_b_bits);

  subtype part_t is signed(2 * c_piece + 1 downto 0);
  subtype sum_t is signed(part_t'length + g_a_bits + g_b_bits - 1 downto 0); -- no part is made narrower

  type parts_t is array (0 to c_a_pieces * c_b_pieces - 1) of part_t;

  -- The piece of the word with this number, from the lowest one. The highest one has the word's sign.
  function piece_of (word : std_logic_vector; number : natural) return signed is
    constant c_low : natural := number * c_piece;
  begin
    if number = pieces(word'length) - 1 then
      return signed(word(word'high downto c_low));
    end if;
    return signed('0' & word(c_low + c_piece - 1 downto c_low));
  end function;

  -- A row for each bit of `right`: rows of the shorter factor make three products of one vector larger (measured).
  function product_of (left, right : signed) return part_t is
    alias digits : signed(right'length - 1 downto 0) is right;

    variable sum : signed(left'length + right'length - 1 downto 0) := (others => '0');
    variable row : signed(sum'range);
  begin
    if left'length > c_few and right'length > c_few and sum'length > c_small then
      return resize(left * right, part_t'length);
    end if;
    for place in digits'low to digits'high loop
      row := (others => '0');
      if digits(place) = '1' then
        row := shift_left(resize(left, row'length), place);
      end if;
      if place = digits'high then
        sum := sum - row;
      else
        sum := sum + row;
      end if;
    end loop;
    return resize(sum, part_t'length);
  end function;

  function products_of (left, right : std_logic_vector) return parts_t is
    variable parts : parts_t;
  begin
    for i in 0 to c_a_pieces - 1 loop
      for j in 0 to c_b_pieces - 1 loop
        parts(i * c_b_pieces + j) := product_of(piece_of(left, i), piece_of(right, j));
      end loop;
    end loop;
    return parts;
  end function;

  function sum_of (parts : parts_t) return sum_t is
    variable sum  : sum_t := (others => '0');
    variable part : part_t;
  begin
    for i in 0 to c_a_pieces - 1 loop
      for j in 0 to c_b_pieces - 1 loop
        part := parts(i * c_b_pieces + j);
        if i < c_a_pieces - 1 and j < c_b_pieces - 1 then
          -- Show the synthesizer that the product of two pieces without sign has none
          part(part_t'high downto 2 * c_piece) := (others => '0');
        end if;
        sum := sum + shift_left(resize(part, sum_t'length), (i + j) * c_piece);
      end loop;
    end loop;
    return sum;
  end function;

  signal parts : parts_t;

begin

  at_once : if g_clocks = 1 generate

    parts <= products_of(a, b);

  else generate

    split : process (clk)
    begin
      if rising_edge(clk) then
        parts <= products_of(a, b);
      end if;
    end process;

  end generate;

  add : process (clk)
    variable sum : sum_t;
  begin
    if rising_edge(clk) then
      sum     := sum_of(parts);
      product <= std_logic_vector(sum(product'range));
    end if;
  end process;

end architecture;
