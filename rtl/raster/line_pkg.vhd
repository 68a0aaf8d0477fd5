-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The line record that passes from stage to stage of the triangle walker.
-- Formats     formats_pkg; triangle, pixel_y and span_x are the same in both presets

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

package line_pkg is

  subtype triangle_t is std_logic_vector(formats(true).triangle.bits - 1 downto 0);
  subtype pixel_y_t is unsigned(formats(true).pixel_y.bits - 1 downto 0);
  subtype span_x_t is signed(formats(true).span_x.bits - 1 downto 0);

  -- Pixels of a line, counted from 0.
  subtype pixels_t is unsigned(span_x_t'range);

  -- A line of a triangle: the pixels from start to the one before stop.
  type line_t is record
    triangle  : triangle_t;
    y         : pixel_y_t;
    start     : span_x_t;
    stop      : span_x_t;
    remaining : pixels_t; -- pixels after the one at start; undefined in an empty line
    empty     : std_logic; -- the line covers no pixel
    backward  : std_logic; -- spans run to smaller x
    carry     : std_logic; -- the start edge's next step ends one pixel further right than its quotient says
  end record;

  -- '1' where the condition is true.
  function flag (condition : boolean) return std_logic;

end package;

package body line_pkg is

  function flag (condition : boolean) return std_logic is
    variable result : std_logic := '0';
  begin
    if condition then
      result := '1';
    end if;
    return result;
  end function;

end package body;
