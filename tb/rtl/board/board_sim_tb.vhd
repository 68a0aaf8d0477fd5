-- SPDX-License-Identifier: Apache-2.0
-- The whole board, with its pins, in GHDL: a host that sends g_folder/script.txt, an SRAM, and a log of the video pins for the monitor in
-- sim/extras/board. Lines of g_folder/video.txt: the number of clocks, hsync, vsync, red, green, blue. The last line, after two
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

  signal oscillator, host_clk : std_logic := '0';

  -- At the pins.
  signal select_n, spi_clock, data_in, data_out    : std_logic;
  signal sram_address                              : std_logic_vector(17 downto 0);
  signal sram_data                                 : std_logic_vector(15 downto 0);
  signal sram_ce_n, sram_oe_n, sram_we_n           : std_logic;
  signal vga_hsync, vga_vsync                      : std_logic;
  signal vga_red, vga_green, vga_blue              : std_logic_vector(2 downto 0);

  signal done                                          : boolean;
  signal packets, status_bytes, errors, faults, frames : natural;

begin

  oscillator <= not oscillator after 5 ns;

  -- Host and monitor have clocks of their own, with the frequency of the board's.
  host_clk <= not host_clk after 10 ns;

  board : entity work.board_top
    generic map (
      g_exact    => g_exact,
      g_channels => g_channels,
      g_degree   => g_degree)
    port map (
      oscillator   => oscillator,
      button_n     => '1',
      spi_select_n => select_n,
      spi_clock    => spi_clock,
      spi_data_in  => data_in,
      spi_data_out => data_out,
      sram_address => sram_address,
      sram_data    => sram_data,
      sram_ce_n    => sram_ce_n,
      sram_oe_n    => sram_oe_n,
      sram_we_n    => sram_we_n,
      vga_hsync    => vga_hsync,
      vga_vsync    => vga_vsync,
      vga_red      => vga_red,
      vga_green    => vga_green,
      vga_blue     => vga_blue);

  sram : entity work.sram_model
    port map (
      address => sram_address,
      data    => sram_data,
      ce_n    => sram_ce_n,
      oe_n    => sram_oe_n,
      we_n    => sram_we_n);

  host : entity work.board_host
    generic map (
      g_script => g_folder & "/script.txt")
    port map (
      clk          => host_clk,
      select_n     => select_n,
      clock        => spi_clock,
      data         => data_in,
      device_data  => data_out,
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
    variable seen_vsync    : boolean                       := false;
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
    -- Start where the syncs have levels, after the reset.
    wait until rising_edge(host_clk) and vga_hsync = '1' and vga_vsync = '1';
    while late < c_late_clocks loop
      wait until rising_edge(host_clk);
      levels := vga_hsync & vga_vsync & vga_red & vga_green & vga_blue;
      -- The line buffer is not filled before the first vertical sync.
      if is_x(levels) then
        assert not is_x(levels(10 downto 9)) and not seen_vsync
          report "board: a video pin is not 0 or 1"
          severity failure;
        levels(8 downto 0) := (others => '0');
      end if;
      seen_vsync := seen_vsync or levels(9) = '0';
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
    std.env.finish;
  end process;

end architecture;
