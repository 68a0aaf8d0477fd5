-- SPDX-License-Identifier: Apache-2.0
--
-- Positions of the channels' blocks in an init vector of the quadratic shader. With degree 2 a channel has its whole
-- block; with degree 1, Gouraud's shading, only the block's lower words: the second differences are zero.
-- Golden twin model/words/quadratic_layout.hpp

use work.formats_pkg.all;

package quadratic_pkg is

  -- Bits of one channel's block.
  function channel_bits (exact : boolean; degree : positive) return positive;

  -- Lowest bit of a channel's block.
  function channel_low (exact : boolean; degree : positive; channel : natural) return positive;

  -- Bits of an init vector.
  function init_bits (exact : boolean; degree, channels : positive) return positive;

end package;

package body quadratic_pkg is

  function channel_bits (exact : boolean; degree : positive) return positive is
  begin
    if degree = 1 then
      return init_channel(exact).dxx.low;
    end if;
    return init_bits(exact, 1) - init_bits(exact, 0);
  end function;

  function channel_low (exact : boolean; degree : positive; channel : natural) return positive is
  begin
    return init_bits(exact, 0) + channel * channel_bits(exact, degree);
  end function;

  function init_bits (exact : boolean; degree, channels : positive) return positive is
  begin
    return channel_low(exact, degree, channels);
  end function;

end package body;
