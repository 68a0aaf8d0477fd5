-- SPDX-License-Identifier: Apache-2.0
-- The whole board in GHDL: a host that sends g_folder/script.txt, an SRAM, and a log of the video pins for the monitor in
-- sim/board. Lines of g_folder/video.txt: the number of clocks, hsync, vsync, red, green, blue. The last line, after two
-- more vertical syncs: end, clocks until the host was done, packets, status bytes, errors, faults, frames.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity board_sim_tb is
  generic (
    g_exact    : boolean;
    g_channels : positive;
    g_degree   : positive;
    g_folder   : string
  );
end entity;

architecture sim of board_sim_tb is

  constant c_most_clocks : positive := 200_000_000;
  constant c_late_clocks : positive := 5 * 1600; -- until the monitor has seen the end of a vertical sync

  signal clk      : std_logic := '0';
  signal reset    : std_logic := '1';
  signal finished : boolean   := false;

  -- At the ports of the core, and one register later at the pins.
  signal core_address, pin_address                 : std_logic_vector(17 downto 0) := (others => '0');
  signal core_data, pin_data, sram_data            : std_logic_vector(15 downto 0) := (others => '0');
  signal core_enable, core_read, core_write        : std_logic;
  signal pin_enable, pin_read, pin_write           : std_logic                     := '0';
  signal host_select_n, host_clock, host_data      : std_logic;
  signal core_select_n                             : std_logic                     := '1';
  signal core_clock, core_data_in, device_data     : std_logic                     := '0';
  signal core_hsync, core_vsync                    : std_logic;
  signal pin_hsync, pin_vsync                      : std_logic                     := '1';
  signal core_red, core_green, core_blue           : std_logic_vector(2 downto 0);
  signal pin_red, pin_green, pin_blue              : std_logic_vector(2 downto 0)  := (others => '0');

  signal done                                            : boolean;
  signal packets, status_bytes, errors, faults, frames   : natural;

begin

  clk <= not clk after 10 ns when not finished;

  reset <= '0' after 95 ns;

  core : entity work.board_core
    generic map (
      g_exact    => g_exact,
      g_channels => g_channels,
      g_degree   => g_degree)
    port map (
      clk              => clk,
      reset            => reset,
      spi_select_n     => core_select_n,
      spi_clock        => core_clock,
      spi_data_in      => core_data_in,
      spi_data_out     => device_data,
      sram_address     => core_address,
      sram_data_out    => core_data,
      sram_data_enable => core_enable,
      sram_read        => core_read,
      sram_write       => core_write,
      sram_data_in     => sram_data,
      vga_hsync        => core_hsync,
      vga_vsync        => core_vsync,
      vga_red          => core_red,
      vga_green        => core_green,
      vga_blue         => core_blue);

    -- The registers in the cells of the pins.
  cells : process (clk)
  begin
    if rising_edge(clk) then
      pin_address   <= core_address;
      pin_data      <= core_data;
      pin_enable    <= core_enable and not reset;
      pin_read      <= core_read and not reset;
      pin_write     <= core_write and not reset;
      pin_hsync     <= core_hsync;
      pin_vsync     <= core_vsync;
      pin_red       <= core_red;
      pin_green     <= core_green;
      pin_blue      <= core_blue;
      core_select_n <= host_select_n;
      core_clock    <= host_clock;
      core_data_in  <= host_data;
    end if;
  end process;

  sram : entity work.board_sram
    port map (
      clk         => clk,
      address     => pin_address,
      data_in     => pin_data,
      data_enable => pin_enable,
      read        => pin_read,
      write       => pin_write,
      data_out    => sram_data);

  host : entity work.board_host
    generic map (
      g_script => g_folder & "/script.txt")
    port map (
      clk          => clk,
      select_n     => host_select_n,
      clock        => host_clock,
      data         => host_data,
      device_data  => device_data,
      done         => done,
      packets      => packets,
      status_bytes => status_bytes,
      errors       => errors,
      faults       => faults,
      frames       => frames);

  log : process
    file video             : text open write_mode is g_folder & "/video.txt";
    variable entry         : line;
    variable levels, last  : std_logic_vector(10 downto 0) := "11000000000";
    variable clocks        : natural                       := 0; -- with the last levels
    variable total         : natural                       := 0;
    variable total_of_host : natural                       := 0;
    variable syncs         : natural                       := 0; -- vertical ones after the host was done
    variable late          : natural                       := 0;

    procedure put (number : natural) is
    begin
      write(entry, string'(" "));
      write(entry, number);
    end procedure;

    procedure put_levels is
    begin
      write(entry, clocks);
      put(to_integer(unsigned(last(10 downto 10))));
      put(to_integer(unsigned(last(9 downto 9))));
      put(to_integer(unsigned(last(8 downto 6))));
      put(to_integer(unsigned(last(5 downto 3))));
      put(to_integer(unsigned(last(2 downto 0))));
      writeline(video, entry);
    end procedure;

  begin
    wait until reset = '0';
    while late < c_late_clocks loop
      wait until rising_edge(clk);
      levels := pin_hsync & pin_vsync & pin_red & pin_green & pin_blue;
      assert not is_x(levels) report "board: a video pin is not 0 or 1" severity failure;
      -- Count the syncs after the host is done.
      total := total + 1;
      assert total < c_most_clocks report "board: hang" severity failure;
      if done and total_of_host = 0 then
        total_of_host := total;
      end if;
      if done and last(9) = '1' and levels(9) = '0' then
        syncs := syncs + 1;
      end if;
      if syncs >= 2 then
        late := late + 1;
      end if;
      -- Write a line for each change.
      if levels /= last then
        put_levels;
        last   := levels;
        clocks := 0;
      end if;
      clocks := clocks + 1;
    end loop;
    put_levels;
    write(entry, string'("end"));
    put(total_of_host);
    put(packets);
    put(status_bytes);
    put(errors);
    put(faults);
    put(frames);
    writeline(video, entry);
    finished <= true;
    wait;
  end process;

end architecture;
