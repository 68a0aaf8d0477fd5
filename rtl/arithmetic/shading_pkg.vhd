-- SPDX-License-Identifier: Apache-2.0
--
-- What the shading processors' arithmetic shares: latencies, products that simulate quickly, rounding, cosines.
-- Golden twins model/golden/vector_multiply.hpp (round_half_up), model/golden/unit_vector.hpp (cosine, positive)

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.function_pkg.all;
use work.processors_pkg.all;

package shading_pkg is

  -- Clocks with enable from an entity's inputs to what it makes of them.
  constant c_vector_shift_latency    : positive := 1;
  constant c_dot_product_latency     : positive := 1;
  constant c_vector_multiply_latency : positive := 1;
  constant c_spot_cone_latency       : positive := 4;

  function reciprocal_root_latency (exact : boolean) return positive;

  function power_latency (exact : boolean) return positive;

  -- Exact. GHDL takes these 15 to 50 times as quickly as numeric_std's "*", which it is in hardware. Bits that are
  -- neither '0' nor '1' count as '0'.
  function product (a, b : signed) return signed;

  function product (a, b : unsigned) return unsigned;

  -- Sum of the products of c_axes components a and b, the first lowest; a bit more than two of them have together.
  function sum_of_products (a, b : std_logic_vector) return signed;

  -- Without the lowest `bits` bits, to the nearest, halves up; a bit more than the others are.
  function round_half_up (value : signed; bits : natural) return signed;

  function round_half_up (value : unsigned; bits : natural) return unsigned;

  -- The lowest `bits` bits, or the largest word of them where the value is larger.
  function held (value : unsigned; bits : positive) return unsigned;

  -- The component of axis `axis` of a flat vector of c_axes.
  function axis_of (vector : std_logic_vector; axis : natural) return signed;

  -- A dot product of directions as a cosine, 0 to 1: one whole bit and direction's fraction. Positive: there is light
  -- from there.
  function cosine (exact : boolean; dot : signed) return unsigned;

  function is_positive (dot : signed) return std_logic;

  -- Of the words of function_rom: the value lowest, above it, where there is one, the slope.
  function sample_bits (exact : boolean; which : natural) return positive;

end package;

package body shading_pkg is

  function reciprocal_root_latency (exact : boolean) return positive is
  begin
    if formats(exact).root.fraction > formats(exact).root_entry.fraction then
      return 4;
    end if;
    return 1;
  end function;

  function power_latency (exact : boolean) return positive is
  begin
    if exact then
      return 6;
    end if;
    return 2;
  end function;

  -- Simulation alone: words as digits to base 2**c_digit_bits, so that a column of digits' products fits an integer.
  -- synthesis translate_off
  constant c_digit_bits : positive := 13;

  type digits_t is array (natural range <>) of integer;

  function digit_count (bits : positive) return positive is
  begin
    return (bits + c_digit_bits - 1) / c_digit_bits;
  end function;

  -- Lowest first; the last one carries the sign.
  function to_digits (value : signed) return digits_t is
    alias bits      : signed(value'length - 1 downto 0) is value;

    variable digits : digits_t(0 to digit_count(value'length) - 1) := (others => 0);
    variable place  : natural                                      := 0;
    variable weight : natural                                      := 1;
  begin
    for i in 0 to bits'high - 1 loop
      if bits(i) = '1' then
        digits(place) := digits(place) + weight;
      end if;
      weight := weight + weight;
      if weight = 2 ** c_digit_bits then
        place  := place + 1;
        weight := 1;
      end if;
    end loop;
    if bits(bits'high) = '1' then
      digits(place) := digits(place) - weight;
    end if;
    return digits;
  end function;

  -- Of `terms` pairs of words, `bits` bits of their products' sum.
  function sum_in_integers (a, b : signed; terms, bits : positive) return signed is
    constant c_a_bits : positive := a'length / terms;
    constant c_b_bits : positive := b'length / terms;
    constant c_a_high : natural := digit_count(c_a_bits) - 1;
    constant c_b_high : natural := digit_count(c_b_bits) - 1;
    alias words_a     : signed(a'length - 1 downto 0) is a;
    alias words_b     : signed(b'length - 1 downto 0) is b;

    variable columns : digits_t(0 to c_a_high + c_b_high) := (others => 0);
    variable a_digit : digits_t(0 to c_a_high);
    variable b_digit : digits_t(0 to c_b_high);
    variable sum     : signed(bits - 1 downto 0);
    variable carry   : integer := 0;
    variable half    : integer;
    variable place   : natural := 0;
    variable left    : natural := 0;
  begin
    for term in 0 to terms - 1 loop
      a_digit := to_digits(words_a((term + 1) * c_a_bits - 1 downto term * c_a_bits));
      b_digit := to_digits(words_b((term + 1) * c_b_bits - 1 downto term * c_b_bits));
      for i in a_digit'range loop
        for j in b_digit'range loop
          columns(i + j) := columns(i + j) + a_digit(i) * b_digit(j);
        end loop;
      end loop;
    end loop;
    for i in sum'reverse_range loop
      if left = 0 then
        if place <= columns'high then
          carry := carry + columns(place);
        end if;
        place := place + 1;
        left  := c_digit_bits;
      end if;
      left   := left - 1;
      half   := carry / 2;
      sum(i) := '1';
      if carry = half + half then
        sum(i) := '0';
      elsif carry < 0 then
        half := half - 1;
      end if;
      carry := half;
    end loop;
    return sum;
  end function;
  -- synthesis translate_on

  function product (a, b : signed) return signed is
  begin
    -- synthesis translate_off
    return sum_in_integers(a, b, 1, a'length + b'length);
    -- synthesis translate_on
    return a * b;
  end function;

  function product (a, b : unsigned) return unsigned is
    constant c_bits : positive := a'length + b'length;
  begin
    -- synthesis translate_off
    return unsigned(sum_in_integers(signed('0' & a), signed('0' & b), 1, c_bits));
    -- synthesis translate_on
    return a * b;
  end function;

  function sum_of_products (a, b : std_logic_vector) return signed is
    constant c_bits : positive := (a'length + b'length) / c_axes + 1; -- elaboration only

    variable sum : signed(c_bits - 1 downto 0);
  begin
    -- synthesis translate_off
    return sum_in_integers(signed(a), signed(b), c_axes, c_bits);
    -- synthesis translate_on
    sum := (others => '0');
    for axis in 0 to c_axes - 1 loop
      sum := sum + axis_of(a, axis) * axis_of(b, axis);
    end loop;
    return sum;
  end function;

  function round_half_up (value : signed; bits : natural) return signed is
    alias word      : signed(value'length - 1 downto 0) is value;
    constant c_bits : positive := value'length - bits + 1;
  begin
    if bits = 0 then
      return resize(word, c_bits);
    end if;
    return resize(word(word'high downto bits), c_bits) + ('0' & word(bits - 1 downto bits - 1));
  end function;

  function round_half_up (value : unsigned; bits : natural) return unsigned is
    alias word      : unsigned(value'length - 1 downto 0) is value;
    constant c_bits : positive := value'length - bits + 1;
  begin
    if bits = 0 then
      return resize(word, c_bits);
    end if;
    return resize(word(word'high downto bits), c_bits) + word(bits - 1 downto bits - 1);
  end function;

  function held (value : unsigned; bits : positive) return unsigned is
    alias word        : unsigned(value'length - 1 downto 0) is value;
    constant c_zeros  : unsigned(value'length - 1 downto bits) := (others => '0');

    variable result : unsigned(bits - 1 downto 0);
  begin
    result := word(bits - 1 downto 0);
    if word(word'high downto bits) /= c_zeros then
      result := (others => '1');
    end if;
    return result;
  end function;

  function axis_of (vector : std_logic_vector; axis : natural) return signed is
    constant c_bits : positive := vector'length / c_axes; -- elaboration only
    alias flat      : std_logic_vector(vector'length - 1 downto 0) is vector;
  begin
    return signed(flat((axis + 1) * c_bits - 1 downto axis * c_bits));
  end function;

  function cosine (exact : boolean; dot : signed) return unsigned is
    constant c_fraction : positive := formats(exact).direction.fraction;
    alias word          : signed(dot'length - 1 downto 0) is dot;
    constant c_zero     : signed(dot'length - 1 downto 2 * c_fraction) := (others => '0');

    variable one     : unsigned(c_fraction downto 0) := (others => '0');
    variable rounded : unsigned(c_fraction downto 0);
  begin
    rounded := round_half_up(unsigned(word(2 * c_fraction - 1 downto 0)), c_fraction);
    if word(word'high) = '1' then
      return one;
    end if;
    if word(word'high downto 2 * c_fraction) /= c_zero then
      one(c_fraction) := '1';
      return one;
    end if;
    return rounded;
  end function;

  function is_positive (dot : signed) return std_logic is
    constant c_zero : signed(dot'length - 1 downto 0) := (others => '0');
  begin
    if dot(dot'left) = '0' and dot /= c_zero then
      return '1';
    end if;
    return '0';
  end function;

  function sample_bits (exact : boolean; which : natural) return positive is
  begin
    return function_format(exact, which).value_bits + function_format(exact, which).slope_bits;
  end function;

end package body;
