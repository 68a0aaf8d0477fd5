-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The parts of a skewed word: a word that is cut into parts of equal width, each valid one clock after the
--             part below it. Then a sum needs no carry chain longer than a part: each carry waits in a register for the
--             part above.
--
--               clock            t         t + 1      t + 2
--               bits of part 0   word A    word B     word C
--               bits of part 1             word A     word B     of the same vector
--
--             Entities that work on skewed words (skewed_interpolator, skewed_register, skewed_multiplexer) take plain
--             strobes, in the clock of part 0, and delay them themselves (skewed_strobe). deskew aligns the parts.
-- Source      none: the papers' words are not cut

package skew_pkg is

  -- The lowest bit of a part, and with part = parts the number of bits. Where parts does not divide bits, the upper
  -- parts are a bit wider.
  function part_low (bits, parts, part : natural) return natural;

end package;

package body skew_pkg is

  function part_low (bits, parts, part : natural) return natural is
  begin
    return part * bits / parts; -- evaluated at elaboration
  end function;

end package body;
