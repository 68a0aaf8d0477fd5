-- SPDX-License-Identifier: Apache-2.0
--
-- What every clock asks of numeric_std, for a simulator: there numeric_std makes copies of copies. In hardware each is the
-- operator beside it; so it is in simulation, and where a bit is neither '0' nor '1' ('H' and 'L' too) gives all 'X', false,
-- or index 0.
-- Golden twin none: the golden model has integers

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package quick_numeric_pkg is

  -- a + b, of the same width.
  function sum (a, b : unsigned) return unsigned;

  function sum (a, b : signed) return signed;

  -- a - b, of the same width.
  function difference (a, b : unsigned) return unsigned;

  -- value + 1
  function next_of (value : unsigned) return unsigned;

  function next_of (value : signed) return signed;

  -- value - 1
  function before (value : unsigned) return unsigned;

  function before (value : signed) return signed;

  -- a = b, of the same width.
  function equal (a, b : unsigned) return boolean;

  -- value = 0
  function is_zero (value : unsigned) return boolean;

  -- a * b
  function product (a, b : signed) return signed;

  function product (a, b : unsigned) return unsigned;

  -- Of `terms` pairs of signed words, one of a and one of b, the first lowest: `bits` bits, no fewer than a product
  -- has, of the sum of their products. `terms` divides both lengths.
  function sum_of_products (a, b : std_logic_vector; terms, bits : positive) return signed;

  -- to_integer(value), which is 0 where a bit is neither '0' nor '1'; of 31 bits at most.
  function index_of (value : unsigned) return natural;

end package;

package body quick_numeric_pkg is

  -- GHDL checks every access against the bounds: so a place is read once and written once.
  -- synthesis translate_off
  function bits_of_sum (a, b : std_logic_vector; carry : std_ulogic) return std_logic_vector is
    variable word    : std_logic_vector(a'length - 1 downto 0) := a;
    variable addend  : std_logic_vector(a'length - 1 downto 0) := b;
    variable x, y    : std_ulogic;
    variable carried : std_ulogic := carry;
    variable known   : boolean    := true;
  begin
    for i in word'reverse_range loop
      x := word(i);
      y := addend(i);
      if x = y then
        word(i) := carried;
        carried := x;
        known   := known and (x = '0' or x = '1');
      else
        known := known and (x = '0' or x = '1') and (y = '0' or y = '1');
        if carried = '0' then
          word(i) := '1';
        else
          word(i) := '0';
        end if;
      end if;
    end loop;
    if not known then
      word := (others => 'X');
    end if;
    return word;
  end function;

  -- One more, where `passed` is '1', or one less: the lowest bits that are `passed` change, and the one above them.
  function bits_beside (value : std_logic_vector; passed : std_ulogic) return std_logic_vector is
    variable word   : std_logic_vector(value'length - 1 downto 0) := value;
    variable passes : boolean                                     := true;
    variable known  : boolean                                     := true;
    variable x      : std_ulogic;
  begin
    for i in word'reverse_range loop
      x     := word(i);
      known := known and (x = '0' or x = '1');
      if passes then
        passes := x = passed;
        if x = '0' then
          word(i) := '1';
        else
          word(i) := '0';
        end if;
      end if;
    end loop;
    if not known then
      word := (others => 'X');
    end if;
    return word;
  end function;

  -- Words as digits to base 2**c_digit_bits, so that a column of digits' products fits an integer.
  constant c_digit_bits : positive := 13;

  type digits_t is array (natural range <>) of integer;

  function digit_count (bits : positive) return positive is
  begin
    return (bits + c_digit_bits - 1) / c_digit_bits;
  end function;

  -- Lowest first; the last one carries the sign. Behind it: how many bits are neither '0' nor '1'.
  function to_digits (value : signed) return digits_t is
    alias bits       : signed(value'length - 1 downto 0) is value;
    constant c_count : positive := digit_count(value'length);

    variable digits  : digits_t(0 to c_count);
    variable digit   : integer := 0;
    variable place   : natural := 0;
    variable weight  : natural := 1;
    variable unknown : natural := 0;
    variable x       : std_ulogic;
  begin
    for i in 0 to bits'high loop
      x := bits(i);
      if x = '1' then
        if i = bits'high then
          digit := digit - weight;
        else
          digit := digit + weight;
        end if;
      elsif x /= '0' then
        unknown := unknown + 1;
      end if;
      weight := weight + weight;
      if weight = 2 ** c_digit_bits or i = bits'high then
        digits(place) := digit;
        place         := place + 1;
        digit         := 0;
        weight        := 1;
      end if;
    end loop;
    digits(c_count) := unknown;
    return digits;
  end function;

  -- Of `terms` pairs of words, `bits` bits of their products' sum.
  function sum_in_integers (a, b : signed; terms, bits : positive) return signed is
    constant c_a_bits : positive := a'length / terms;
    constant c_b_bits : positive := b'length / terms;
    constant c_a      : positive := digit_count(c_a_bits);
    constant c_b      : positive := digit_count(c_b_bits);
    alias words_a     : signed(a'length - 1 downto 0) is a;
    alias words_b     : signed(b'length - 1 downto 0) is b;

    variable columns : digits_t(0 to c_a + c_b - 2) := (others => 0);
    variable a_digit : digits_t(0 to c_a);
    variable b_digit : digits_t(0 to c_b);
    variable whole   : signed(bits - 1 downto 0);
    variable carry   : integer := 0;
    variable half    : integer;
    variable place   : natural := 0;
    variable left    : natural := 0;
    variable unknown : natural := 0;
  begin
    for term in 0 to terms - 1 loop
      a_digit := to_digits(words_a((term + 1) * c_a_bits - 1 downto term * c_a_bits));
      b_digit := to_digits(words_b((term + 1) * c_b_bits - 1 downto term * c_b_bits));
      unknown := unknown + a_digit(c_a) + b_digit(c_b);
      for i in 0 to c_a - 1 loop
        for j in 0 to c_b - 1 loop
          columns(i + j) := columns(i + j) + a_digit(i) * b_digit(j);
        end loop;
      end loop;
    end loop;
    for i in whole'reverse_range loop
      if left = 0 then
        if place <= columns'high then
          carry := carry + columns(place);
        end if;
        place := place + 1;
        left  := c_digit_bits;
      end if;
      left     := left - 1;
      half     := carry / 2;
      whole(i) := '1';
      if carry = half + half then
        whole(i) := '0';
      elsif carry < 0 then
        half := half - 1;
      end if;
      carry := half;
    end loop;
    if unknown > 0 then
      whole := (others => 'X');
    end if;
    return whole;
  end function;
  -- synthesis translate_on

  function sum (a, b : unsigned) return unsigned is
  begin
    -- synthesis translate_off
    return unsigned(bits_of_sum(std_logic_vector(a), std_logic_vector(b), '0'));
    -- synthesis translate_on
    return a + b;
  end function;

  function sum (a, b : signed) return signed is
  begin
    -- synthesis translate_off
    return signed(bits_of_sum(std_logic_vector(a), std_logic_vector(b), '0'));
    -- synthesis translate_on
    return a + b;
  end function;

  function difference (a, b : unsigned) return unsigned is
  begin
    -- synthesis translate_off
    return unsigned(bits_of_sum(std_logic_vector(a), not std_logic_vector(b), '1'));
    -- synthesis translate_on
    return a - b;
  end function;

  function next_of (value : unsigned) return unsigned is
  begin
    -- synthesis translate_off
    return unsigned(bits_beside(std_logic_vector(value), '1'));
    -- synthesis translate_on
    return value + 1;
  end function;

  function next_of (value : signed) return signed is
  begin
    -- synthesis translate_off
    return signed(bits_beside(std_logic_vector(value), '1'));
    -- synthesis translate_on
    return value + 1;
  end function;

  function before (value : unsigned) return unsigned is
  begin
    -- synthesis translate_off
    return unsigned(bits_beside(std_logic_vector(value), '0'));
    -- synthesis translate_on
    return value - 1;
  end function;

  function before (value : signed) return signed is
  begin
    -- synthesis translate_off
    return signed(bits_beside(std_logic_vector(value), '0'));
    -- synthesis translate_on
    return value - 1;
  end function;

  function equal (a, b : unsigned) return boolean is
    -- synthesis translate_off
    variable word   : std_logic_vector(a'length - 1 downto 0) := std_logic_vector(a);
    variable beside : std_logic_vector(a'length - 1 downto 0) := std_logic_vector(b);
    variable x      : std_ulogic;
    -- synthesis translate_on
  begin
    -- synthesis translate_off
    for i in word'range loop
      x := word(i);
      if x /= beside(i) or (x /= '0' and x /= '1') then
        return false;
      end if;
    end loop;
    return true;
    -- synthesis translate_on
    return a = b;
  end function;

  function is_zero (value : unsigned) return boolean is
  begin
    -- synthesis translate_off
    for i in value'range loop
      if value(i) /= '0' then
        return false;
      end if;
    end loop;
    return true;
    -- synthesis translate_on
    return value = 0;
  end function;

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

  function sum_of_products (a, b : std_logic_vector; terms, bits : positive) return signed is
    constant c_a_bits : positive := a'length / terms; -- elaboration only
    constant c_b_bits : positive := b'length / terms; -- elaboration only
    alias words_a     : std_logic_vector(a'length - 1 downto 0) is a;
    alias words_b     : std_logic_vector(b'length - 1 downto 0) is b;

    variable whole : signed(bits - 1 downto 0);
  begin
    -- synthesis translate_off
    assert c_a_bits * terms = a'length and c_b_bits * terms = b'length and bits >= c_a_bits + c_b_bits
      report "sum_of_products: " & integer'image(terms) & " terms of " & integer'image(a'length) & " and "
      & integer'image(b'length) & " bits to " & integer'image(bits)
      severity failure;
    return sum_in_integers(signed(a), signed(b), terms, bits);
    -- synthesis translate_on
    whole := (others => '0');
    for term in 0 to terms - 1 loop
      whole := whole + signed(words_a((term + 1) * c_a_bits - 1 downto term * c_a_bits))
        * signed(words_b((term + 1) * c_b_bits - 1 downto term * c_b_bits));
    end loop;
    return whole;
  end function;

  function index_of (value : unsigned) return natural is
    -- synthesis translate_off
    variable index : natural := 0;
    -- synthesis translate_on
  begin
    -- synthesis translate_off
    for i in value'range loop
      index := index + index;
      if value(i) = '1' then
        index := index + 1;
      elsif value(i) /= '0' then
        return 0;
      end if;
    end loop;
    return index;
    -- synthesis translate_on
    return to_integer(value);
  end function;

end package body;
