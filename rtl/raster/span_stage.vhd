-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Draws the pixels of a span, from the start of a line to the pixel before its stop.
-- Contract    enable = '0' stalls the stage. Assert load only together with enable, one clock after last_next = '1',
--             and only for a line that is not empty.
-- Formats     line_pkg
-- Latency     1 clock from load to the first pixel
-- Throughput  1 pixel per clock, without a bubble between spans
-- Error       none
-- Source      quadratic paper, figure 6 (X counter)
-- Golden twin none: it only counts

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.all;

entity span_stage is
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    enable    : in  std_logic;
    load      : in  std_logic; -- begin a span
    line      : in  line_t;
    last_next : out std_logic; -- in the next clock the pixel is its span's last, or there is none
    valid     : out std_logic; -- there is a pixel
    triangle  : out triangle_t;
    y         : out pixel_y_t;
    x         : out span_x_t
  );
end entity;

architecture rtl of span_stage is

  type reg_t is record
    valid     : std_logic;
    last      : std_logic; -- remaining = 0, or valid = '0'
    triangle  : triangle_t;
    y         : pixel_y_t;
    x         : span_x_t;
    remaining : pixels_t; -- pixels after this one
    backward  : std_logic;
  end record;

  signal r, r_next : reg_t;

begin

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    -- Step to the next pixel.
    if enable = '1' then
      v.x := r.x + 1;
      if r.backward = '1' then
        v.x := r.x - 1;
      end if;
      v.remaining := r.remaining - 1;
      v.last      := r.last or flag(r.remaining = 1);
      v.valid     := not r.last;
    end if;

    -- Load a span.
    if load = '1' then
      v.valid     := '1';
      v.last      := flag(line.remaining = 0);
      v.triangle  := line.triangle;
      v.y         := line.y;
      v.x         := line.start;
      v.remaining := line.remaining;
      v.backward  := line.backward;
    end if;

    if reset = '1' then
      v.valid := '0';
      v.last  := '1';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  last_next <= r_next.last;
  valid     <= r.valid;
  triangle  <= r.triangle;
  y         <= r.y;
  x         <= r.x;

end architecture;
