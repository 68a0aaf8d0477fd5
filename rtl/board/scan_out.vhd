-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Shows the front buffer: fetches each line of the frame from the SRAM into a line buffer, and shows it as
--             two lines of the monitor, each pixel as 2x2 dots.
--
--             fetch --> address counter --> read_address ... data --> line buffer (2 lines) --> dither --> pins
--
-- Contract    Each clock with read_valid = '1' is a read; the arbiter takes it in the same clock. Words come back in
--             order with data_valid = '1'. One line is fetched in one burst, while the line before it is shown. The
--             fetch of a line must end within the two lines of the monitor, 3200 clocks.
-- Formats     board_pkg: RGB565 in memory, three bits per colour at the pins
-- Latency     2 clocks from column and line to the pins
-- Throughput  320 reads per 3200 clocks: 10 % of the SRAM
-- Error       board_pkg.dithered: the mean of a pixel's four dots is its colour of 5 bits, but for the four brightest
--             of the 32 levels, which are equal
-- Source      ours
-- Golden twin model/golden/board_pixel.hpp: board_pins

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;

entity scan_out is
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    front        : in  std_logic; -- the colour buffer to show; read with fetch_first
    -- From video_timing.
    column       : in  unsigned(9 downto 0);
    line         : in  unsigned(9 downto 0);
    visible      : in  std_logic;
    hsync_in     : in  std_logic;
    vsync_in     : in  std_logic;
    fetch        : in  std_logic;
    fetch_first  : in  std_logic;
    -- The SRAM.
    read_valid   : out std_logic;
    read_address : out address_t;
    data_valid   : in  std_logic;
    data         : in  word_t;
    -- The monitor.
    hsync        : out std_logic;
    vsync        : out std_logic;
    red          : out level_t;
    green        : out level_t;
    blue         : out level_t
  );
end entity;

architecture rtl of scan_out is

  -- What belongs to a dot besides its colour.
  type dot_t is record
    visible : std_logic;
    hsync   : std_logic;
    vsync   : std_logic;
    y       : std_logic; -- of the dots of a pixel
    x       : std_logic;
  end record;

  type reg_t is record
    reading   : std_logic; -- a line is being fetched
    remaining : frame_x_t; -- reads after this one
    address   : address_t;
    load_bank : std_logic; -- the half of the line buffer that the line is written to
    load      : frame_x_t; -- the next word's place in it
    dot       : dot_t; -- one clock ago: the line buffer gives its word
    hsync     : std_logic;
    vsync     : std_logic;
    red       : level_t;
    green     : level_t;
    blue      : level_t;
  end record;

  signal r, r_next : reg_t;

  signal word : word_t;

  -- Two lines.
  type memory_t is array (0 to 2 ** (frame_x_t'length + 1) - 1) of word_t;

  signal memory : memory_t;

  attribute ram_style           : string;
  attribute ram_style of memory : signal is "block";

begin

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    -- Read a line, one word per clock. The lines of a buffer follow each other without a gap.
    if r.reading = '1' then
      v.address   := r.address + 1;
      v.remaining := r.remaining - 1;
      if r.remaining = 0 then
        v.reading := '0';
      end if;
    end if;
    if fetch = '1' then
      v.reading   := '1';
      v.remaining := to_unsigned(c_width - 1, frame_x_t'length);
      v.load      := (others => '0');
      v.load_bank := not line(1);
      if fetch_first = '1' then
        v.address := colour_base(front);
      end if;
    elsif data_valid = '1' then
      v.load := r.load + 1;
    end if;

    -- Show the word of the line buffer.
    v.dot   := (visible, hsync_in, vsync_in, line(0), column(0));
    v.hsync := r.dot.hsync;
    v.vsync := r.dot.vsync;
    v.red   := dithered(word(15 downto 11), r.dot.y, r.dot.x);
    v.green := dithered(word(10 downto 6), r.dot.y, r.dot.x);
    v.blue  := dithered(word(4 downto 0), r.dot.y, r.dot.x);
    if r.dot.visible = '0' then
      v.red   := (others => '0');
      v.green := (others => '0');
      v.blue  := (others => '0');
    end if;

    if reset = '1' then
      v.reading     := '0';
      v.address     := (others => '0');
      v.dot.visible := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  line_buffer : process (clk)
  begin
    if rising_edge(clk) then
      word <= memory(to_integer(line(1) & column(9 downto 1)));
      if data_valid = '1' then
        memory(to_integer(r.load_bank & r.load)) <= data;
      end if;
    end if;
  end process;

  read_valid   <= r.reading;
  read_address <= r.address;
  hsync        <= r.hsync;
  vsync        <= r.vsync;
  red          <= r.red;
  green        <= r.green;
  blue         <= r.blue;

end architecture;
