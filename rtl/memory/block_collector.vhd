-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Collects consecutive fragments of one block. Their words go to the pixel memories, at the block's slot; a
--             mask has a bit per pixel. A fragment of another block, a second fragment of the same pixel, or the frame's
--             end closes the block.
-- Contract    start: take the fragments of a frame, up to the transfer with tlast. ended = '1' for one clock: all of them
--             are in closed blocks or dropped. Fragments outside the frame or the scissor, and transfers with tkeep = 0,
--             are dropped. s_axis_tready depends on registers only, of this entity and that of room.
--             A block is opened only while room = '1': open_block = '1', and slot is its slot. block_valid = '1': a block is
--             closed; it must be taken in this clock. fault = '1' for one clock: tuser is not 0 in the last transfer.
-- Formats     memory_pkg
-- Latency     3 clocks from a fragment to pixel_write
-- Throughput  1 fragment per clock
-- Error       none
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp: which fragments are dropped, and words of memory

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity block_collector is
  generic (
    g_true_colour : boolean;
    g_block_bits  : positive;
    g_lane_bits   : natural;
    g_slot_bits   : positive
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    frame         : in  frame_t;
    start         : in  std_logic;
    ended         : out std_logic;
    fault         : out std_logic;
    s_axis_tvalid : in  std_logic;
    s_axis_tready : out std_logic;
    s_axis_tdata  : in  fragment_data_t;
    s_axis_tkeep  : in  fragment_keep_t;
    s_axis_tlast  : in  std_logic;
    s_axis_tuser  : in  cause_t;
    room          : in  std_logic;
    slot          : in  unsigned(g_slot_bits - 1 downto 0);
    open_block    : out std_logic;
    block_valid   : out std_logic;
    block_y       : out place_t;
    block_segment : out unsigned(c_place_bits - g_block_bits - 1 downto 0);
    block_mask    : out std_logic_vector(2 ** g_block_bits - 1 downto 0);
    block_first   : out unsigned(g_block_bits - g_lane_bits - 1 downto 0); -- first and last beat with a fragment
    block_last    : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    pixel_write   : out std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    pixel_place   : out unsigned(g_slot_bits + g_block_bits - g_lane_bits - 1 downto 0);
    pixel_depth   : out std_logic_vector(stored_bits(g_true_colour) - 1 downto 0);
    pixel_colour  : out std_logic_vector(stored_bits(g_true_colour) - 1 downto 0)
  );
end entity;

architecture rtl of block_collector is

  type reg_t is record
    open_frame    : std_logic; -- the frame's last transfer has not been taken
    -- The transfer that was taken, and the same after the comparison with frame and scissor.
    taken_valid   : std_logic;
    taken_last    : std_logic;
    taken_keep    : std_logic;
    taken         : fragment_t;
    pixel_valid   : std_logic; -- it is inside
    pixel         : fragment_t;
    last          : std_logic; -- pixel is the last one, or the last one was dropped
    -- The block that is collected.
    block_open    : std_logic;
    block_y       : place_t;
    block_segment : unsigned(block_segment'range);
    block_mask    : std_logic_vector(block_mask'range);
    block_first   : unsigned(block_first'range);
    block_last    : unsigned(block_last'range);
    block_slot    : unsigned(slot'range);
    -- The pixel memories.
    write         : std_logic_vector(pixel_write'range);
    place         : unsigned(pixel_place'range);
    depth         : std_logic_vector(pixel_depth'range);
    colour        : std_logic_vector(pixel_colour'range);
    fault         : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal number           : unsigned(g_block_bits - 1 downto 0); -- of the pixel in its block
  signal beat             : unsigned(block_first'range);
  signal segment          : unsigned(block_segment'range);
  signal fits             : std_logic; -- the pixel belongs to the open block
  signal opens, closes    : std_logic;
  signal pixel_free, free : std_logic; -- the pixel, and the transfer that was taken, go on
  signal ready            : std_logic;

begin

  number  <= r.pixel.x(number'range);
  beat    <= number(g_block_bits - 1 downto g_lane_bits);
  segment <= r.pixel.x(place_t'high downto g_block_bits);
  fits    <= r.block_open and flag(r.pixel.y = r.block_y) and flag(segment = r.block_segment)
    and not r.block_mask(to_integer(number));
  opens      <= r.pixel_valid and room and not fits;
  closes     <= r.block_open and (opens or (r.last and not r.pixel_valid));
  pixel_free <= not r.pixel_valid or fits or room;
  free       <= not r.taken_valid or pixel_free;
  ready      <= r.open_frame and free;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Take a transfer.
    if free = '1' then
      v.taken_valid := s_axis_tvalid and ready;
      v.taken_last  := s_axis_tlast;
      v.taken_keep  := s_axis_tkeep(0);
      v.taken       := fragment_of(s_axis_tdata);
    end if;
    v.fault := '0';
    if s_axis_tvalid = '1' and ready = '1' and s_axis_tlast = '1' then
      v.open_frame := '0';
      v.fault      := flag(s_axis_tuser /= (s_axis_tuser'range => '0'));
    end if;

    -- Drop fragments outside frame and scissor.
    if pixel_free = '1' then
      v.pixel_valid := '0';
      v.last        := '0';
      if r.last = '0' then
        v.last        := r.taken_valid and r.taken_last;
        v.pixel_valid := r.taken_valid and r.taken_keep and flag(
          r.taken.x < frame.width and r.taken.x >= frame.left and r.taken.x < frame.right
          and r.taken.y < frame.height and r.taken.y >= frame.top and r.taken.y < frame.bottom);
      else
        v.last := r.pixel_valid; -- one more clock, in which the block is closed
      end if;
      v.pixel := r.taken;
    end if;

    -- Close the block and open another one.
    if closes = '1' then
      v.block_open := '0';
    end if;
    if opens = '1' then
      v.block_open    := '1';
      v.block_y       := r.pixel.y;
      v.block_segment := segment;
      v.block_mask    := (others => '0');
      v.block_first   := beat;
      v.block_last    := beat;
      v.block_slot    := slot;
    end if;

    -- Add the pixel to the open block.
    v.write  := (others => '0');
    v.place  := v.block_slot & beat;
    v.depth  := depth_of(r.pixel.z, g_true_colour);
    v.colour := colour_of(r.pixel.red, r.pixel.green, r.pixel.blue, g_true_colour);
    if r.pixel_valid = '1' and pixel_free = '1' then
      v.write := one_hot(number, g_lane_bits);
      v.block_mask(to_integer(number)) := '1';
      if beat < v.block_first then
        v.block_first := beat;
      end if;
      if beat > v.block_last then
        v.block_last := beat;
      end if;
    end if;

    if start = '1' then
      v.open_frame := '1';
    end if;
    if reset = '1' then
      v.open_frame  := '0';
      v.taken_valid := '0';
      v.pixel_valid := '0';
      v.last        := '0';
      v.block_open  := '0';
      v.write       := (others => '0');
      v.fault       := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  s_axis_tready <= ready;
  ended         <= r.last and not r.pixel_valid;
  fault         <= r.fault;
  open_block    <= opens;
  block_valid   <= closes;
  block_y       <= r.block_y;
  block_segment <= r.block_segment;
  block_mask    <= r.block_mask;
  block_first   <= r.block_first;
  block_last    <= r.block_last;
  pixel_write   <= r.write;
  pixel_place   <= r.place;
  pixel_depth   <= r.depth;
  pixel_colour  <= r.colour;

end architecture;
