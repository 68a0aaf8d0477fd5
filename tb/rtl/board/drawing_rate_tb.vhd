-- SPDX-License-Identifier: Apache-2.0
-- Large triangles, each of their pixels nearer than the stored depth, from the shader to the SRAM while scan-out reads
-- its lines: on average at most 3.7 clocks per fragment, 13.5 million fragments per second at 50 MHz.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.quadratic_pkg.all;
use work.tb_pkg.all;

entity drawing_rate_tb is
  generic (g_folder : string := "drawing_rate");
end entity;

architecture sim of drawing_rate_tb is
  constant c_most : real := 3.7; -- clocks per fragment

  signal ended                             : boolean := false;
  signal clk                               : std_logic := '0';
  signal reset                             : std_logic := '1';
  signal init_valid                        : std_logic := '0';
  signal init_ready                        : std_logic;
  signal init_data                         : std_logic_vector(init_bits(true, 1, 3) - 1 downto 0) := (others => '0');
  signal shader_busy, fragment_valid       : std_logic;
  signal fragment_ready                    : std_logic;
  signal fragment_y, fragment_x            : std_logic_vector(11 downto 0);
  signal fragment_z                        : std_logic_vector(23 downto 0);
  signal fragment_red, fragment_green      : std_logic_vector(7 downto 0);
  signal fragment_blue                     : std_logic_vector(7 downto 0);
  signal pixel_valid, pixel_ready          : std_logic;
  signal pixel_place                       : place_t;
  signal pixel_depth, pixel_colour         : word_t;
  signal outside, depth_valid, depth_ready : std_logic;
  signal depth_write                       : std_logic;
  signal depth_address                     : address_t;
  signal depth_data                        : word_t;
  signal depth_data_valid, scan_valid      : std_logic;
  signal writing                           : std_logic;

  signal clocks      : natural := 0;
  signal first, last : natural := 0; -- clocks of the first and the last fragment
  signal fragments   : natural := 0;
begin
  shader : entity work.quadratic_shader
    generic map (g_exact => true, g_channels => 3, g_degree => 1)
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
      busy              => shader_busy,
      fault             => open);

  to_pixel : entity work.fragment_pixel
    port map (
      clk            => clk,
      reset          => reset,
      fragment_valid => fragment_valid,
      fragment_ready => fragment_ready,
      fragment_y     => fragment_y,
      fragment_x     => fragment_x,
      -- No depth of the far plane: every fragment is drawn.
      fragment_z     => '0' & fragment_z(22 downto 0),
      fragment_red   => fragment_red,
      fragment_green => fragment_green,
      fragment_blue  => fragment_blue,
      pixel_valid    => pixel_valid,
      pixel_ready    => pixel_ready,
      pixel_place    => pixel_place,
      pixel_depth    => pixel_depth,
      pixel_colour   => pixel_colour,
      outside        => outside);

  writer : entity work.depth_test
    port map (
      clk          => clk,
      reset        => reset,
      back         => '0',
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
      data         => c_farthest,
      busy         => writing);

  arbiter : entity work.sram_arbiter
    port map (
      clk              => clk,
      reset            => reset,
      scan_valid       => scan_valid,
      scan_address     => (others => '0'),
      scan_data_valid  => open,
      depth_valid      => depth_valid,
      depth_ready      => depth_ready,
      depth_write      => depth_write,
      depth_address    => depth_address,
      depth_data       => depth_data,
      depth_data_valid => depth_data_valid,
      clear_valid      => '0',
      clear_ready      => open,
      clear_address    => (others => '0'),
      clear_data       => (others => '0'),
      sram_address     => open,
      sram_data_out    => open,
      sram_read        => open,
      sram_write       => open);

  clk        <= not clk after c_half_period when not ended;
  scan_valid <= to_flag(clocks mod 3200 < 320);

  count : process (clk) is
  begin
    if rising_edge(clk) then
      clocks <= clocks + 1;
      if pixel_valid = '1' and pixel_ready = '1' then
        fragments <= fragments + 1;
        last      <= clocks;
        if fragments = 0 then
          first <= clocks;
        end if;
      end if;
      assert outside /= '1' report "drawing_rate_tb: a fragment is outside" severity failure;
    end if;
  end process;

  run : process is
    variable vectors : vectors_t;
  begin
    wait_clocks(clk, 4);
    reset <= '0';
    vectors.open_file(g_folder & "/init.txt");
    while vectors.next_vector loop
      vectors.drive(init_data);
      init_valid <= '1';
      wait until rising_edge(clk) and init_ready = '1';
      init_valid <= '0';
    end loop;
    loop
      wait until rising_edge(clk);
      exit when shader_busy = '0' and pixel_valid = '0' and writing = '0';
    end loop;
    assert fragments >= 9000 and real(last - first) <= c_most * real(fragments)
      report "drawing_rate_tb: " & to_string(fragments) & " fragments in " & to_string(last - first) & " clocks"
      severity failure;
    report "drawing_rate: " & to_string(fragments) & " fragments in " & to_string(last - first) & " clocks"
      severity note;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "drawing_rate_tb");
end architecture;
