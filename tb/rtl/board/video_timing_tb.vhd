-- SPDX-License-Identifier: Apache-2.0
-- Every clock of a whole frame of the monitor and of the start of the next is compared with the position that follows
-- from the clock's number, after a reset in the middle of a line.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity video_timing_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of video_timing_tb is
  signal ended                              : boolean := false;
  signal clk                                : std_logic := '0';
  signal reset                              : std_logic := '1';
  signal column, line                       : unsigned(9 downto 0);
  signal visible, hsync, vsync, blank_start : std_logic;
  signal fetch                              : std_logic;
  signal fetch_first                        : std_logic;
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

  clk <= not clk after c_half_period when not ended;

  run : process is
    procedure check (n : natural; name : string; got : std_logic; expected : boolean) is
    begin
      check("video_timing: clock", n, name, got, to_flag(expected));
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
      check("video_timing: clock", n, "column", to_integer(column), x);
      check("video_timing: clock", n, "line", to_integer(line), y);
      check(n, "visible", visible, x < 640 and y < 480);
      check(n, "hsync", hsync, not (x >= 656 and x <= 751));
      check(n, "vsync", vsync, not (y = 490 or y = 491));
      check(n, "blank_start", blank_start, first and y = 480);
      check(n, "fetch_first", fetch_first, first and y = 523);
      check(n, "fetch", fetch, first and (y = 523 or (y mod 2 = 0 and y <= 476)));
      wait until rising_edge(clk);
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "video_timing_tb");
end architecture;
