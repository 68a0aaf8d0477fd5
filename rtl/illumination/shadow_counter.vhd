-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Counts one light's shadow volumes in front of the surfaces of a line, with one count per column. A shadow
--             polygon that opens a volume adds one, a polygon that closes a volume subtracts one. An object reads the
--             count of its column and sets it to 0. The count plus the number of volumes around the eye shows
--             whether the light reaches the object. A negative sum counts as 0: a volume thinner than the rounding of
--             its depths may be closed before it is opened.
-- Contract    At a rising edge with step and ready, column x is counted (counts, with opens) or read for an object (object), or all
--             columns are cleared (clear); at most one of the three. Until the next step, lit is '1' if the sum of
--             around_eye and the previous count of column x is 0 or less; around_eye must be stable for that time.
--             Columns may be in any order. After reset and after clear, ready is '0' until all columns are 0: one clock
--             per column up to the last counted one, after reset one clock per column of all. A count that would
--             exceed its format does not change; fault is '1' from then on.
-- Formats     formats_pkg: x: pixel_x, around_eye: shadow_count; the same in both presets
-- Latency     1 clock from step to lit, 2 to fault
-- Throughput  1 column per clock
-- Source      processors paper, section 3.3 (a single counter: there a stage holds one pixel at a time)
-- Golden twin model/golden/shadow_counter.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;

entity shadow_counter is
  port (
    clk        : in  std_logic;
    reset      : in  std_logic;
    ready      : out std_logic;
    step       : in  std_logic;
    clear      : in  std_logic;
    counts     : in  std_logic;
    opens      : in  std_logic;
    object     : in  std_logic;
    x          : in  std_logic_vector(formats(true).pixel_x.bits - 1 downto 0);
    around_eye : in  std_logic_vector(formats(true).shadow_count.bits - 1 downto 0);
    lit        : out std_logic;
    fault      : out std_logic
  );
end entity;

architecture rtl of shadow_counter is

  subtype column_t is unsigned(x'range);
  subtype count_t is std_logic_vector(around_eye'range);

  constant c_least : count_t := '1' & (around_eye'high - 1 downto 0 => '0');
  constant c_most  : count_t := not c_least;

  type reg_t is record
    clearing  : std_logic;
    last      : column_t; -- the highest column that was counted; while clearing, the column to clear
    counts    : std_logic;
    opens     : std_logic;
    object    : std_logic;
    column    : column_t;
    forwarded : std_logic; -- the previous column was this one: its count is not yet in the memory
    forward   : count_t;
    fault     : std_logic;
  end record;

  signal r, r_next : reg_t;

  type memory_t is array (2 ** x'length - 1 downto 0) of count_t;

  signal memory_counted : memory_t;

  attribute ram_style                   : string;
  attribute ram_style of memory_counted : signal is "block";

  signal moved    : std_logic;
  signal memory_q : count_t; -- data read from the memory
  signal held     : count_t;
  signal around   : signed(count_t'length downto 0); -- volumes around the object
  signal changed  : count_t;
  signal overflow : std_logic; -- the count would exceed its format
  signal writes   : std_logic;
  signal write_at : column_t;
  signal written  : count_t;

begin

  ready <= not r.clearing;
  moved <= step and not r.clearing;

  held   <= r.forward when r.forwarded = '1' else memory_q;
  around <= resize(signed(held), around'length) + signed(around_eye);
  lit    <= '1' when around <= 0 else '0';
  fault  <= r.fault;

  change : process (all)
  begin
    overflow <= '0';
    if r.object = '1' then
      changed <= (others => '0');
    elsif r.opens = '1' then
      changed <= std_logic_vector(unsigned(held) + 1);
      if held = c_most then
        changed  <= held;
        overflow <= r.counts;
      end if;
    else
      changed <= std_logic_vector(unsigned(held) - 1);
      if held = c_least then
        changed  <= held;
        overflow <= r.counts;
      end if;
    end if;
  end process;

  -- While the column waits, it is written again with the same count.
  writes   <= r.clearing or r.counts or r.object;
  write_at <= r.last when r.clearing = '1' else r.column;
  written  <= (others => '0') when r.clearing = '1' else changed;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if overflow = '1' then
      v.fault := '1';
    end if;
    if r.clearing = '1' then
      if r.last = 0 then
        v.clearing := '0';
      else
        v.last := r.last - 1;
      end if;
    elsif step = '1' then
      v.clearing  := clear;
      v.counts    := counts;
      v.opens     := opens;
      v.object    := object;
      v.column    := unsigned(x);
      v.forwarded := '0';
      if writes = '1' and r.column = unsigned(x) then
        v.forwarded := '1';
      end if;
      v.forward := changed;
      if counts = '1' and unsigned(x) > r.last then
        v.last := unsigned(x);
      end if;
    end if;
    if reset = '1' then
      v.clearing := '1';
      v.last     := (others => '1');
      v.counts   := '0';
      v.object   := '0';
      v.fault    := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  memory : process (clk)
  begin
    if rising_edge(clk) then
      if moved = '1' then
        memory_q <= memory_counted(to_integer(unsigned(x)));
      end if;
      if writes = '1' then
        memory_counted(to_integer(write_at)) <= written;
      end if;
    end if;
  end process;

end architecture;
