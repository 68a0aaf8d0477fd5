-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The design for Olimex's iCE40HX8K-EVB: board_core with the clock, the reset and the cells of the SRAM's pins.
--
--             oscillator --> PLL --+--> clk -----------> board_core, registers of the SRAM's pins
--                                  +--> late_clk ------> sram_we_n, sram_oe_n: a quarter of a clock later
--
-- Contract    The names of the ports are those of board.pcf. The strobes of the SRAM lie inside the time in which
--             address and data are stable: sram_we_n is low from the first to the third quarter of a write's clock, and
--             sram_oe_n changes a quarter after the address. docs/board.md calculates the times.
-- Formats     board_core
-- Latency     1 clock more than board_core at the SRAM
-- Throughput  board_core
-- Error       none
-- Source      Lattice, iCE40 technology library (SB_PLL40_2F_CORE, SB_IO); Olimex, schematics of iCE40HX8K-EVB
-- Golden twin none

library ieee;
use ieee.std_logic_1164.all;
use work.board_pkg.all;

entity board_top is
  generic (
    g_exact    : boolean  := true;
    g_channels : positive := 3;
    g_degree   : positive := 1
  );
  port (
    oscillator   : in    std_logic; -- 100 MHz
    button_n     : in    std_logic; -- reset
    spi_select_n : in    std_logic;
    spi_clock    : in    std_logic;
    spi_data_in  : in    std_logic;
    spi_data_out : out   std_logic;
    sram_address : out   std_logic_vector(address_t'range);
    sram_data    : inout word_t;
    sram_ce_n    : out   std_logic;
    sram_oe_n    : out   std_logic;
    sram_we_n    : out   std_logic;
    vga_hsync    : out   std_logic;
    vga_vsync    : out   std_logic;
    vga_red      : out   level_t;
    vga_green    : out   level_t;
    vga_blue     : out   level_t
  );
end entity;

architecture rtl of board_top is

  component SB_PLL40_2F_CORE is
    generic (
      FEEDBACK_PATH       : string;
      PLLOUT_SELECT_PORTA : string;
      PLLOUT_SELECT_PORTB : string;
      SHIFTREG_DIV_MODE   : std_logic_vector(0 downto 0);
      DIVR                : std_logic_vector(3 downto 0);
      DIVF                : std_logic_vector(6 downto 0);
      DIVQ                : std_logic_vector(2 downto 0);
      FILTER_RANGE        : std_logic_vector(2 downto 0)
    );
    port (
      REFERENCECLK  : in  std_logic;
      PLLOUTGLOBALA : out std_logic;
      PLLOUTGLOBALB : out std_logic;
      RESETB        : in  std_logic;
      BYPASS        : in  std_logic;
      LOCK          : out std_logic
    );
  end component;

  component SB_IO is
    generic (
      PIN_TYPE : std_logic_vector(5 downto 0)
    );
    port (
      PACKAGE_PIN   : inout std_logic;
      INPUT_CLK     : in    std_logic;
      OUTPUT_CLK    : in    std_logic;
      OUTPUT_ENABLE : in    std_logic;
      D_OUT_0       : in    std_logic;
      D_OUT_1       : in    std_logic;
      D_IN_0        : out   std_logic
    );
  end component;

  -- Kinds of pins: the upper four bits select the output, the lower two the input.
  constant c_output        : std_logic_vector(5 downto 0) := "010101"; -- a register
  constant c_halves        : std_logic_vector(5 downto 0) := "010001"; -- D_OUT_0 in the clock's high half, D_OUT_1 in its low half
  constant c_bidirectional : std_logic_vector(5 downto 0) := "110100"; -- registers for input, output and its enable

  -- Clocks of reset after the PLL has locked.
  constant c_reset_clocks : positive := 16;

  signal clk, late_clk, locked : std_logic;
  signal released              : std_logic_vector(1 to c_reset_clocks) := (others => '0'); -- the configuration sets it
  signal lock_sample           : std_logic;
  signal button_up             : std_logic;
  signal reset                 : std_logic;

  signal select_n, clock, data_in          : std_logic;
  signal address                           : std_logic_vector(sram_address'range);
  signal data_read, data_write             : word_t;
  signal data_enable, read, write          : std_logic;
  signal oe_n, we_n                        : std_logic := '1'; -- half a clock later

begin

  -- 100 MHz / 2 * 1. The oscillator of the PLL runs at 16 times its output, 800 MHz.
  pll : component SB_PLL40_2F_CORE
    generic map (
      FEEDBACK_PATH       => "PHASE_AND_DELAY",
      PLLOUT_SELECT_PORTA => "SHIFTREG_0deg",
      PLLOUT_SELECT_PORTB => "SHIFTREG_90deg",
      SHIFTREG_DIV_MODE   => "0",
      DIVR                => "0001",
      DIVF                => "0000000",
      DIVQ                => "100",
      FILTER_RANGE        => "100")
    port map (
      REFERENCECLK  => oscillator,
      PLLOUTGLOBALA => clk,
      PLLOUTGLOBALB => late_clk,
      RESETB        => '1',
      BYPASS        => '0',
      LOCK          => locked);

    -- Hold reset until the PLL has been locked and the button has been up for some clocks.
  reset_clocks : process (clk)
  begin
    if rising_edge(clk) then
      released <= '1' & released(1 to c_reset_clocks - 1);
      if lock_sample = '0' or button_up = '0' then
        released <= (others => '0');
      end if;
    end if;
  end process;

  reset <= not released(c_reset_clocks);

  core : entity work.board_core
    generic map (g_exact => g_exact, g_channels => g_channels, g_degree => g_degree)
    port map (
      clk              => clk,
      reset            => reset,
      spi_select_n     => select_n,
      spi_clock        => clock,
      spi_data_in      => data_in,
      spi_data_out     => spi_data_out,
      sram_address     => address,
      sram_data_out    => data_write,
      sram_data_enable => data_enable,
      sram_read        => read,
      sram_write       => write,
      sram_data_in     => data_read,
      vga_hsync        => vga_hsync,
      vga_vsync        => vga_vsync,
      vga_red          => vga_red,
      vga_green        => vga_green,
      vga_blue         => vga_blue);

    -- Sample the host's pins, the button and the PLL's lock, which is asynchronous: the first of two registers against
    -- metastability.
  samples : process (clk)
  begin
    if rising_edge(clk) then
      select_n    <= spi_select_n;
      clock       <= spi_clock;
      data_in     <= spi_data_in;
      button_up   <= button_n;
      lock_sample <= locked;
    end if;
  end process;

  -- Delay the strobes by half a clock, so that the registers of their pins sample them in the middle, with late_clk.
  half_clock : process (clk)
  begin
    if falling_edge(clk) then
      oe_n <= not read;
      we_n <= not write;
    end if;
  end process;

  sram_ce_n <= '0';

  oe_pin : component SB_IO
    generic map (PIN_TYPE => c_output)
    port map (
      PACKAGE_PIN   => sram_oe_n,
      INPUT_CLK     => '0',
      OUTPUT_CLK    => late_clk,
      OUTPUT_ENABLE => '1',
      D_OUT_0       => oe_n,
      D_OUT_1       => '0',
      D_IN_0        => open);

  we_pin : component SB_IO
    generic map (PIN_TYPE => c_halves)
    port map (
      PACKAGE_PIN   => sram_we_n,
      INPUT_CLK     => '0',
      OUTPUT_CLK    => late_clk,
      OUTPUT_ENABLE => '1',
      D_OUT_0       => we_n,
      D_OUT_1       => '1',
      D_IN_0        => open);

  address_pins : for i in address'range generate

    pin : component SB_IO
      generic map (PIN_TYPE => c_output)
      port map (
        PACKAGE_PIN   => sram_address(i),
        INPUT_CLK     => '0',
        OUTPUT_CLK    => clk,
        OUTPUT_ENABLE => '1',
        D_OUT_0       => address(i),
        D_OUT_1       => '0',
        D_IN_0        => open);

  end generate;

  data_pins : for i in word_t'range generate

    pin : component SB_IO
      generic map (PIN_TYPE => c_bidirectional)
      port map (
        PACKAGE_PIN   => sram_data(i),
        INPUT_CLK     => clk,
        OUTPUT_CLK    => clk,
        OUTPUT_ENABLE => data_enable,
        D_OUT_0       => data_write(i),
        D_OUT_1       => '0',
        D_IN_0        => data_read(i));

  end generate;

end architecture;
