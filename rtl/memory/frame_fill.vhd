-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Outputs the blocks of the part of a frame that the scissor leaves, row by row, to clear it.
-- Contract    start: begin. ended = '1' for one clock: all blocks have been output. A block is output only while room =
--             '1', and must be taken in this clock: block_valid = '1'. frame does not change meanwhile.
-- Formats     memory_pkg
-- Latency     2 clocks from start to the first block
-- Throughput  1 block per clock
-- Error       none
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp: clear

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity frame_fill is
  generic (
    g_block_bits : positive;
    g_lane_bits  : natural
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    frame         : in  frame_t;
    start         : in  std_logic;
    ended         : out std_logic;
    room          : in  std_logic;
    block_valid   : out std_logic;
    block_y       : out place_t;
    block_segment : out unsigned(c_place_bits - g_block_bits - 1 downto 0);
    block_mask    : out std_logic_vector(2 ** g_block_bits - 1 downto 0);
    block_first   : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    block_last    : out unsigned(g_block_bits - g_lane_bits - 1 downto 0)
  );
end entity;

architecture rtl of frame_fill is

  subtype segment_t is unsigned(block_segment'range);

  type reg_t is record
    started : std_logic;
    active  : std_logic;
    ended   : std_logic;
    right   : side_t; -- of scissor and frame
    bottom  : side_t;
    y       : place_t;
    segment : segment_t;
  end record;

  signal r, r_next : reg_t;

  signal final_x                  : place_t; -- last pixel of a row
  signal is_first, is_last, valid : std_logic; -- of the row's blocks

begin

  final_x  <= resize(r.right - 1, c_place_bits);
  is_first <= flag(r.segment = frame.left(place_t'high downto g_block_bits));
  is_last  <= flag(r.segment = final_x(place_t'high downto g_block_bits));
  valid    <= r.active and room;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.ended   := '0';
    v.started := start;
    v.right   := lesser(frame.right, frame.width);
    v.bottom  := lesser(frame.bottom, frame.height);

    -- Begin at the first block, or end if there is none.
    if r.started = '1' then
      v.y       := resize(frame.top, c_place_bits);
      v.segment := frame.left(place_t'high downto g_block_bits);
      v.active  := flag(frame.left < r.right and frame.top < r.bottom);
      v.ended   := not v.active;
    end if;

    -- Step to the next block.
    if valid = '1' then
      v.segment := r.segment + 1;
      if is_last = '1' then
        v.segment := frame.left(place_t'high downto g_block_bits);
        v.y       := r.y + 1;
        if r.y = r.bottom - 1 then
          v.active := '0';
          v.ended  := '1';
        end if;
      end if;
    end if;
    if reset = '1' then
      v.started := '0';
      v.active  := '0';
      v.ended   := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Select the row's pixels of this block.
  pixels : for number in block_mask'range generate
    block_mask(number) <= (not is_first or flag(number >= frame.left(g_block_bits - 1 downto 0)))
      and (not is_last or flag(number <= final_x(g_block_bits - 1 downto 0)));
  end generate;

  ended         <= r.ended;
  block_valid   <= valid;
  block_y       <= r.y;
  block_segment <= r.segment;
  block_first   <= frame.left(g_block_bits - 1 downto g_lane_bits) when is_first = '1' else (others => '0');
  block_last    <= final_x(g_block_bits - 1 downto g_lane_bits) when is_last = '1' else (others => '1');

end architecture;
