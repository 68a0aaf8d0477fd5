-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The board without its pins: SPI packets in, a picture on a monitor out, frame buffers and depths in an
--             external SRAM.
--
--             spi_receiver --> quadratic_shader --> depth_test ---+
--                  |                                              v
--                  +---------> frame_control (swap, clear) --> sram_arbiter <--> SRAM
--                                     |                           ^
--             video_timing ------- front buffer --> scan_out -----+--> monitor
--
-- Contract    One clock domain. All outputs except spi_data_out are to be registered once more in the cells of the
--             pins, and the inputs sram_data_in and spi_* are registers in the cells of the pins: the word of a read
--             that is output in clock n is at sram_data_in in clock n + 2. sram_read and sram_write are never both
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
    sram_address     : out std_logic_vector(c_address_bits - 1 downto 0);
    sram_data_out    : out std_logic_vector(15 downto 0);
    sram_data_enable : out std_logic; -- drive sram_data_out
    sram_read        : out std_logic;
    sram_write       : out std_logic;
    sram_data_in     : in  std_logic_vector(15 downto 0);
    -- Monitor, 640x480 at 60 Hz
    vga_hsync        : out std_logic; -- active low
    vga_vsync        : out std_logic; -- active low
    vga_red          : out std_logic_vector(2 downto 0);
    vga_green        : out std_logic_vector(2 downto 0);
    vga_blue         : out std_logic_vector(2 downto 0)
  );
end entity;

architecture rtl of board_core is

begin

end architecture;
