-- SPDX-License-Identifier: Apache-2.0
--
-- Flat vectors of three signed components, x lowest.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

package vector_pkg is

  -- The lowest bits of a signed word.
  function low_bits (value : signed; bits : positive) return std_logic_vector;

  -- The sum of two vectors, with `bits` bits per component.
  function sums (a, b : std_logic_vector; bits : positive) return std_logic_vector;

  -- Each component of a vector sign-extended to `bits` bits.
  function widened (vector : std_logic_vector; bits : positive) return std_logic_vector;

  -- The lowest `bits` bits of each component.
  function low_words (vector : std_logic_vector; bits : positive) return std_logic_vector;

  -- A vector whose components are all `word`.
  function repeated (word : std_logic_vector) return std_logic_vector;

  -- The vector in the opposite direction.
  function negated (vector : std_logic_vector) return std_logic_vector;

  -- One unsigned word per channel as the components of a vector. Adds a sign bit; unused components are 0.
  function positive_words (words : std_logic_vector; channels : positive) return std_logic_vector;

end package;

package body vector_pkg is

  function low_bits (value : signed; bits : positive) return std_logic_vector is
    alias word : signed(value'length - 1 downto 0) is value;
  begin
    return std_logic_vector(word(bits - 1 downto 0));
  end function;

  function sums (a, b : std_logic_vector; bits : positive) return std_logic_vector is
    variable result : std_logic_vector(c_axes * bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * bits - 1 downto axis * bits) :=
        std_logic_vector(resize(axis_of(a, axis), bits) + axis_of(b, axis));
    end loop;
    return result;
  end function;

  function widened (vector : std_logic_vector; bits : positive) return std_logic_vector is
    variable result : std_logic_vector(c_axes * bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * bits - 1 downto axis * bits) := std_logic_vector(resize(axis_of(vector, axis), bits));
    end loop;
    return result;
  end function;

  function low_words (vector : std_logic_vector; bits : positive) return std_logic_vector is
    variable result : std_logic_vector(c_axes * bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * bits - 1 downto axis * bits) := low_bits(axis_of(vector, axis), bits);
    end loop;
    return result;
  end function;

  function repeated (word : std_logic_vector) return std_logic_vector is
    constant c_result : std_logic_vector(c_axes * word'length - 1 downto 0) := word & word & word;
  begin
    return c_result;
  end function;

  function negated (vector : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := vector'length / c_axes; -- evaluated at elaboration

    variable result : std_logic_vector(vector'length - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * c_bits - 1 downto axis * c_bits) := std_logic_vector(-axis_of(vector, axis));
    end loop;
    return result;
  end function;

  function positive_words (words : std_logic_vector; channels : positive) return std_logic_vector is
    constant c_bits : positive := words'length / channels; -- evaluated at elaboration
    alias flat      : std_logic_vector(words'length - 1 downto 0) is words;

    variable result : std_logic_vector(c_axes * (c_bits + 1) - 1 downto 0) := (others => '0');
  begin
    for channel in 0 to channels - 1 loop
      result(channel * (c_bits + 1) + c_bits - 1 downto channel * (c_bits + 1)) :=
        flat((channel + 1) * c_bits - 1 downto channel * c_bits);
    end loop;
    return result;
  end function;

end package body;
