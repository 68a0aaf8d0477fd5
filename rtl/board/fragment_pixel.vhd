-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Makes a pixel of the frame buffer from a fragment: its place in the buffer, its depth and its colour as
--             words of the memory. Fragments outside the frame are dropped and reported.
-- Contract    Both streams are valid/ready; a pixel does not change while it waits. outside is '1' for one clock for
--             each fragment that is dropped.
-- Formats     formats_pkg: pixel_y, pixel_x, depth, colour; board_pkg: place of a pixel, below c_pixels
-- Latency     1 clock
-- Throughput  1 fragment per clock
-- Error       the depth loses its lower 8 bits, red and blue 3, green 2: truncated
-- Source      ours
-- Golden twin model/golden/board_pixel.hpp: board_place, board_depth, board_colour

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.board_pkg.all;
use work.line_pkg.flag;

entity fragment_pixel is
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    fragment_valid : in  std_logic;
    fragment_ready : out std_logic;
    fragment_y     : in  std_logic_vector(formats(true).pixel_y.bits - 1 downto 0);
    fragment_x     : in  std_logic_vector(formats(true).pixel_x.bits - 1 downto 0);
    fragment_z     : in  std_logic_vector(formats(true).depth.bits - 1 downto 0);
    fragment_red   : in  std_logic_vector(formats(true).colour.bits - 1 downto 0);
    fragment_green : in  std_logic_vector(formats(true).colour.bits - 1 downto 0);
    fragment_blue  : in  std_logic_vector(formats(true).colour.bits - 1 downto 0);
    pixel_valid    : out std_logic;
    pixel_ready    : in  std_logic;
    pixel_place    : out place_t;
    pixel_depth    : out word_t;
    pixel_colour   : out word_t;
    outside        : out std_logic
  );
end entity;

architecture rtl of fragment_pixel is

  type reg_t is record
    valid   : std_logic;
    outside : std_logic;
    place   : place_t;
    depth   : word_t;
    colour  : word_t;
  end record;

  signal r, r_next : reg_t;

  signal free, in_frame : std_logic;

begin

  free     <= pixel_ready or not r.valid;
  in_frame <= flag(unsigned(fragment_y) < c_height and unsigned(fragment_x) < c_width);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.outside := fragment_valid and free and not in_frame;
    if free = '1' then
      v.valid  := fragment_valid and in_frame;
      v.place  := pixel_place_of(unsigned(fragment_y(frame_y_t'range)), unsigned(fragment_x(frame_x_t'range)));
      v.depth  := fragment_z(fragment_z'high downto fragment_z'length - word_t'length);
      v.colour := rgb565(fragment_red, fragment_green, fragment_blue);
    end if;
    if reset = '1' then
      v.valid   := '0';
      v.outside := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  fragment_ready <= free;
  pixel_valid    <= r.valid;
  pixel_place    <= r.place;
  pixel_depth    <= r.depth;
  pixel_colour   <= r.colour;
  outside        <= r.outside;

end architecture;
