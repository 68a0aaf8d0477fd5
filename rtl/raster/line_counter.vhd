-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Counts the lines of a triangle and loads the next init vector after the last one. It controls the edge
--             stage: `step` moves both edges to another line. `load`: this is the first line of an init vector.
--             `section_change`: on this line the stop edge loads its lower section.
--             A triangle has upper_lines lines and then lower_lines lines; 0 upper lines count as 2**bits.
-- Contract    init is taken where init_valid and init_ready are '1'. It must not change while it waits. It may stay
--             unchanged until its first line advances; no other vector is taken before.
--             advance = '1': the line stage takes the line, if valid = '1'.
-- Formats     formats_pkg: the header of init; y pixel_y, remaining lines
-- Latency     1 clock from init taken to its first line, 1 from advance to the next line
-- Throughput  1 line per clock; a triangle takes 2 clocks at least
-- Error       none
-- Source      quadratic paper, figure 6 (Y counter)
-- Golden twin model/golden/line_counter.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;

entity line_counter is
  generic (
    g_exact : boolean := true
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    init_valid     : in  std_logic;
    init_ready     : out std_logic;
    init           : in  std_logic_vector(init_bits(g_exact, 0) - 1 downto 0);
    advance        : in  std_logic; -- the line stage takes the line
    step           : out std_logic; -- the edges go to the next line
    load           : out std_logic; -- the next line is the first of init
    section_change : out std_logic; -- this line is the last of its section
    valid          : out std_logic; -- the edges are at a line
    first          : out std_logic; -- this line is the triangle's first
    triangle       : out triangle_t;
    y              : out pixel_y_t
  );
end entity;

architecture rtl of line_counter is

  constant c_init : init_header_t := init_header(g_exact);

  subtype lines_t is unsigned(formats(g_exact).lines.bits - 1 downto 0);

  type reg_t is record
    valid        : std_logic;
    first        : std_logic;
    load         : std_logic; -- no line, or the triangle's last
    triangle     : triangle_t;
    y            : pixel_y_t;
    remaining    : lines_t; -- lines of this section, this line included
    section_last : std_logic; -- remaining = 1
    lower_lines  : lines_t; -- lines of the section that follows
    lower_empty  : std_logic; -- no section follows
  end record;

  signal r, r_next : reg_t;

  signal upper_lines, lower_lines : lines_t; -- of init
  signal take                     : std_logic; -- take the init vector

begin

  upper_lines <= unsigned(init(c_init.upper_lines.high downto c_init.upper_lines.low));

  sections : if g_exact generate
    lower_lines <= unsigned(init(c_init.lower_lines.high downto c_init.lower_lines.low));
  else generate
    lower_lines <= (others => '0');
  end generate;

  step <= advance or not r.valid;

  -- While the first line is here, init may still be this triangle's.
  take <= init_valid and step and r.load and not r.first;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if step = '1' then
      -- Count the lines.
      v.y            := r.y + 1;
      v.remaining    := r.remaining - 1;
      v.section_last := flag(r.remaining = 2);

      -- Change to the lower section.
      if r.section_last = '1' then
        v.remaining    := r.lower_lines;
        v.section_last := flag(r.lower_lines = 1);
        v.lower_empty  := '1';
      end if;

      -- Load the next triangle.
      if r.load = '1' then
        v.triangle     := init(c_init.triangle.high downto c_init.triangle.low);
        v.y            := unsigned(init(c_init.y.high downto c_init.y.low));
        v.remaining    := upper_lines;
        v.section_last := flag(upper_lines = 1);
        v.lower_lines  := lower_lines;
        v.lower_empty  := flag(lower_lines = 0);
      end if;
      v.first := take;
      v.valid := take or not r.load;
      v.load  := (v.section_last and v.lower_empty) or not v.valid;
    end if;
    if reset = '1' then
      v.load  := '1';
      v.first := '0';
      v.valid := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  init_ready     <= take;
  load           <= r.load;
  section_change <= r.section_last;
  valid          <= r.valid;
  first          <= r.first;
  triangle       <= r.triangle;
  y              <= r.y;

end architecture;
