-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Holds one line until the span stage can draw it. An empty line does not wait for the span stage.
-- Contract    enable = '0' stalls the stage. The line leaves only in a clock with line_ready = '1': all inputs of the line
--             that do not come from the walker have arrived. advance = '1': the stage loads in_line; it becomes empty if
--             in_valid = '0'.
-- Formats     line_pkg
-- Latency     1 clock
-- Throughput  1 line per clock
-- Error       none: lines leave as they came
-- Source      ours
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use work.line_pkg.all;

entity line_stage is
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    enable         : in  std_logic;
    in_valid       : in  std_logic; -- in_line is a line
    in_line        : in  line_t;
    line_ready     : in  std_logic; -- the line may leave
    span_last_next : in  std_logic; -- in the next clock the span stage draws a span's last pixel, or nothing
    advance        : out std_logic; -- take in_line
    step           : out std_logic; -- the line leaves
    span_load      : out std_logic; -- the line leaves and goes to the span stage
    valid          : out std_logic; -- the stage holds a line
    line           : out line_t
  );
end entity;

architecture rtl of line_stage is

  type reg_t is record
    valid : std_logic;
    line  : line_t; -- empty where valid = '0'
    waits : std_logic; -- for a span to end
  end record;

  signal r, r_next : reg_t;

begin

  advance <= enable and not r.waits and (line_ready or not r.valid);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    -- Take a line.
    if advance = '1' then
      v.valid      := in_valid;
      v.line       := in_line;
      v.line.empty := in_line.empty or not in_valid;
    end if;
    if reset = '1' then
      v.valid      := '0';
      v.line.empty := '1';
    end if;

    -- Wait in the next clock if the line has pixels and the span does not end then.
    v.waits := not (v.line.empty or span_last_next);
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  step      <= advance and r.valid;
  span_load <= advance and not r.line.empty;
  valid     <= r.valid;
  line      <= r.line;

end architecture;
