-- SPDX-License-Identifier: Apache-2.0
-- Four lines of the frame, from each colour buffer, with the golden model's colours at the pins: every dot of both
-- lines of the monitor, and the syncs, exactly two clocks after their position. Each fetch reads the 320 words of its
-- line, one per clock and no other.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.tb_pkg.all;

entity scan_out_tb is
  generic (g_folder : string := "scan_out");
end entity;

architecture sim of scan_out_tb is
  constant c_lines   : positive := 4; -- of the frame
  constant c_colours : positive := c_lines * c_width;
  constant c_latency : positive := 2; -- from column and line to the pins
  constant c_reads   : positive := 3; -- from a read to its data

  type colours_t is array (0 to c_colours - 1) of word_t;
  type dots_t is array (0 to c_colours - 1) of std_logic_vector(4 * 9 - 1 downto 0);
  type reads_t is array (1 to c_reads) of integer; -- place in colours, or -1

  signal ended              : boolean := false;
  signal clk                : std_logic := '0';
  signal reset              : std_logic := '1';
  signal front              : std_logic := '0';
  signal column, line       : unsigned(9 downto 0) := (others => '0');
  signal visible            : std_logic := '0';
  signal hsync_in, vsync_in : std_logic := '1';
  signal fetch, fetch_first : std_logic := '0';
  signal read_valid         : std_logic;
  signal read_address       : address_t;
  signal data_valid         : std_logic := '0';
  signal data               : word_t := (others => 'X');
  signal hsync, vsync       : std_logic;
  signal red, green, blue   : level_t;

  signal colours   : colours_t;
  signal reads     : reads_t := (others => -1);
  signal next_read : natural := 0; -- the place that the next read must have
begin
  dut : entity work.scan_out
    port map (
      clk          => clk,
      reset        => reset,
      front        => front,
      column       => column,
      line         => line,
      visible      => visible,
      hsync_in     => hsync_in,
      vsync_in     => vsync_in,
      fetch        => fetch,
      fetch_first  => fetch_first,
      read_valid   => read_valid,
      read_address => read_address,
      data_valid   => data_valid,
      data         => data,
      hsync        => hsync,
      vsync        => vsync,
      red          => red,
      green        => green,
      blue         => blue);

  clk <= not clk after c_half_period when not ended;

  memory : process (clk) is
    variable place : integer;
  begin
    if rising_edge(clk) then
      place := -1;
      if read_valid = '1' and reset = '0' then
        place := to_integer(read_address - colour_base(front));
        check("scan_out: read", next_read, "place", place, next_read);
        next_read <= next_read + 1;
      end if;
      if fetch_first = '1' then
        next_read <= 0;
      end if;
      reads      <= place & reads(1 to c_reads - 1);
      data_valid <= to_flag(reads(c_reads - 1) >= 0);
      data       <= (others => 'X');
      if reads(c_reads - 1) >= 0 then
        data <= colours(reads(c_reads - 1));
      end if;
    end if;
  end process;

  run : process is
    variable vectors : vectors_t;
    variable dots    : dots_t;
    variable colour  : word_t;
    variable bits    : level_t;

    -- Compare the pins with the dot at (x, y).
    procedure check_dot (x, y : natural) is
      constant c_dot  : natural := 9 * (2 * (y mod 2) + x mod 2);
      constant c_line : string  := "scan_out: line " & to_string(y) & ", dot";

      variable expected : std_logic_vector(8 downto 0);
    begin
      expected := dots(y / 2 * c_width + x / 2)(c_dot + 8 downto c_dot);
      check(c_line, x, "colour", red & green & blue, expected);
      check(c_line, x, "hsync", hsync, to_flag(x mod 7 = 3));
      check(c_line, x, "vsync", vsync, to_flag(y mod 3 = 1));
    end procedure;

    variable clocks : natural;
  begin
    vectors.open_file(g_folder & "/colours.txt");
    for i in colours'range loop
      vectors.expect_vector("a colour");
      vectors.read_word(colour);
      colours(i) <= colour;
      for dot in 0 to 3 loop
        for channel in 2 downto 0 loop
          vectors.read_word(bits);
          dots(i)(9 * dot + 3 * channel + 2 downto 9 * dot + 3 * channel) := bits;
        end loop;
      end loop;
    end loop;
    assert not vectors.next_vector report "scan_out_tb: too many colours" severity failure;
    wait until rising_edge(clk);
    reset <= '0';

    for buffer_index in std_logic range '0' to '1' loop
      front <= buffer_index;
      -- Fetch the first line.
      fetch <= '1';
      fetch_first <= '1';
      line <= to_unsigned(523, line'length);
      wait until rising_edge(clk);
      fetch <= '0';
      fetch_first <= '0';
      for i in 1 to c_width + c_reads + 2 loop
        wait until rising_edge(clk);
      end loop;
      -- Show the lines of the monitor, and fetch the next.
      for y in 0 to 2 * c_lines - 1 loop
        clocks := 0;
        for x in 0 to 639 + 10 loop
          for half in 0 to 1 loop
            column   <= to_unsigned(x, column'length);
            line     <= to_unsigned(y, line'length);
            visible  <= to_flag(x < 640);
            hsync_in <= to_flag(x mod 7 = 3);
            vsync_in <= to_flag(y mod 3 = 1);
            fetch    <= to_flag(x = 0 and half = 0 and y mod 2 = 0 and y < 2 * c_lines - 2);
            wait until rising_edge(clk);
            if clocks >= c_latency and (clocks - c_latency) / 2 < 640 then
              check_dot((clocks - c_latency) / 2, y);
            elsif clocks >= c_latency then
              assert red & green & blue = "000000000" report "scan_out_tb: a dot outside is not black" severity failure;
            end if;
            clocks := clocks + 1;
          end loop;
        end loop;
        if y mod 2 = 1 then
          check("scan_out: line", y, "number of words read", next_read, minimum(y / 2 + 2, c_lines) * c_width);
        end if;
      end loop;
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "scan_out_tb");
end architecture;
