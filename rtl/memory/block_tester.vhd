-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Compares a block's fragments with the stored depths, beat by beat as these come. A pixel is kept where the
--             mask is set and the fragment is nearer; of equal depths the stored one stays. In a block of a clear all
--             pixels of the mask are kept, without a read. A bit per pixel goes to the keep memory.
-- Contract    Blocks have the slots 0, 1, ... in this order. The input is valid/ready. m_axi_rready depends on registers
--             only. test_depth is that of test_place one clock ago. The output is valid/ready: blocks whose keep bits are
--             written; out_any: a pixel is kept, from beat out_first to beat out_last. At most 2**g_slot_bits blocks wait. fault = '1' for one clock: an
--             error response. Its beat is compared as any other. pixels: number of pixels whose keep bits are written in
--             this clock, without those of a clear.
-- Formats     memory_pkg: depths, in memory filled with zeros
-- Latency     6 clocks from the last beat to out_valid
-- Throughput  1 beat per clock, without a clock between blocks
-- Error       none
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp: add

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity block_tester is
  generic (
    g_true_colour : boolean;
    g_block_bits  : positive;
    g_lane_bits   : natural;
    g_number_bits : positive; -- of a block's number
    g_slot_bits   : positive
  );
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    in_valid     : in  std_logic;
    in_ready     : out std_logic;
    in_fill      : in  std_logic;
    in_mask      : in  std_logic_vector(2 ** g_block_bits - 1 downto 0);
    in_first     : in  unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    in_last      : in  unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    in_depth     : in  unsigned(g_number_bits - 1 downto 0);
    in_colour    : in  unsigned(g_number_bits - 1 downto 0);
    m_axi_rvalid : in  std_logic;
    m_axi_rready : out std_logic;
    m_axi_rdata  : in  std_logic_vector(2 ** g_lane_bits * pixel_bits(g_true_colour) - 1 downto 0);
    m_axi_rresp  : in  std_logic_vector(1 downto 0);
    test_place   : out unsigned(g_slot_bits + g_block_bits - g_lane_bits - 1 downto 0);
    test_depth   : in  std_logic_vector(2 ** g_lane_bits * stored_bits(g_true_colour) - 1 downto 0);
    keep_write   : out std_logic;
    keep_place   : out unsigned(g_slot_bits + g_block_bits - g_lane_bits - 1 downto 0);
    keep_bits    : out std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    out_valid    : out std_logic;
    out_ready    : in  std_logic;
    out_any      : out std_logic;
    out_first    : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    out_last     : out unsigned(g_block_bits - g_lane_bits - 1 downto 0);
    out_fill     : out std_logic;
    out_depth    : out unsigned(g_number_bits - 1 downto 0);
    out_colour   : out unsigned(g_number_bits - 1 downto 0);
    fault        : out std_logic;
    pixels       : out pixel_count_t
  );
end entity;

architecture rtl of block_tester is

  constant c_lanes  : positive := 2 ** g_lane_bits;
  constant c_pixel  : positive := pixel_bits(g_true_colour);
  constant c_stored : positive := stored_bits(g_true_colour);

  constant c_beat_bits : positive := g_block_bits - g_lane_bits;
  constant c_word_bits : positive := 2 + 2 * g_number_bits + 2 * c_beat_bits;

  subtype beat_t is unsigned(in_first'range);
  subtype places_t is std_logic_vector(2 * g_number_bits downto 0); -- fill, depth, colour

  type beat_of_block_t is record
    valid  : std_logic;
    ends   : std_logic; -- the block's last one
    mask   : std_logic_vector(keep_bits'range); -- of the pixels that can be kept, then of those that are
    place  : unsigned(keep_place'range);
    places : places_t;
  end record;

  type reg_t is record
    -- The block that is read.
    active      : std_logic;
    fill        : std_logic;
    mask        : std_logic_vector(in_mask'range);
    beat        : beat_t;
    last        : beat_t;
    places      : places_t;
    slot        : unsigned(g_slot_bits - 1 downto 0); -- of the next block
    place       : unsigned(test_place'range); -- of the beat
    -- The beat that came, then with the depths of its fragments, then its keep bits, and those of the block up to it.
    came        : beat_of_block_t;
    came_data   : std_logic_vector(m_axi_rdata'range);
    came_fault  : std_logic;
    held        : beat_of_block_t;
    held_data   : std_logic_vector(m_axi_rdata'range);
    held_depth  : std_logic_vector(test_depth'range);
    tested      : beat_of_block_t;
    any         : std_logic;
    first_kept  : beat_t;
    last_kept   : beat_t;
    done        : std_logic;
    done_places : places_t;
  end record;

  signal r, r_next : reg_t;

  signal take, finishes, load   : std_logic;
  signal queue_in, queue_out : std_logic_vector(c_word_bits - 1 downto 0);

begin

  take     <= r.active and (r.fill or m_axi_rvalid);
  finishes <= take and flag(r.beat = r.last);
  load     <= in_valid and (finishes or not r.active);

  combinational : process (all)
    variable v      : reg_t;
    variable nearer : std_logic;
  begin
    v := r;
    -- Step through the block's beats, and to the next block.
    if take = '1' then
      v.beat    := r.beat + 1;
      v.place := r.place + 1;
    end if;
    if finishes = '1' then
      v.active := '0';
    end if;
    if load = '1' then
      v.active := '1';
      v.fill   := in_fill;
      v.mask   := in_mask;
      v.beat   := in_first;
      v.last   := in_last;
      v.places := in_fill & std_logic_vector(in_depth) & std_logic_vector(in_colour);
      v.place := r.slot & in_first;
      v.slot    := r.slot + 1;
    end if;

    -- Hold the beat while the depths of its fragments are read.
    v.came.valid  := take;
    v.came.ends   := finishes;
    v.came.place  := r.place;
    v.came.places := r.places;
    for lane in keep_bits'range loop
      v.came.mask(lane) := r.mask(c_lanes * to_integer(r.beat) + lane);
    end loop;
    v.came_data  := m_axi_rdata;
    v.came_fault := take and not r.fill and flag(m_axi_rresp /= "00");

    -- Register the depths: a memory's output is late in the clock.
    v.held       := r.came;
    v.held_data  := r.came_data;
    v.held_depth := test_depth;

    -- Compare.
    v.tested := r.held;
    for lane in keep_bits'range loop
      nearer := flag(unsigned(r.held_depth((lane + 1) * c_stored - 1 downto lane * c_stored))
        < unsigned(r.held_data((lane + 1) * c_pixel - 1 downto lane * c_pixel)));
      v.tested.mask(lane) := r.held.mask(lane) and (r.held.places(places_t'high) or nearer);
    end loop;

    -- Find the first and the last beat that is written.
    if r.done = '1' then
      v.any := '0';
    end if;
    if r.tested.valid = '1' and r.tested.mask /= (keep_bits'range => '0') then
      v.last_kept := r.tested.place(beat_t'range);
      if v.any = '0' then
        v.first_kept := r.tested.place(beat_t'range);
      end if;
      v.any := '1';
    end if;
    v.done        := r.tested.valid and r.tested.ends;
    v.done_places := r.tested.places;
    if reset = '1' then
      v.active       := '0';
      v.slot         := (others => '0');
      v.came.valid   := '0';
      v.came_fault   := '0';
      v.held.valid   := '0';
      v.tested.valid := '0';
      v.any          := '0';
      v.done         := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Blocks that wait to be written.
  queue_in <= r.any & r.done_places & std_logic_vector(r.first_kept) & std_logic_vector(r.last_kept);

  queue : entity work.stream_queue
    generic map (
      g_bits       => c_word_bits,
      g_index_bits => g_slot_bits + 1
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => r.done,
      room      => open,
      pending   => open,
      in_valid  => r.done,
      in_data   => queue_in,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => queue_out
      );

  out_any    <= queue_out(c_word_bits - 1);
  out_fill   <= queue_out(c_word_bits - 2);
  out_depth  <= unsigned(queue_out(2 * g_number_bits + 2 * c_beat_bits - 1 downto g_number_bits + 2 * c_beat_bits));
  out_colour <= unsigned(queue_out(g_number_bits + 2 * c_beat_bits - 1 downto 2 * c_beat_bits));
  out_first  <= unsigned(queue_out(2 * c_beat_bits - 1 downto c_beat_bits));
  out_last   <= unsigned(queue_out(c_beat_bits - 1 downto 0));

  in_ready     <= load;
  m_axi_rready <= r.active and not r.fill;
  test_place   <= r.place;
  keep_write   <= r.tested.valid;
  keep_place   <= r.tested.place;
  keep_bits    <= r.tested.mask;
  fault        <= r.came_fault;
  pixels       <= count_of(r.tested.mask) when r.tested.valid = '1' and r.tested.places(places_t'high) = '0'
    else (others => '0');

end architecture;
