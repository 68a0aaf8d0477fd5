-- SPDX-License-Identifier: Apache-2.0
-- Unsigned sums, products and comparisons against C++'s integers; all functions against numeric_std's operators: all words
-- of up to 6 bits, all bits of '0', '1', 'U' and 'X' up to 2 bits, random and extreme words of up to 40 bits, and such
-- words with a bit that is neither '0' nor '1'.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.quick_numeric_pkg.all;
use work.tb_pkg.all;

entity quick_numeric_pkg_tb is
  generic (
    g_folder : string := "quick_numeric_pkg"
  );
end entity;

architecture sim of quick_numeric_pkg_tb is
begin
  run : process is
    type values_t is array (0 to 3) of std_ulogic;
    constant c_values  : values_t := ('0', '1', 'U', 'X');

    variable random : unsigned(31 downto 0) := x"2545F491";

    procedure check (name : in string; got, expected : in std_logic_vector) is
    begin
      if got /= expected then
        report "quick_numeric_pkg: " & name & " is " & to_string(got) & ", expected " & to_string(expected)
          severity failure;
      end if;
    end procedure;

    procedure check (name : in string; got, expected : in boolean) is
    begin
      if got /= expected then
        report "quick_numeric_pkg: " & name & " is " & to_string(got) & ", expected " & to_string(expected)
          severity failure;
      end if;
    end procedure;

    function of_two (name : string; a, b : unsigned) return string is
    begin
      return name & " of " & to_string(a) & " and " & to_string(b);
    end function;

    procedure check_two (a, b : in unsigned) is
    begin
      check(of_two("sum of unsigned", a, b), std_logic_vector(sum(a, b)), std_logic_vector(a + b));
      check(of_two("sum of signed", a, b), std_logic_vector(sum(signed(a), signed(b))),
        std_logic_vector(signed(a) + signed(b)));
      check(of_two("difference", a, b), std_logic_vector(difference(a, b)), std_logic_vector(a - b));
      check(of_two("equal", a, b), equal(a, b), a = b);
    end procedure;

    procedure check_one (a : in unsigned) is
    begin
      check("next_of unsigned " & to_string(a), std_logic_vector(next_of(a)), std_logic_vector(a + 1));
      check("next_of signed " & to_string(a), std_logic_vector(next_of(signed(a))), std_logic_vector(signed(a) + 1));
      check("before unsigned " & to_string(a), std_logic_vector(before(a)), std_logic_vector(a - 1));
      check("before signed " & to_string(a), std_logic_vector(before(signed(a))), std_logic_vector(signed(a) - 1));
      check("is_zero " & to_string(a), is_zero(a), a = 0);
      if a'length < 32 then
        if index_of(a) /= to_integer(a) then
          report "quick_numeric_pkg: index_of " & to_string(a) & " is " & to_string(index_of(a)) severity failure;
        end if;
      end if;
    end procedure;

    procedure check_products (a, b : in unsigned) is
    begin
      check(of_two("product of signed", a, b), std_logic_vector(product(signed(a), signed(b))),
        std_logic_vector(signed(a) * signed(b)));
      check(of_two("product of unsigned", a, b), std_logic_vector(product(a, b)), std_logic_vector(a * b));
    end procedure;

    procedure check_sum_of_products (a_bits, b_bits : in positive) is
      variable a, c  : unsigned(a_bits - 1 downto 0);
      variable b, d  : unsigned(b_bits - 1 downto 0);
      variable whole : signed(a_bits + b_bits downto 0);
    begin
      draw_word(random, a);
      draw_word(random, b);
      draw_word(random, c);
      draw_word(random, d);
      check_products(a, b);
      whole := resize(signed(a) * signed(b), whole'length) + signed(c) * signed(d) + signed(c) * signed(b);
      check("sum of three products", std_logic_vector(sum_of_products(std_logic_vector(c & c & a),
        std_logic_vector(b & d & b), 3, whole'length)), std_logic_vector(whole));
    end procedure;

    procedure check_random (bits : in positive) is
      variable a, b    : unsigned(bits - 1 downto 0);
      variable unknown : unsigned(bits - 1 downto 0);
      variable all_unknown : std_logic_vector(2 * bits downto 0);
    begin
      draw_word(random, a);
      draw_word(random, b);
      check_two(a, b);
      check_two(a, a);
      check_one(a);
      check_products(a, b);
      unknown                                        := a;
      unknown(to_integer(random(12 downto 0)) mod bits) := c_values(2 + to_integer(random(13 downto 13)));
      check_two(unknown, b);
      check_two(b, unknown);
      check_two(unknown, unknown);
      check_one(unknown);
      check_products(unknown, b);
      check_products(b, unknown);
      all_unknown := (others => 'X');
      check("sum of products with a bit unknown", std_logic_vector(sum_of_products(std_logic_vector(a & unknown),
        std_logic_vector(b & b), 2, 2 * bits + 1)), all_unknown);
    end procedure;

    -- What is meant, from C++.
    procedure check_vectors (bits : in positive) is
      variable vectors  : vectors_t;
      variable a_word   : std_logic_vector(bits - 1 downto 0);
      variable b_word   : std_logic_vector(bits - 1 downto 0);
      variable a, b     : unsigned(bits - 1 downto 0);
    begin
      vectors.open_file(g_folder & "/" & to_string(bits) & ".txt");
      while vectors.next_vector loop
        vectors.read_word(a_word);
        vectors.read_word(b_word);
        a := unsigned(a_word);
        b := unsigned(b_word);
        vectors.check_word("sum", std_logic_vector(sum(a, b)));
        vectors.check_word("difference", std_logic_vector(difference(a, b)));
        vectors.check_word("next_of", std_logic_vector(next_of(a)));
        vectors.check_word("before", std_logic_vector(before(a)));
        vectors.check_word("product", std_logic_vector(product(a, b)));
        vectors.check_flag("equal", to_flag(equal(a, b)));
        vectors.check_flag("is_zero", to_flag(is_zero(a)));
      end loop;
    end procedure;

    variable word   : unsigned(3 downto 0);
    variable digits : natural;
  begin
    check_vectors(1);
    check_vectors(8);
    check_vectors(13);
    check_vectors(32);
    for bits in 1 to 6 loop
      for a in 0 to 2 ** bits - 1 loop
        check_one(to_unsigned(a, bits));
        for b in 0 to 2 ** bits - 1 loop
          check_two(to_unsigned(a, bits), to_unsigned(b, bits));
          check_products(to_unsigned(a, bits), to_unsigned(b, bits));
        end loop;
      end loop;
    end loop;
    for number in 0 to 4 ** word'length - 1 loop
      digits := number;
      for i in word'range loop
        word(i) := c_values(digits mod 4);
        digits  := digits / 4;
      end loop;
      check_one(word);
      check_two(word(3 downto 2), word(1 downto 0));
      check_products(word(3 downto 2), word(1 downto 0));
    end loop;
    for bits in 7 to 40 loop
      for i in 1 to 64 loop
        check_random(bits);
      end loop;
    end loop;
    for a_bits in 2 to 34 loop
      for b_bits in 2 to 34 loop
        for i in 1 to 8 loop
          check_sum_of_products(a_bits, b_bits);
        end loop;
      end loop;
    end loop;
    report "quick_numeric_pkg_tb: passed" severity note;
    wait;
  end process;
end architecture;
