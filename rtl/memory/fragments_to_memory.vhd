-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Draws the fragments of a shader into memory: depth test, a picture and a depth buffer. Several blocks are in
--             flight, so that the memory's latency is hidden:
--
--               fragments --> block_source --> block_address --> block_reader --> block_tester --> block_writer --> AW, W
--                              collect,        places           AR        R --> compare            ^   ^
--                              clear                                              |                |   +-- B
--                                +--------------> pixel_store: depth, colour <----+--> keep bits --+
--
-- Contract    start = '1' while busy = '0' begins a frame: the clear, if frame.clear = '1', then the fragments up to tlast.
--             frame does not change from start to done (a simulation stops otherwise). done = '1' for one clock: all writes
--             of the frame have their responses. fault = '1': since start a response had an error, or tuser was not 0 in the
--             transfer with tlast. It stays until the next start. A frame with errors ends as any other. The data of a read
--             with an error are compared; its fragments are kept or not.
--             The sum of pixels from start to done is the number of fragments that are kept; the clear is not counted.
--             s_axis: fragments as of axi_adapter, and a cause of a fault as tuser in the transfer with tlast. What waits
--             does not change (a simulation stops otherwise).
--             Nothing outside width, height and scissor is written, by fragments and by the clear. Depth test: a fragment
--             is kept if its depth in memory is less than the stored one. Rows must not overlap, nor the two buffers.
--             m_axi: AXI4, one identifier for all reads and one for all writes, so there are no ports for it. INCR bursts
--             of whole beats inside a block, which has at most 4 KiB. A word or a response that changes while it waits, or
--             comes without a request, stops a simulation. A depth is read only when all older writes to its
--             beats have their responses; the first read after a clear waits for all responses of the clear. All outputs
--             depend on registers only.
-- Formats     memory_pkg: RGB565 and a depth of 16 bits, or XRGB8888 and a depth of 32 bits, little-endian
-- Latency     docs/rtl/memory.md
-- Throughput  1 fragment per clock in long spans, if the bus has the beats: docs/rtl/memory.md
-- Error       depth and colour of RGB565 are truncated
-- Source      ours
-- Golden twin model/golden/frame_memory.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.memory_pkg.all;
use work.stream_pkg.all;

entity fragments_to_memory is
  generic (
    g_true_colour : boolean  := false; -- XRGB8888 and a depth of 32 bits
    g_data_bits   : positive := 64; -- 32 or 64
    g_block_bits  : positive := 6; -- 2**g_block_bits pixels in a block
    g_slot_bits   : positive := 3 -- 2**g_slot_bits blocks in flight
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    frame         : in  frame_t;
    start         : in  std_logic;
    busy          : out std_logic;
    done          : out std_logic;
    fault         : out std_logic;
    pixels        : out pixel_count_t; -- kept by the depth test in this clock
    s_axis_tvalid : in  std_logic;
    s_axis_tready : out std_logic;
    s_axis_tdata  : in  fragment_data_t;
    s_axis_tkeep  : in  fragment_keep_t;
    s_axis_tlast  : in  std_logic;
    s_axis_tuser  : in  cause_t;
    m_axi_arvalid : out std_logic;
    m_axi_arready : in  std_logic;
    m_axi_araddr  : out address_t;
    m_axi_arlen   : out unsigned(7 downto 0);
    m_axi_arsize  : out std_logic_vector(2 downto 0);
    m_axi_arburst : out std_logic_vector(1 downto 0);
    m_axi_arcache : out std_logic_vector(3 downto 0);
    m_axi_arprot  : out std_logic_vector(2 downto 0);
    m_axi_rvalid  : in  std_logic; -- rlast is not needed: the length is known
    m_axi_rready  : out std_logic;
    m_axi_rdata   : in  std_logic_vector(g_data_bits - 1 downto 0);
    m_axi_rresp   : in  std_logic_vector(1 downto 0);
    m_axi_awvalid : out std_logic;
    m_axi_awready : in  std_logic;
    m_axi_awaddr  : out address_t;
    m_axi_awlen   : out unsigned(7 downto 0);
    m_axi_awsize  : out std_logic_vector(2 downto 0);
    m_axi_awburst : out std_logic_vector(1 downto 0);
    m_axi_awcache : out std_logic_vector(3 downto 0);
    m_axi_awprot  : out std_logic_vector(2 downto 0);
    m_axi_wvalid  : out std_logic;
    m_axi_wready  : in  std_logic;
    m_axi_wdata   : out std_logic_vector(g_data_bits - 1 downto 0);
    m_axi_wstrb   : out std_logic_vector(bytes(g_data_bits) - 1 downto 0);
    m_axi_wlast   : out std_logic;
    m_axi_bvalid  : in  std_logic;
    m_axi_bready  : out std_logic;
    m_axi_bresp   : in  std_logic_vector(1 downto 0)
  );
end entity;

architecture rtl of fragments_to_memory is

  constant c_lane_bits   : natural  := lane_bits(g_data_bits, g_true_colour);
  constant c_beat_bits   : positive := g_block_bits - c_lane_bits;
  constant c_beat_shift  : positive := log2(bytes(g_data_bits)); -- of the bytes of a beat
  constant c_shift       : positive := c_beat_shift + c_beat_bits; -- of the bytes of a block
  constant c_number_bits : positive := address_t'length - c_shift; -- of a block in memory
  constant c_stored      : positive := stored_bits(g_true_colour);
  constant c_size        : unsigned(m_axi_arsize'range) := to_unsigned(c_beat_shift, m_axi_arsize'length);

  -- A block, with the fields that are known at its place in the drawing.
  type block_t is record
    valid    : std_logic;
    is_taken : std_logic;
    fill     : std_logic;
    y        : place_t;
    segment  : unsigned(c_place_bits - g_block_bits - 1 downto 0);
    mask     : std_logic_vector(2 ** g_block_bits - 1 downto 0);
    first    : unsigned(c_beat_bits - 1 downto 0);
    last     : unsigned(c_beat_bits - 1 downto 0);
    depth    : unsigned(c_number_bits - 1 downto 0);
    colour   : unsigned(c_number_bits - 1 downto 0);
    kept     : std_logic;
  end record;

  -- The address of a burst.
  type request_t is record
    number : unsigned(c_number_bits - 1 downto 0);
    first  : unsigned(c_beat_bits - 1 downto 0);
    length : unsigned(c_beat_bits - 1 downto 0);
  end record;

  subtype lanes_t is std_logic_vector(2 ** c_lane_bits - 1 downto 0);
  subtype words_t is std_logic_vector(2 ** c_lane_bits * c_stored - 1 downto 0);
  subtype memory_place_t is unsigned(g_slot_bits + c_beat_bits - 1 downto 0);

  signal closed, placed, requested, tested : block_t;
  signal read_request, write_request       : request_t;
  signal retire, begins, in_work           : std_logic;
  signal cause, read_fault, write_fault    : std_logic;
  signal pixel_write, keep_bits, keep      : lanes_t;
  signal keep_write                        : std_logic;
  signal pixel_place, test_place           : memory_place_t;
  signal keep_place, write_place           : memory_place_t;
  signal pixel_depth, pixel_colour, clear_colour : std_logic_vector(c_stored - 1 downto 0);
  signal test_depth, depth, colour            : words_t;

begin

  assert (g_data_bits = 32 or g_data_bits = 64) and g_block_bits > c_lane_bits and c_shift <= 12 and c_beat_bits <= 8
    report "fragments_to_memory: g_data_bits is " & integer'image(g_data_bits) & ", not 32 or 64, or a block of 2**"
    & integer'image(g_block_bits) & " pixels is one beat, or more than 256 beats or 4096 bytes"
    severity failure;

  -- Report a broken contract in the user's simulation.
  check_frame : process (clk)
    variable frame_before : frame_t;
  begin
    if rising_edge(clk) then
      assert in_work /= '1' or reset /= '0' or frame = frame_before
        report "fragments_to_memory: frame changes while busy = '1'"
        severity failure;
      frame_before := frame;
      assert begins /= '1' or reset /= '0' or
        (frame.colour_base(c_shift - 1 downto 0) = 0 and frame.colour_stride(c_shift - 1 downto 0) = 0
        and frame.depth_base(c_shift - 1 downto 0) = 0 and frame.depth_stride(c_shift - 1 downto 0) = 0)
        report "fragments_to_memory: a base or a stride is not a multiple of " & integer'image(2 ** c_shift) & " bytes"
        severity failure;
    end if;
  end process;

  check_fragments : process (clk)
    variable waiting : std_logic_vector(s_axis_tdata'length + s_axis_tkeep'length + s_axis_tuser'length + 1 downto 0);
  begin
    if rising_edge(clk) then
      check_stream("fragments_to_memory: s_axis", reset, s_axis_tready,
        s_axis_tvalid & s_axis_tlast & s_axis_tuser & s_axis_tkeep & s_axis_tdata, waiting);
    end if;
  end process;

  check_memory : process (clk)
    variable r_waiting      : std_logic_vector(m_axi_rdata'length + m_axi_rresp'length downto 0);
    variable b_waiting      : std_logic_vector(m_axi_bresp'length downto 0);
    variable words_missing  : natural;
    variable bursts_missing : natural; -- whose last word was taken
  begin
    if rising_edge(clk) then
      check_stream("fragments_to_memory: m_axi_r", reset, m_axi_rready, m_axi_rvalid & m_axi_rresp & m_axi_rdata, r_waiting);
      check_stream("fragments_to_memory: m_axi_b", reset, m_axi_bready, m_axi_bvalid & m_axi_bresp, b_waiting);
      check_answers("fragments_to_memory: m_axi_r", reset, m_axi_arvalid and m_axi_arready, m_axi_arlen,
        m_axi_rvalid, m_axi_rvalid and m_axi_rready, words_missing);
      check_answers("fragments_to_memory: m_axi_b", reset, m_axi_wvalid and m_axi_wready and m_axi_wlast, "0",
        m_axi_bvalid, m_axi_bvalid and m_axi_bready, bursts_missing);
    end if;
  end process;

  source : entity work.block_source
    generic map (
      g_true_colour => g_true_colour,
      g_block_bits  => g_block_bits,
      g_lane_bits   => c_lane_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk           => clk,
      reset         => reset,
      frame         => frame,
      start         => start,
      busy          => in_work,
      done          => done,
      fault         => cause,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tready => s_axis_tready,
      s_axis_tdata  => s_axis_tdata,
      s_axis_tkeep  => s_axis_tkeep,
      s_axis_tlast  => s_axis_tlast,
      s_axis_tuser  => s_axis_tuser,
      retire        => retire,
      block_valid   => closed.valid,
      block_fill    => closed.fill,
      block_y       => closed.y,
      block_segment => closed.segment,
      block_mask    => closed.mask,
      block_first   => closed.first,
      block_last    => closed.last,
      pixel_write   => pixel_write,
      pixel_place   => pixel_place,
      pixel_depth   => pixel_depth,
      pixel_colour  => pixel_colour
      );

  addresses : entity work.block_address
    generic map (
      g_block_bits => g_block_bits,
      g_lane_bits  => c_lane_bits,
      g_shift      => c_shift,
      g_slot_bits  => g_slot_bits
      )
    port map (
      clk        => clk,
      reset      => reset,
      frame      => frame,
      in_valid   => closed.valid,
      in_y       => closed.y,
      in_segment => closed.segment,
      in_fill    => closed.fill,
      in_mask    => closed.mask,
      in_first   => closed.first,
      in_last    => closed.last,
      out_valid  => placed.valid,
      out_ready  => placed.is_taken,
      out_depth  => placed.depth,
      out_colour => placed.colour,
      out_fill   => placed.fill,
      out_mask   => placed.mask,
      out_first  => placed.first,
      out_last   => placed.last
      );

  reader : entity work.block_reader
    generic map (
      g_number_bits => c_number_bits,
      g_mask_bits   => 2 ** g_block_bits,
      g_beat_bits   => c_beat_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk           => clk,
      reset         => reset,
      in_valid      => placed.valid,
      in_ready      => placed.is_taken,
      in_fill       => placed.fill,
      in_mask       => placed.mask,
      in_depth      => placed.depth,
      in_colour     => placed.colour,
      in_first      => placed.first,
      in_last       => placed.last,
      out_valid     => requested.valid,
      out_ready     => requested.is_taken,
      out_fill      => requested.fill,
      out_mask      => requested.mask,
      out_depth     => requested.depth,
      out_colour    => requested.colour,
      out_first     => requested.first,
      out_last      => requested.last,
      retire        => retire,
      m_axi_arvalid => m_axi_arvalid,
      m_axi_arready => m_axi_arready,
      ar_block      => read_request.number,
      ar_first      => read_request.first,
      ar_length     => read_request.length
      );

  tester : entity work.block_tester
    generic map (
      g_true_colour => g_true_colour,
      g_block_bits  => g_block_bits,
      g_lane_bits   => c_lane_bits,
      g_number_bits => c_number_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk          => clk,
      reset        => reset,
      in_valid     => requested.valid,
      in_ready     => requested.is_taken,
      in_fill      => requested.fill,
      in_mask      => requested.mask,
      in_first     => requested.first,
      in_last      => requested.last,
      in_depth     => requested.depth,
      in_colour    => requested.colour,
      m_axi_rvalid => m_axi_rvalid,
      m_axi_rready => m_axi_rready,
      m_axi_rdata  => m_axi_rdata,
      m_axi_rresp  => m_axi_rresp,
      test_place   => test_place,
      test_depth   => test_depth,
      keep_write   => keep_write,
      keep_place   => keep_place,
      keep_bits    => keep_bits,
      out_valid    => tested.valid,
      out_ready    => tested.is_taken,
      out_any      => tested.kept,
      out_first    => tested.first,
      out_last     => tested.last,
      out_fill     => tested.fill,
      out_depth    => tested.depth,
      out_colour   => tested.colour,
      fault        => read_fault,
      pixels       => pixels
      );

  clear_colour <= colour_of(frame.red, frame.green, frame.blue, g_true_colour);

  writer : entity work.block_writer
    generic map (
      g_true_colour => g_true_colour,
      g_lane_bits   => c_lane_bits,
      g_number_bits => c_number_bits,
      g_beat_bits   => c_beat_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk           => clk,
      reset         => reset,
      clear_colour  => clear_colour,
      in_valid      => tested.valid,
      in_ready      => tested.is_taken,
      in_fill       => tested.fill,
      in_any        => tested.kept,
      in_depth      => tested.depth,
      in_colour     => tested.colour,
      in_first      => tested.first,
      in_last       => tested.last,
      retire        => retire,
      fault         => write_fault,
      place         => write_place,
      keep          => keep,
      depth         => depth,
      colour        => colour,
      m_axi_awvalid => m_axi_awvalid,
      m_axi_awready => m_axi_awready,
      aw_block      => write_request.number,
      aw_first      => write_request.first,
      aw_length     => write_request.length,
      m_axi_wvalid  => m_axi_wvalid,
      m_axi_wready  => m_axi_wready,
      m_axi_wdata   => m_axi_wdata,
      m_axi_wstrb   => m_axi_wstrb,
      m_axi_wlast   => m_axi_wlast,
      m_axi_bvalid  => m_axi_bvalid,
      m_axi_bready  => m_axi_bready,
      m_axi_bresp   => m_axi_bresp
      );

  store : entity work.pixel_store
    generic map (
      g_bits       => c_stored,
      g_lane_bits  => c_lane_bits,
      g_place_bits => memory_place_t'length
      )
    port map (
      clk          => clk,
      pixel_write  => pixel_write,
      pixel_place  => pixel_place,
      pixel_depth  => pixel_depth,
      pixel_colour => pixel_colour,
      test_place   => test_place,
      test_depth   => test_depth,
      keep_write   => keep_write,
      keep_place   => keep_place,
      keep_bits    => keep_bits,
      place        => write_place,
      keep         => keep,
      depth        => depth,
      colour       => colour
      );

  begins <= start and not in_work;

  -- Keep a fault until the next frame.
  faults : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' or begins = '1' then
        fault <= '0';
      elsif cause = '1' or read_fault = '1' or write_fault = '1' then
        fault <= '1';
      end if;
    end if;
  end process;

  m_axi_araddr  <= read_request.number & read_request.first & to_unsigned(0, c_beat_shift);
  m_axi_arlen   <= resize(read_request.length, m_axi_arlen'length);
  m_axi_arsize  <= std_logic_vector(c_size);
  m_axi_arburst <= c_incr;
  m_axi_arcache <= c_bufferable;
  m_axi_arprot  <= (others => '0');
  m_axi_awaddr  <= write_request.number & write_request.first & to_unsigned(0, c_beat_shift);
  m_axi_awlen   <= resize(write_request.length, m_axi_awlen'length);
  m_axi_awsize  <= std_logic_vector(c_size);
  m_axi_awburst <= c_incr;
  m_axi_awcache <= c_bufferable;
  m_axi_awprot  <= (others => '0');
  busy          <= in_work;

end architecture;
