-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The order of a frame: clear, wait, draw, wait. Outputs blocks of the clear and of the fragments, and counts
--             the blocks in flight.
-- Contract    start = '1' while busy = '0' begins a frame: a simulation stops otherwise. done = '1' for one clock: all blocks
--             of the frame are retired. Blocks have the slots 0, 1, ... in this order, again and again; a block is retired,
--             retire = '1', in the order of the blocks. block_valid = '1': the block must be taken in this clock; at most
--             2**g_slot_bits blocks are not retired. fault as in block_collector.
-- Formats     memory_pkg
-- Latency     done: 2 clocks after the last retire
-- Throughput  1 fragment, or 1 block of the clear, per clock
-- Error       none
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity block_source is
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
    busy          : out std_logic;
    done          : out std_logic;
    fault         : out std_logic;
    s_axis_tvalid : in  std_logic;
    s_axis_tready : out std_logic;
    s_axis_tdata  : in  fragment_data_t;
    s_axis_tkeep  : in  fragment_keep_t;
    s_axis_tlast  : in  std_logic;
    s_axis_tuser  : in  cause_t;
    retire        : in  std_logic;
    block_valid   : out std_logic;
    block_fill    : out std_logic; -- of the clear
    block_y       : out place_t;
    block_segment : out unsigned(c_place_bits - g_block_bits - 1 downto 0);
    block_mask    : out std_logic_vector(2 ** g_block_bits - 1 downto 0);
    block_first   : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    block_last    : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    pixel_write   : out std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    pixel_place   : out unsigned(g_slot_bits + g_block_bits - g_lane_bits - 1 downto 0);
    pixel_depth   : out std_logic_vector(stored_bits(g_true_colour) - 1 downto 0);
    pixel_colour  : out std_logic_vector(stored_bits(g_true_colour) - 1 downto 0)
  );
end entity;

architecture rtl of block_source is

  type block_t is record
    valid   : std_logic;
    y       : place_t;
    segment : unsigned(block_segment'range);
    mask    : std_logic_vector(block_mask'range);
    first   : unsigned(block_first'range);
    last    : unsigned(block_last'range);
  end record;

  type phase_t is (
    idle,
    fill,      -- output the blocks of the clear
    fill_ends, -- wait for their retirement
    draw,      -- collect fragments
    draw_ends
    );

  type reg_t is record
    phase  : phase_t;
    blocks : unsigned(g_slot_bits downto 0); -- in flight
    room   : std_logic; -- for another one
    slot   : unsigned(g_slot_bits - 1 downto 0); -- of the next one
    done   : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal begins                 : std_logic;
  signal fill_start, draw_start : std_logic;
  signal fill_ended, draw_ended : std_logic;
  signal filled, collected      : block_t;
  signal collects, opens        : std_logic; -- a block is opened

begin

  begins     <= start and flag(r.phase = idle);
  fill_start <= begins and frame.clear;
  draw_start <= (begins and not frame.clear) or flag(r.phase = fill_ends and r.blocks = 0);
  opens      <= collects or filled.valid;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Clear, then draw. Wait for the last block after each.
    v.done := '0';
    if fill_start = '1' then
      v.phase := fill;
    end if;
    if fill_ended = '1' then
      v.phase := fill_ends;
    end if;
    if draw_start = '1' then
      v.phase := draw;
    end if;
    if draw_ended = '1' then
      v.phase := draw_ends;
    end if;
    if r.phase = draw_ends and r.blocks = 0 then
      v.phase := idle;
      v.done  := '1';
    end if;

    -- Count the blocks in flight, and give each a slot.
    if opens = '1' then
      v.slot := r.slot + 1;
    end if;
    if opens = '1' and retire = '0' then
      v.blocks := r.blocks + 1;
    elsif opens = '0' and retire = '1' then
      v.blocks := r.blocks - 1;
    end if;
    v.room := not v.blocks(v.blocks'high);
    if reset = '1' then
      v.phase  := idle;
      v.blocks := (others => '0');
      v.room   := '0';
      v.slot   := (others => '0');
      v.done   := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Report a broken contract in the user's simulation.
  check_start : process (clk)
  begin
    if rising_edge(clk) then
      assert start /= '1' or reset /= '0' or r.phase = idle
        report "block_source: start while busy = '1'"
        severity failure;
    end if;
  end process;

  clear : entity work.frame_fill
    generic map (
      g_block_bits => g_block_bits,
      g_lane_bits  => g_lane_bits
      )
    port map (
      clk           => clk,
      reset         => reset,
      frame         => frame,
      start         => fill_start,
      ended         => fill_ended,
      room          => r.room,
      block_valid   => filled.valid,
      block_y       => filled.y,
      block_segment => filled.segment,
      block_mask    => filled.mask,
      block_first   => filled.first,
      block_last    => filled.last
      );

  collector : entity work.block_collector
    generic map (
      g_true_colour => g_true_colour,
      g_block_bits  => g_block_bits,
      g_lane_bits   => g_lane_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk           => clk,
      reset         => reset,
      frame         => frame,
      start         => draw_start,
      ended         => draw_ended,
      fault         => fault,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tready => s_axis_tready,
      s_axis_tdata  => s_axis_tdata,
      s_axis_tkeep  => s_axis_tkeep,
      s_axis_tlast  => s_axis_tlast,
      s_axis_tuser  => s_axis_tuser,
      room          => r.room,
      slot          => r.slot,
      open_block    => collects,
      block_valid   => collected.valid,
      block_y       => collected.y,
      block_segment => collected.segment,
      block_mask    => collected.mask,
      block_first   => collected.first,
      block_last    => collected.last,
      pixel_write   => pixel_write,
      pixel_place   => pixel_place,
      pixel_depth   => pixel_depth,
      pixel_colour  => pixel_colour
      );

  block_valid   <= collected.valid or filled.valid;
  block_fill    <= filled.valid;
  block_y       <= filled.y when filled.valid = '1' else collected.y;
  block_segment <= filled.segment when filled.valid = '1' else collected.segment;
  block_mask    <= filled.mask when filled.valid = '1' else collected.mask;
  block_first   <= filled.first when filled.valid = '1' else collected.first;
  block_last    <= filled.last when filled.valid = '1' else collected.last;

  busy <= not flag(r.phase = idle);
  done <= r.done;

end architecture;
