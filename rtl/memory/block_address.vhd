-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Computes a block's two places in memory, in units of a block: base + y * stride + segment. A queue holds the
--             blocks until they are read.
-- Contract    At most 2**g_slot_bits blocks are inside: a simulation stops otherwise. The output is valid/ready; a block
--             that waits does not change. frame does not change while a block is inside. Bits of bases and strides
--             below a block count as 0. The other fields pass
--             unchanged.
-- Formats     memory_pkg
-- Latency     5 clocks
-- Throughput  1 block per clock
-- Error       none: sums wrap at the end of the address space
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp: place

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;

entity block_address is
  generic (
    g_block_bits : positive;
    g_lane_bits  : natural;
    g_shift      : positive; -- log2 of a block's bytes
    g_slot_bits  : positive
  );
  port (
    clk        : in  std_logic;
    reset      : in  std_logic;
    frame      : in  frame_t;
    in_valid   : in  std_logic;
    in_y       : in  place_t;
    in_segment : in  unsigned(c_place_bits - g_block_bits - 1 downto 0);
    in_fill    : in  std_logic;
    in_mask    : in  std_logic_vector(2 ** g_block_bits - 1 downto 0);
    in_first   : in  unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    in_last    : in  unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    out_valid  : out std_logic;
    out_ready  : in  std_logic;
    out_depth  : out unsigned(address_t'length - g_shift - 1 downto 0);
    out_colour : out unsigned(address_t'length - g_shift - 1 downto 0);
    out_fill   : out std_logic;
    out_mask   : out std_logic_vector(2 ** g_block_bits - 1 downto 0);
    out_first  : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    out_last   : out unsigned(g_block_bits - g_lane_bits - 1 downto 0)
  );
end entity;

architecture rtl of block_address is

  constant c_bits      : positive := address_t'length - g_shift;
  constant c_beat_bits : positive := g_block_bits - g_lane_bits;

  subtype block_t is unsigned(c_bits - 1 downto 0);
  subtype rest_t is std_logic_vector(2 ** g_block_bits + 2 * c_beat_bits downto 0); -- fill, first, last, mask
  subtype product_t is unsigned(c_place_bits + c_stride_bits - g_shift - 1 downto 0);

  type reg_t is record
    valid     : std_logic; -- a block comes
    y         : place_t;
    segment   : unsigned(in_segment'range);
    rest      : rest_t;
    valid_1   : std_logic; -- its products
    segment_1 : unsigned(in_segment'range);
    rest_1    : rest_t;
    depth_1   : product_t;
    colour_1  : product_t;
    valid_2   : std_logic; -- its sums
    depth_2   : block_t;
    colour_2  : block_t;
    rest_2    : rest_t;
  end record;

  signal r, r_next : reg_t;

  signal queue_in, queue_out : std_logic_vector(2 * c_bits + rest_t'high downto 0);

  -- The upper bits of the product may be cut: sums wrap.
  function block_of (base : address_t; product : product_t; segment : unsigned) return block_t is
  begin
    return base(address_t'high downto g_shift) + resize(product, c_bits) + resize(segment, c_bits);
  end function;

begin

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Take a block; form its products; form its sums.
    v.valid   := in_valid;
    v.y       := in_y;
    v.segment := in_segment;
    v.rest    := in_fill & std_logic_vector(in_first) & std_logic_vector(in_last) & in_mask;

    v.valid_1   := r.valid;
    v.segment_1 := r.segment;
    v.rest_1    := r.rest;
    v.depth_1   := r.y * frame.depth_stride(c_stride_bits - 1 downto g_shift);
    v.colour_1  := r.y * frame.colour_stride(c_stride_bits - 1 downto g_shift);

    v.valid_2  := r.valid_1;
    v.rest_2   := r.rest_1;
    v.depth_2  := block_of(frame.depth_base, r.depth_1, r.segment_1);
    v.colour_2 := block_of(frame.colour_base, r.colour_1, r.segment_1);
    if reset = '1' then
      v.valid   := '0';
      v.valid_1 := '0';
      v.valid_2 := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  queue_in <= std_logic_vector(r.depth_2) & std_logic_vector(r.colour_2) & r.rest_2;

  queue : entity work.stream_queue
    generic map (
      g_bits       => queue_in'length,
      g_index_bits => g_slot_bits + 1
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => in_valid,
      room      => open,
      pending   => open,
      in_valid  => r.valid_2,
      in_data   => queue_in,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => queue_out
      );

  out_depth  <= unsigned(queue_out(queue_out'high downto queue_out'length - c_bits));
  out_colour <= unsigned(queue_out(rest_t'high + c_bits downto rest_t'length));
  out_fill   <= queue_out(rest_t'high);
  out_first  <= unsigned(queue_out(in_mask'length + 2 * c_beat_bits - 1 downto in_mask'length + c_beat_bits));
  out_last   <= unsigned(queue_out(in_mask'length + c_beat_bits - 1 downto in_mask'length));
  out_mask   <= queue_out(in_mask'range);

end architecture;
