-- SPDX-License-Identifier: Apache-2.0
-- Every clock of a whole frame of the monitor and of the start of the next is compared with the position that follows
-- from the clock's number, after a reset in the middle of a line.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity video_timing_tb is
  generic (
    g_folder : string := "video_timing"
  );
end entity;

architecture sim of video_timing_tb is
  signal finished    : boolean   := false;
  signal clk         : std_logic := '0';
  signal reset       : std_logic := '1';
  signal column      : unsigned(9 downto 0);
  signal line        : unsigned(9 downto 0);
  signal visible     : std_logic;
  signal hsync       : std_logic;
  signal vsync       : std_logic;
  signal blank_start : std_logic;
  signal fetch       : std_logic;
  signal fetch_first : std_logic;
begin
  dut : entity work.video_timing
    port map (
      clk         => clk,
      reset       => reset,
      column      => column,
      line        => line,
      visible     => visible,
      hsync       => hsync,
      vsync       => vsync,
      blank_start => blank_start,
      fetch       => fetch,
      fetch_first => fetch_first);

  clk <= not clk after c_half_period when not finished;

  run : process is
    procedure check (n : natural; name : string; got : std_logic; expected : boolean) is
    begin
      assert got = to_flag(expected)
        report "video_timing_tb: clock " & to_string(n) & ": " & name & " is " & to_string(got) & ", expected "
        & to_string(to_flag(expected))
        severity failure;
    end procedure;

    constant c_clocks : positive := 2 * 800 * 525;

    variable x, y  : natural;
    variable first : boolean; -- the first clock of a line, but not the one after reset
  begin
    for i in 1 to 12345 loop
      wait until rising_edge(clk);
      reset <= '0';
    end loop;
    reset <= '1';
    wait until rising_edge(clk);
    reset <= '0';
    wait until rising_edge(clk);
    for n in 0 to c_clocks + 5000 loop
      x := n / 2 mod 800;
      y := n / 1600 mod 525;
      first := n mod 1600 = 0 and n /= 0;
      assert column = x and line = y
        report "video_timing_tb: clock " & to_string(n) & ": at " & to_string(to_integer(column)) & ", "
        & to_string(to_integer(line)) & ", expected " & to_string(x) & ", " & to_string(y)
        severity failure;
      check(n, "visible", visible, x < 640 and y < 480);
      check(n, "hsync", hsync, not (x >= 656 and x <= 751));
      check(n, "vsync", vsync, not (y = 490 or y = 491));
      check(n, "blank_start", blank_start, first and y = 480);
      check(n, "fetch_first", fetch_first, first and y = 523);
      check(n, "fetch", fetch, first and (y = 523 or (y mod 2 = 0 and y <= 476)));
      wait until rising_edge(clk);
    end loop;
    report "video_timing_tb: passed" severity note;
    finished <= true;
    wait;
  end process;
end architecture;
