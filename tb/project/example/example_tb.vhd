-- SPDX-License-Identifier: Apache-2.0
-- Draws the frame of docs/rtl/example.vhd and compares it with a frame from the golden model: one line per pixel with
-- its colour, in the order of addresses.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity example_tb is
  generic (
    g_frame : string
  );
end entity;

architecture sim of example_tb is

  constant c_pixels : positive := 192;

  signal clk          : std_logic            := '0';
  signal reset        : std_logic            := '1';
  signal start        : std_logic            := '0';
  signal done         : std_logic;
  signal read_address : unsigned(7 downto 0) := (others => '0');
  signal read_colour  : std_logic_vector(7 downto 0);
  signal finished     : boolean              := false;

begin

  clk <= not clk after 5 ns when not finished;

  dut : entity work.example
    port map (
      clk          => clk,
      reset        => reset,
      start        => start,
      done         => done,
      read_address => read_address,
      read_colour  => read_colour
      );

  check : process
    file frame        : text open read_mode is g_frame;
    variable expected : line;
    variable colour   : natural;
  begin
    wait until falling_edge(clk);
    reset <= '0';
    start <= '1';
    wait until falling_edge(clk);
    start <= '0';
    -- Wait until the last fragment is written.
    for clock in 1 to 1000 loop
      wait until falling_edge(clk);
      exit when done = '1';
    end loop;
    assert done = '1' report "example: not done after 1000 clocks" severity failure;
    -- Compare each pixel.
    for address in 0 to c_pixels - 1 loop
      read_address <= to_unsigned(address, 8);
      wait until falling_edge(clk);
      readline(frame, expected);
      read(expected, colour);
      assert to_integer(unsigned(read_colour)) = colour
        report "example: pixel " & integer'image(address) & ": got " & integer'image(to_integer(unsigned(read_colour)))
        & ", expected " & integer'image(colour)
        severity failure;
    end loop;
    report "example_tb: passed";
    finished <= true;
    wait;
  end process;

end architecture;
