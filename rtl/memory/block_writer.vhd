-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Writes the pixels of a block that are kept: a burst to the depth buffer, then one to the colour buffer.
--             Queues between the pixel memories and the bus: bursts follow each other without a clock between them.
-- Contract    Blocks have the slots 0, 1, ... in this order. The input is valid/ready, and a block that waits does not
--             change. in_any = '0': no pixel is kept, and nothing is written. Other blocks have a kept pixel in their
--             first and last beat. keep, depth and colour are those of place one clock ago.
--             retire = '1' for one clock: the oldest block that has not been retired has no write without a response.
--             fault = '1' for one clock: an error response. At most 2**g_slot_bits blocks are not retired.
--             AXI4: all outputs depend on registers only. m_axi_bready waits for m_axi_bvalid of no other block.
-- Formats     memory_pkg
-- Latency     3 clocks from a block to m_axi_awvalid, 4 to m_axi_wvalid
-- Throughput  1 beat per clock
-- Error       none
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity block_writer is
  generic (
    g_true_colour : boolean;
    g_lane_bits   : natural;
    g_number_bits : positive; -- of a block's number
    g_beat_bits   : positive;
    g_slot_bits   : positive
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    clear_colour  : in  std_logic_vector(stored_bits(g_true_colour) - 1 downto 0);
    in_valid      : in  std_logic;
    in_ready      : out std_logic;
    in_fill       : in  std_logic;
    in_any        : in  std_logic;
    in_depth      : in  unsigned(g_number_bits - 1 downto 0);
    in_colour     : in  unsigned(g_number_bits - 1 downto 0);
    in_first      : in  unsigned(g_beat_bits - 1 downto 0);
    in_last       : in  unsigned(g_beat_bits - 1 downto 0);
    retire        : out std_logic;
    fault         : out std_logic;
    place         : out unsigned(g_slot_bits + g_beat_bits - 1 downto 0);
    keep          : in  std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    depth         : in  std_logic_vector(2 ** g_lane_bits * stored_bits(g_true_colour) - 1 downto 0);
    colour        : in  std_logic_vector(2 ** g_lane_bits * stored_bits(g_true_colour) - 1 downto 0);
    m_axi_awvalid : out std_logic;
    m_axi_awready : in  std_logic;
    aw_block      : out unsigned(g_number_bits - 1 downto 0);
    aw_first      : out unsigned(g_beat_bits - 1 downto 0);
    aw_length     : out unsigned(g_beat_bits - 1 downto 0); -- beats - 1
    m_axi_wvalid  : out std_logic;
    m_axi_wready  : in  std_logic;
    m_axi_wdata   : out std_logic_vector(2 ** g_lane_bits * pixel_bits(g_true_colour) - 1 downto 0);
    m_axi_wstrb   : out std_logic_vector(2 ** g_lane_bits * pixel_bytes(g_true_colour) - 1 downto 0);
    m_axi_wlast   : out std_logic;
    m_axi_bvalid  : in  std_logic;
    m_axi_bready  : out std_logic;
    m_axi_bresp   : in  std_logic_vector(1 downto 0)
  );
end entity;

architecture rtl of block_writer is

  constant c_stored       : positive := stored_bits(g_true_colour);
  constant c_pixel        : positive := pixel_bits(g_true_colour);
  constant c_strobes      : positive := pixel_bytes(g_true_colour); -- of a pixel
  constant c_request_bits : positive := g_number_bits + 2 * g_beat_bits;

  subtype beat_t is unsigned(in_first'range);

  type reg_t is record
    -- The block that is written.
    active       : std_logic;
    fill         : std_logic;
    colour       : std_logic; -- its colours; before that its depths
    starts       : std_logic; -- the burst's first beat
    beat         : beat_t;
    first        : beat_t;
    last         : beat_t;
    depth_block  : unsigned(in_depth'range);
    colour_block : unsigned(in_colour'range);
    slot         : unsigned(g_slot_bits - 1 downto 0);
    -- The beat whose words are read.
    reads        : std_logic;
    reads_fill   : std_logic;
    reads_colour : std_logic;
    reads_last   : std_logic;
    second       : std_logic; -- the next response is that of a block's second burst
    retire       : std_logic;
    fault        : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal address_room, data_room : std_logic;
  signal step, finishes, load       : std_logic; -- a beat is read; the block's last one; the next block begins
  signal request, request_out : std_logic_vector(c_request_bits - 1 downto 0);
  signal starts               : std_logic;
  signal data, data_out       : std_logic_vector(m_axi_wdata'length + m_axi_wstrb'length downto 0);
  signal oldest_valid         : std_logic;
  signal oldest_any           : std_logic_vector(0 downto 0);
  signal answered             : std_logic; -- the oldest block has all its responses
  signal response             : std_logic;

begin

  step     <= r.active and data_room and (address_room or not r.starts);
  finishes <= step and r.colour and flag(r.beat = r.last);
  load     <= in_valid and (finishes or not r.active);

  response <= m_axi_bvalid and oldest_valid and oldest_any(0);
  answered <= oldest_valid and (not oldest_any(0) or (m_axi_bvalid and r.second));

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Step through the depths, then through the colours.
    if step = '1' then
      v.beat   := r.beat + 1;
      v.starts := '0';
      if r.beat = r.last then
        v.beat   := r.first;
        v.colour := '1';
        v.starts := '1';
      end if;
    end if;
    if finishes = '1' then
      v.active := '0';
    end if;

    -- Begin the next block. Skip it if no pixel is kept.
    if load = '1' then
      v.active       := in_any;
      v.fill         := in_fill;
      v.colour       := '0';
      v.starts       := '1';
      v.beat         := in_first;
      v.first        := in_first;
      v.last         := in_last;
      v.depth_block  := in_depth;
      v.colour_block := in_colour;
      v.slot         := r.slot + 1;
    end if;
    v.reads        := step;
    v.reads_fill   := r.fill;
    v.reads_colour := r.colour;
    v.reads_last   := flag(r.beat = r.last);

    -- Count the responses of the oldest block.
    if response = '1' then
      v.second := not r.second;
    end if;
    v.retire := answered;
    v.fault  := response and flag(m_axi_bresp /= "00");
    if reset = '1' then
      v.active := '0';
      v.slot   := (others => '1');
      v.reads  := '0';
      v.second := '0';
      v.retire := '0';
      v.fault  := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- The address of a burst.
  starts  <= step and r.starts;
  request <= std_logic_vector(r.colour_block) & std_logic_vector(r.first) & std_logic_vector(r.last - r.first)
    when r.colour = '1' else
    std_logic_vector(r.depth_block) & std_logic_vector(r.first) & std_logic_vector(r.last - r.first);

  addresses : entity work.stream_queue
    generic map (
      g_bits       => c_request_bits,
      g_index_bits => 2
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => starts,
      room      => address_room,
      pending   => open,
      in_valid  => starts,
      in_data   => request,
      out_valid => m_axi_awvalid,
      out_ready => m_axi_awready,
      out_data  => request_out
      );

  aw_block  <= unsigned(request_out(c_request_bits - 1 downto 2 * g_beat_bits));
  aw_first  <= unsigned(request_out(2 * g_beat_bits - 1 downto g_beat_bits));
  aw_length <= unsigned(request_out(g_beat_bits - 1 downto 0));

  -- A beat: last, strobes, data.
  data(data'high) <= r.reads_last;
  lanes : for lane in keep'range generate
    signal word, filled : std_logic_vector(c_stored - 1 downto 0);
  begin
    filled <= clear_colour when r.reads_colour = '1' else (others => '1');
    word <= filled when r.reads_fill = '1' else
      colour((lane + 1) * c_stored - 1 downto lane * c_stored) when r.reads_colour = '1' else
      depth((lane + 1) * c_stored - 1 downto lane * c_stored);
    data(lane * c_pixel + c_stored - 1 downto lane * c_pixel) <= word;
    -- Only a cleared depth has ones above the stored bits.
    upper : for i in c_stored to c_pixel - 1 generate
      data(lane * c_pixel + i) <= r.reads_fill and not r.reads_colour;
    end generate;
    data(m_axi_wdata'length + (lane + 1) * c_strobes - 1 downto m_axi_wdata'length + lane * c_strobes) <=
      (others => keep(lane));
  end generate;

  beats : entity work.stream_queue
    generic map (
      g_bits       => data'length,
      g_index_bits => 3
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => step,
      room      => data_room,
      pending   => open,
      in_valid  => r.reads,
      in_data   => data,
      out_valid => m_axi_wvalid,
      out_ready => m_axi_wready,
      out_data  => data_out
      );

  m_axi_wlast <= data_out(data'high);
  m_axi_wstrb <= data_out(data'high - 1 downto m_axi_wdata'length);
  m_axi_wdata <= data_out(m_axi_wdata'range);

  -- The blocks that are not retired: whether they have responses.
  blocks : entity work.stream_queue
    generic map (
      g_bits       => 1,
      g_index_bits => g_slot_bits + 1
      )
    port map (
      clk        => clk,
      reset      => reset,
      claim      => load,
      room       => open,
      pending    => open,
      in_valid   => load,
      in_data(0) => in_any,
      out_valid  => oldest_valid,
      out_ready  => answered,
      out_data   => oldest_any
      );

  in_ready     <= load;
  retire       <= r.retire;
  fault        <= r.fault;
  place        <= r.slot & r.beat;
  m_axi_bready <= oldest_valid and oldest_any(0);

end architecture;
