-- SPDX-License-Identifier: Apache-2.0
-- The cells of the pins, with models of the PLL, the cells and the SRAM that check their times: the writes of the clear
-- after reset, and the reads of scan-out between them, reach the SRAM and the monitor. A status byte comes back over
-- SPI.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.sram_model_pkg.all;
use work.tb_pkg.all;

entity board_top_tb is
  generic (g_folder : string := "board_top");
end entity;

architecture sim of board_top_tb is
  constant c_period : time := 80 ns; -- of the SPI clock

  signal ended                           : boolean := false;
  signal oscillator                      : std_logic := '0';
  signal button_n, spi_select_n          : std_logic := '1';
  signal spi_clock, spi_data_in          : std_logic := '0';
  signal spi_data_out                    : std_logic;
  signal sram_address                    : std_logic_vector(17 downto 0);
  signal sram_data                       : word_t;
  signal sram_ce_n, sram_oe_n, sram_we_n : std_logic;
  signal vga_hsync, vga_vsync            : std_logic;
  signal vga_red, vga_green, vga_blue    : level_t;
begin
  dut : entity work.board_top
    port map (
      oscillator   => oscillator,
      button_n     => button_n,
      spi_select_n => spi_select_n,
      spi_clock    => spi_clock,
      spi_data_in  => spi_data_in,
      spi_data_out => spi_data_out,
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

  memory : entity work.sram_model
    port map (
      address => sram_address,
      data    => sram_data,
      ce_n    => sram_ce_n,
      oe_n    => sram_oe_n,
      we_n    => sram_we_n);

  oscillator <= not oscillator after 5 ns when not ended;

  -- The host reads the status while the buffers are cleared after reset.
  host : process is
    variable status : std_logic_vector(7 downto 0);
  begin
    wait for 100 us;
    spi_select_n <= '0';
    wait for 120 ns;
    for i in 1 to 8 loop
      wait for c_period / 2;
      spi_clock <= '1';
      status := status(6 downto 0) & spi_data_out;
      wait for c_period / 2;
      spi_clock <= '0';
    end loop;
    wait for 40 ns;
    spi_select_n <= '1';
    assert status = x"40" report "board_top_tb: status " & to_string(status) & ", expected 01000000" severity failure;
    wait;
  end process;

  -- Lines 20 to 23 of the frame get the golden model's colours after they have been cleared, and are compared at the
  -- pins of the monitor.
  run : process is
    constant c_dot        : time     := 40 ns;
    constant c_first_line : positive := 20;
    constant c_lines      : positive := 4;

    type dots_t is array (0 to c_lines * c_width - 1) of std_logic_vector(4 * 9 - 1 downto 0);

    variable vectors  : vectors_t;
    variable colour   : word_t;
    variable bits     : level_t;
    variable dots     : dots_t;
    variable corner   : natural;
    variable expected : std_logic_vector(8 downto 0);
  begin
    -- Monitor line 30 starts after the 30th sync.
    for line in 1 to 30 loop
      wait until falling_edge(vga_hsync);
    end loop;
    for i in 0 to (c_first_line + c_lines) * c_width - 1 loop
      assert sram.get(i) = x"0000" report "board_top_tb: address " & to_string(i) & " is not cleared" severity failure;
    end loop;
    vectors.open_file(g_folder & "/colours.txt");
    for i in dots'range loop
      vectors.expect_vector("a colour");
      vectors.read_word(colour);
      -- Until the first vertical blank the picture is two lines too low: these are fetched before the first line.
      sram.set((c_first_line - 2) * c_width + i, colour);
      for dot in 0 to 3 loop
        for channel in 2 downto 0 loop
          vectors.read_word(bits);
          dots(i)(9 * dot + 3 * channel + 2 downto 9 * dot + 3 * channel) := bits;
        end loop;
      end loop;
    end loop;
    for line in 31 to 2 * c_first_line loop
      wait until falling_edge(vga_hsync);
    end loop;
    for y in 0 to 2 * c_lines - 1 loop
      -- Sync and back porch, then the middle of the first dot.
      wait for (96 + 48) * c_dot + c_dot / 2;
      for x in 0 to 2 * c_width - 1 loop
        corner   := 9 * (2 * (y mod 2) + x mod 2);
        expected := dots(y / 2 * c_width + x / 2)(corner + 8 downto corner);
        assert vga_red & vga_green & vga_blue = expected
          report "board_top_tb: dot " & to_string(x) & " of line " & to_string(y) & " is "
          & to_string(vga_red & vga_green & vga_blue) & ", expected " & to_string(expected) severity failure;
        wait for c_dot;
      end loop;
      assert vga_red & vga_green & vga_blue = "000000000" and vga_vsync = '1'
        report "board_top_tb: not black after the last dot" severity failure;
      wait until falling_edge(vga_hsync);
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "board_top_tb");
end architecture;
