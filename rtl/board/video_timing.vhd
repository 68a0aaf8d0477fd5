-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Counts the dots and lines of a monitor with 640x480 dots at 60 Hz, and makes its syncs.
-- Contract    Outputs are registers. Each dot takes two clocks. column and line are those of the dot where visible =
--             '1'. blank_start and fetch are '1' for one clock: blank_start at the start of vertical blank, fetch two
--             lines of the monitor before the first dots of each line of the frame.
-- Formats     column 0 to 799, line 0 to 524; visible: column < 640 and line < 480. hsync, vsync active low
-- Latency     from reset to dot (0, 0): none
-- Throughput  1 dot in 2 clocks: 25 MHz of a clock of 50 MHz; VESA's 25.175 MHz is 0.7 % faster
-- Error       none
-- Source      VESA DMT, 640x480 at 60 Hz: front porch, sync, back porch 16, 96, 48 dots and 10, 2, 33 lines
-- Golden twin none: it only counts

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.flag;

entity video_timing is
  port (
    clk         : in  std_logic;
    reset       : in  std_logic;
    column      : out unsigned(9 downto 0);
    line        : out unsigned(9 downto 0);
    visible     : out std_logic;
    hsync       : out std_logic;
    vsync       : out std_logic;
    blank_start : out std_logic;
    fetch       : out std_logic; -- two lines before a new line of the frame
    fetch_first : out std_logic  -- together with fetch: it is the frame's first line
  );
end entity;

architecture rtl of video_timing is

  constant c_columns     : positive := 640;
  constant c_hsync_start : positive := c_columns + 16;
  constant c_hsync_end   : positive := c_hsync_start + 96;
  constant c_last_column : positive := c_hsync_end + 48 - 1;
  constant c_lines       : positive := 480;
  constant c_vsync_start : positive := c_lines + 10;
  constant c_vsync_end   : positive := c_vsync_start + 2;
  constant c_last_line   : positive := c_vsync_end + 33 - 1;

  type reg_t is record
    second      : std_logic; -- the second clock of the dot
    column      : unsigned(column'range);
    line        : unsigned(line'range);
    visible     : std_logic;
    hsync       : std_logic;
    vsync       : std_logic;
    blank_start : std_logic;
    fetch       : std_logic;
    fetch_first : std_logic;
  end record;

  signal r, r_next : reg_t;

begin

  combinational : process (all)
    variable v          : reg_t;
    variable line_start : std_logic;
  begin
    v := r;

    -- Step to the next dot in every second clock.
    v.second := not r.second;
    line_start := '0';
    if r.second = '1' then
      v.column := r.column + 1;
      if r.column = c_last_column then
        v.column   := (others => '0');
        line_start := '1';
        v.line     := r.line + 1;
        if r.line = c_last_line then
          v.line := (others => '0');
        end if;
      end if;
    end if;
    if reset = '1' then
      v.second := '0';
      v.column := (others => '0');
      v.line   := (others => '0');
      line_start := '0';
    end if;

    -- Derive the outputs from the new position.
    v.visible     := flag(v.column < c_columns and v.line < c_lines);
    v.hsync       := not flag(v.column >= c_hsync_start and v.column < c_hsync_end);
    v.vsync       := not flag(v.line >= c_vsync_start and v.line < c_vsync_end);
    v.blank_start := line_start and flag(v.line = c_lines);
    -- Fetch the frame's first line two lines before the monitor's first, and its next line at every even line but the
    -- last.
    v.fetch_first := line_start and flag(v.line = c_last_line - 1);
    v.fetch       := v.fetch_first or (line_start and not v.line(0) and flag(v.line < c_lines - 2));
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  column      <= r.column;
  line        <= r.line;
  visible     <= r.visible;
  hsync       <= r.hsync;
  vsync       <= r.vsync;
  blank_start <= r.blank_start;
  fetch       <= r.fetch;
  fetch_first <= r.fetch_first;

end architecture;
