-- SPDX-License-Identifier: Apache-2.0
--
-- Common functions of the shading processors' arithmetic: latencies, rounding, cosines.
-- Golden twins model/golden/vector_multiply.hpp (round_half_up), model/golden/unit_vector.hpp (cosine, positive)

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.function_pkg.all;
use work.processors_pkg.all;

package shading_pkg is

  -- Clocks from an entity's inputs to its result. Preset exact is always pipelined, but for
  -- the folded form's block shift. Preset published is pipelined in the unrolled form; folded, it has the clocks of
  -- table 4, except for spots.
  constant c_spot_cone_latency : positive := 8;

  function vector_shift_latency (pipelined : boolean) return positive;

  function dot_product_latency (exact, pipelined : boolean) return positive;

  function vector_multiply_latency (exact : boolean) return positive;

  function reciprocal_root_latency (exact : boolean) return positive;

  function power_latency (exact, pipelined : boolean) return positive;

  -- Drop the lowest `bits` bits and round to the nearest, halves up. The result has one more bit than the others.
  function round_half_up (value : signed; bits : natural) return signed;

  function round_half_up (value : unsigned; bits : natural) return unsigned;

  -- Clamp to the largest word of `bits` bits.
  function clamped (value : unsigned; bits : positive) return unsigned;

  -- The component of axis `axis` of a flat vector of c_axes.
  function axis_of (vector : std_logic_vector; axis : natural) return signed;

  -- A dot product of directions as a cosine, clamped to 0 to 1: one whole bit and direction's fraction. is_positive:
  -- the light is above the horizon.
  function cosine (exact : boolean; dot : signed) return unsigned;

  function is_positive (dot : signed) return std_logic;

  -- Bits of an index of that many places, at least 1.
  function index_bits (places : positive) return positive;

  -- The width of function_rom's words: the value is lowest, the slope, if there is one, above it.
  function sample_bits (exact : boolean; which : natural) return positive;

end package;

package body shading_pkg is

  function vector_shift_latency (pipelined : boolean) return positive is
  begin
    return 1 + boolean'pos(pipelined);
  end function;

  function dot_product_latency (exact, pipelined : boolean) return positive is
  begin
    if exact then
      return 3;
    elsif pipelined then
      return 2;
    end if;
    return 1;
  end function;

  function vector_multiply_latency (exact : boolean) return positive is
  begin
    if exact then
      return 2;
    end if;
    return 1;
  end function;

  function reciprocal_root_latency (exact : boolean) return positive is
  begin
    if formats(exact).root.fraction > formats(exact).root_entry.fraction then
      return 7;
    end if;
    return 1;
  end function;

  function power_latency (exact, pipelined : boolean) return positive is
  begin
    if exact then
      return 11;
    elsif pipelined then
      return 7;
    end if;
    return 2;
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

  function clamped (value : unsigned; bits : positive) return unsigned is
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
    constant c_bits : positive := vector'length / c_axes; -- evaluated at elaboration
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

  function index_bits (places : positive) return positive is
    variable bits : positive := 1;
  begin
    while 2 ** bits < places loop
      bits := bits + 1;
    end loop;
    return bits;
  end function;

  function sample_bits (exact : boolean; which : natural) return positive is
  begin
    return function_format(exact, which).value_bits + function_format(exact, which).slope_bits;
  end function;

end package body;
