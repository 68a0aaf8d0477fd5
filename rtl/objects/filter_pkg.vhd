-- SPDX-License-Identifier: Apache-2.0
--
-- The weights of the filter: of a pixel and of three neighbours, in the order of c_itself to c_above_left. Their sum is a
-- power of two. A neighbour with weight 0 is not in the filter's support.
-- Golden twin model/golden/pixel_filter.hpp

package filter_pkg is

  constant c_itself     : natural := 0;
  constant c_left       : natural := 1;
  constant c_above      : natural := 2;
  constant c_above_left : natural := 3;

  type filter_weights_t is array (c_itself to c_above_left) of natural;

  constant c_filter_weights : filter_weights_t := (1, 1, 1, 1);

  function sum_of (weights : filter_weights_t) return natural;

  -- Logarithm of a power of two; of another number, that of the next power.
  function log2 (number : natural) return natural;

  -- Bits of a number of subpixels, 0 to `subpixels`.
  function weight_bits (subpixels : positive) return positive;

end package;

package body filter_pkg is

  function sum_of (weights : filter_weights_t) return natural is
    variable sum : natural := 0;
  begin
    for i in weights'range loop
      sum := sum + weights(i);
    end loop;
    return sum;
  end function;

  function log2 (number : natural) return natural is
    variable bits : natural := 0;
  begin
    while 2 ** bits < number loop
      bits := bits + 1;
    end loop;
    return bits;
  end function;

  function weight_bits (subpixels : positive) return positive is
  begin
    return log2(subpixels) + 1;
  end function;

end package body;
