-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The board without its pins: SPI packets in, a picture on a monitor out, frame buffers and depths in an
--             external SRAM.
--
--             spi_receiver --> shader --> fragment_pixel --> depth_test --+
--                  |                                                      v
--                  +--------------> frame_control (swap, clear) --> sram_arbiter <--> SRAM
--                                             |                           ^
--                     video_timing ------> scan_out ----------------------+
--                                             |
--                                             v
--                                          monitor
--
-- Contract    One clock domain. The outputs sram_* are registered once more in the cells of the pins, and so is the input
--             sram_data_in: the word of a read that is output in clock n is at sram_data_in in clock n + 2. The inputs
--             spi_* are the pins sampled with clk. sram_read and sram_write are never both
--             '1'; sram_data_enable is '1' exactly when sram_write is. At least one clock with neither lies between a
--             read and a write that follows it. Packets, status byte and limits: docs/board.md
-- Formats     board_pkg: colours RGB565, depths of 16 bits; formats_pkg: init vector
-- Latency     see the entities
-- Throughput  1 access of the SRAM per clock, of which scan-out takes 10 %; 3 accesses per fragment that is drawn
-- Error       colours of 5 bits on 2x2 dots of 3 bits (board_pkg.dithered); depths lose their lower 8 bits
-- Source      ours; the shader: quadratic paper, section 5 and figure 6
-- Golden twin model/golden/board_pixel.hpp, for colours and depths

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.formats_pkg.all;
use work.quadratic_pkg.all;

entity board_core is
  generic (
    g_exact    : boolean  := true;
    g_channels : positive := 3;
    g_degree   : positive := 1
  );
  port (
    clk              : in  std_logic; -- 50 MHz: two clocks per dot of the monitor
    reset            : in  std_logic;
    -- SPI, mode 0; this side is the device.
    spi_select_n     : in  std_logic;
    spi_clock        : in  std_logic;
    spi_data_in      : in  std_logic; -- from the host
    spi_data_out     : out std_logic; -- to the host
    -- SRAM, 256K words
    sram_address     : out std_logic_vector(address_t'range);
    sram_data_out    : out word_t;
    sram_data_enable : out std_logic; -- drive sram_data_out
    sram_read        : out std_logic;
    sram_write       : out std_logic;
    sram_data_in     : in  word_t;
    -- Monitor, 640x480 at 60 Hz
    vga_hsync        : out std_logic; -- active low
    vga_vsync        : out std_logic; -- active low
    vga_red          : out level_t;
    vga_green        : out level_t;
    vga_blue         : out level_t
  );
end entity;

architecture rtl of board_core is

  constant c_formats : formats_t := formats(g_exact);

  signal init_valid, init_ready             : std_logic;
  signal init_data                          : std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0);
  signal frame_end, ending                  : std_logic;
  signal background                         : word_t;
  signal shown                              : unsigned(3 downto 0);
  signal drawing, draw_fault, outside       : std_logic;
  signal fault, drained                     : std_logic;

  signal fragment_valid, fragment_ready     : std_logic;
  signal fragment_y                         : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal fragment_x                         : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
  signal fragment_z                         : std_logic_vector(c_formats.depth.bits - 1 downto 0);
  signal fragment_red                       : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment_green                     : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment_blue                      : std_logic_vector(c_formats.colour.bits - 1 downto 0);

  signal pixel_valid, pixel_ready           : std_logic;
  signal pixel_place                        : place_t;
  signal pixel_depth, pixel_colour          : word_t;
  signal writing                            : std_logic;

  signal front, back                        : std_logic;
  signal column, line                       : unsigned(9 downto 0);
  signal visible, hsync, vsync              : std_logic;
  signal blank_start, fetch, fetch_first    : std_logic;

  signal scan_valid, scan_data_valid        : std_logic;
  signal scan_address                       : address_t;
  signal depth_valid, depth_ready           : std_logic;
  signal depth_write, depth_data_valid      : std_logic;
  signal depth_address                      : address_t;
  signal depth_data                         : word_t;
  signal clear_valid, clear_ready           : std_logic;
  signal clear_address                      : address_t;
  signal clear_data                         : word_t;
  signal address                            : address_t;
  signal write                              : std_logic;

begin

  receiver : entity work.spi_receiver
    generic map (g_init_bits => init_data'length)
    port map (
      clk        => clk,
      reset      => reset,
      select_n   => spi_select_n,
      clock      => spi_clock,
      data_in    => spi_data_in,
      data_out   => spi_data_out,
      init_valid => init_valid,
      init_ready => init_ready,
      init_data  => init_data,
      frame_end  => frame_end,
      background => background,
      ending     => ending,
      fault      => fault,
      shown      => shown);

  shader : entity work.quadratic_shader
    generic map (g_exact => g_exact, g_channels => g_channels, g_degree => g_degree)
    port map (
      clk               => clk,
      reset             => reset,
      init_valid        => init_valid,
      init_ready        => init_ready,
      init_data         => init_data,
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => open,
      fragment_y        => fragment_y,
      fragment_x        => fragment_x,
      fragment_z        => fragment_z,
      fragment_red      => fragment_red,
      fragment_green    => fragment_green,
      fragment_blue     => fragment_blue,
      busy              => drawing,
      fault             => draw_fault);

  to_pixel : entity work.fragment_pixel
    port map (
      clk            => clk,
      reset          => reset,
      fragment_valid => fragment_valid,
      fragment_ready => fragment_ready,
      fragment_y     => fragment_y,
      fragment_x     => fragment_x,
      fragment_z     => fragment_z,
      fragment_red   => fragment_red,
      fragment_green => fragment_green,
      fragment_blue  => fragment_blue,
      pixel_valid    => pixel_valid,
      pixel_ready    => pixel_ready,
      pixel_place    => pixel_place,
      pixel_depth    => pixel_depth,
      pixel_colour   => pixel_colour,
      outside        => outside);

  fault <= outside or draw_fault;

  writer : entity work.depth_test
    port map (
      clk          => clk,
      reset        => reset,
      back         => back,
      pixel_valid  => pixel_valid,
      pixel_ready  => pixel_ready,
      pixel_place  => pixel_place,
      pixel_depth  => pixel_depth,
      pixel_colour => pixel_colour,
      access_valid => depth_valid,
      access_ready => depth_ready,
      access_write => depth_write,
      access_addr  => depth_address,
      access_data  => depth_data,
      data_valid   => depth_data_valid,
      data         => sram_data_in,
      busy         => writing);

  back    <= not front;
  drained <= not (init_valid or drawing or pixel_valid or writing);

  control : entity work.frame_control
    port map (
      clk           => clk,
      reset         => reset,
      frame_end     => frame_end,
      background    => background,
      drained       => drained,
      blank_start   => blank_start,
      ending        => ending,
      front         => front,
      shown         => shown,
      write_valid   => clear_valid,
      write_ready   => clear_ready,
      write_address => clear_address,
      write_data    => clear_data);

  timing : entity work.video_timing
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

  picture : entity work.scan_out
    port map (
      clk          => clk,
      reset        => reset,
      front        => front,
      column       => column,
      line         => line,
      visible      => visible,
      hsync_in     => hsync,
      vsync_in     => vsync,
      fetch        => fetch,
      fetch_first  => fetch_first,
      read_valid   => scan_valid,
      read_address => scan_address,
      data_valid   => scan_data_valid,
      data         => sram_data_in,
      hsync        => vga_hsync,
      vsync        => vga_vsync,
      red          => vga_red,
      green        => vga_green,
      blue         => vga_blue);

  arbiter : entity work.sram_arbiter
    port map (
      clk              => clk,
      reset            => reset,
      scan_valid       => scan_valid,
      scan_address     => scan_address,
      scan_data_valid  => scan_data_valid,
      depth_valid      => depth_valid,
      depth_ready      => depth_ready,
      depth_write      => depth_write,
      depth_address    => depth_address,
      depth_data       => depth_data,
      depth_data_valid => depth_data_valid,
      clear_valid      => clear_valid,
      clear_ready      => clear_ready,
      clear_address    => clear_address,
      clear_data       => clear_data,
      sram_address     => address,
      sram_data_out    => sram_data_out,
      sram_read        => sram_read,
      sram_write       => write);

  sram_address     <= std_logic_vector(address);
  sram_write       <= write;
  sram_data_enable <= write;

end architecture;
