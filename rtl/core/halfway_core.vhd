-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     From commands in memory to a picture in memory: registers, the ring of commands, a shader, depth test and
--             pixel writer, wired to one AXI4-Lite port and one AXI4 port:
--
--               s_axi --> core_registers --> ring_control --> words_to_fragments --> fragments_to_memory --> m_axi: AW, W, B
--                                                 |  words          shader                  | depths
--                                             burst_reader --------> read_arbiter <---------+
--                                                                         +--------------------------------> m_axi: AR, R
--
-- Contract    aclk, aresetn: rising edge; synchronous reset, active low, for at least one rising edge. A reset in the
--             middle of a frame forgets what is on its way: reset the memory's port, too. All outputs depend on registers
--             only.
--             s_axi: AXI4-Lite, the registers of docs/rtl/core.md. m_axi: AXI4, one identifier for all reads and one for all
--             writes, so there are no ports for it; INCR bursts of whole words; none crosses 4 KiB. Words of reads come in the
--             order of their requests, and rlast is with the last word of each burst: a simulation stops otherwise.
--             irq: a level, as long as an enabled bit of register interrupts is '1'. picture: address of the picture
--             that was drawn last without a fault by a command with swap.
-- Formats     core_registers_pkg: registers and commands; axi_pkg: packets; memory_pkg: pixels
-- Latency     docs/rtl/core.md
-- Throughput  those of words_to_fragments and fragments_to_memory; reads share the port
-- Error       that of the shader; depth and colour of RGB565 are truncated
-- Source      ours
-- Golden twin that of the shader, and model/golden/frame_memory.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.core_registers_pkg.all;
use work.cosine_pkg.all;
use work.memory_pkg.all;
use work.shader_pkg.all;
use work.stream_pkg.all;

entity halfway_core is
  generic (
    g_shader             : shader_t := quadratic;
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_diffuse            : boolean  := true;       -- spherical, processors
    g_specular           : boolean  := true;       -- spherical, processors
    g_degree             : positive := 2;          -- quadratic
    g_lights             : natural  := 1;          -- spherical, as the next six
    g_highlight_channels : positive := g_channels;
    g_powers             : natural  := 2;
    g_cosine             : cosine_t := default_cosine(g_exact);
    g_multiplier_bits    : natural  := 0;
    g_directional        : natural  := 1;          -- processors, as the next seven
    g_positional         : natural  := 0;
    g_spots              : natural  := 0;
    g_normalize          : boolean  := true;
    g_shadows            : boolean  := false;
    g_unrolled           : boolean  := true;
    g_objects            : natural  := 0;
    g_subpixels          : positive := 1;
    g_bus_bits           : positive := 64;         -- 32 or 64
    g_limit_bits         : positive := default_limit_bits(g_shader); -- of axi_control
    g_true_colour        : boolean  := false;      -- of fragments_to_memory, as the next two
    g_block_bits         : positive := 6;
    g_slot_bits          : positive := 3
  );
  port (
    aclk          : in  std_logic;
    aresetn       : in  std_logic;
    irq           : out std_logic;
    picture       : out address_t;
    s_axi_awvalid : in  std_logic;
    s_axi_awready : out std_logic;
    s_axi_awaddr  : in  unsigned(7 downto 0);
    s_axi_awprot  : in  std_logic_vector(2 downto 0);
    s_axi_wvalid  : in  std_logic;
    s_axi_wready  : out std_logic;
    s_axi_wdata   : in  std_logic_vector(31 downto 0);
    s_axi_wstrb   : in  std_logic_vector(3 downto 0);
    s_axi_bvalid  : out std_logic;
    s_axi_bready  : in  std_logic;
    s_axi_bresp   : out std_logic_vector(1 downto 0);
    s_axi_arvalid : in  std_logic;
    s_axi_arready : out std_logic;
    s_axi_araddr  : in  unsigned(7 downto 0);
    s_axi_arprot  : in  std_logic_vector(2 downto 0);
    s_axi_rvalid  : out std_logic;
    s_axi_rready  : in  std_logic;
    s_axi_rdata   : out std_logic_vector(31 downto 0);
    s_axi_rresp   : out std_logic_vector(1 downto 0);
    m_axi_arvalid : out std_logic;
    m_axi_arready : in  std_logic;
    m_axi_araddr  : out address_t;
    m_axi_arlen   : out unsigned(7 downto 0);
    m_axi_arsize  : out std_logic_vector(2 downto 0);
    m_axi_arburst : out std_logic_vector(1 downto 0);
    m_axi_arcache : out std_logic_vector(3 downto 0);
    m_axi_arprot  : out std_logic_vector(2 downto 0);
    m_axi_rvalid  : in  std_logic;
    m_axi_rready  : out std_logic;
    m_axi_rdata   : in  std_logic_vector(g_bus_bits - 1 downto 0);
    m_axi_rresp   : in  std_logic_vector(1 downto 0);
    m_axi_rlast   : in  std_logic;
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
    m_axi_wdata   : out std_logic_vector(g_bus_bits - 1 downto 0);
    m_axi_wstrb   : out std_logic_vector(bytes(g_bus_bits) - 1 downto 0);
    m_axi_wlast   : out std_logic;
    m_axi_bvalid  : in  std_logic;
    m_axi_bready  : out std_logic;
    m_axi_bresp   : in  std_logic_vector(1 downto 0)
  );
end entity;

architecture rtl of halfway_core is

  subtype word_t is std_logic_vector(31 downto 0);

  function field (number, low : natural) return word_t is
  begin
    return std_logic_vector(shift_left(to_unsigned(number, word_t'length), low)); -- evaluated at elaboration
  end function;

  constant c_block_shift : positive := g_block_bits + log2(pixel_bytes(g_true_colour)); -- of a block's bytes

  -- Registers that do not change.
  constant c_shader : word_t := field(shader_t'pos(g_shader), c_shader_kind_low)
    or field(boolean'pos(g_exact), c_shader_exact_low) or field(g_channels, c_shader_channels_low)
    or field(boolean'pos(g_diffuse), c_shader_diffuse_low) or field(boolean'pos(g_specular), c_shader_specular_low)
    or field(g_degree, c_shader_degree_low) or field(g_highlight_channels, c_shader_highlight_channels_low)
    or field(boolean'pos(g_normalize), c_shader_normalize_low) or field(boolean'pos(g_shadows), c_shader_shadows_low)
    or field(boolean'pos(g_unrolled), c_shader_unrolled_low)
    or field(address_bits(g_cosine), c_shader_table_address_bits_low) or field(data_bits(g_cosine), c_shader_table_data_bits_low);
  constant c_lights : word_t := field(g_lights, c_lights_lights_low) or field(g_directional, c_lights_directional_low)
    or field(g_positional, c_lights_positional_low) or field(g_spots, c_lights_spots_low);
  constant c_objects : word_t := field(g_objects, c_objects_objects_low) or field(g_subpixels, c_objects_subpixels_low)
    or field(g_powers, c_objects_powers_low);
  constant c_memory : word_t := field(boolean'pos(g_true_colour), c_memory_true_colour_low)
    or field(g_block_bits, c_memory_block_bits_low) or field(g_slot_bits, c_memory_slot_bits_low)
    or field(g_bus_bits, c_memory_data_bits_low);

  signal reset : std_logic;

  -- register_port
  signal register_write           : std_logic;
  signal write_address            : unsigned(5 downto 0);
  signal write_data, read_data    : std_logic_vector(31 downto 0);
  signal write_strobes            : std_logic_vector(3 downto 0);
  signal read_register            : unsigned(5 downto 0);
  signal write_error, read_error  : std_logic;

  -- core_registers and ring_control
  signal enable, abort        : std_logic;
  signal ring_base            : address_t;
  signal ring_size            : unsigned(3 downto 0);
  signal ring_head, ring_tail : unsigned(31 downto 0);
  signal busy, command_done   : std_logic;
  signal faults               : std_logic_vector(7 downto 0);
  signal swap                 : std_logic;

  -- burst_reader
  signal read_start, read_stop  : std_logic;
  signal read_address           : address_t;
  signal read_count             : unsigned(28 downto 0);
  signal read_busy, read_fault  : std_logic;
  signal words_arvalid          : std_logic;
  signal words_arready          : std_logic;
  signal words_araddr           : address_t;
  signal words_arlen            : unsigned(7 downto 0);
  signal words_rvalid           : std_logic;
  signal words_valid            : std_logic;
  signal words_ready            : std_logic;
  signal words_data             : std_logic_vector(g_bus_bits - 1 downto 0);
  signal words_last             : std_logic;

  -- words_to_fragments
  signal shader_reset, shader_resetn : std_logic;
  signal packet_valid, packet_ready  : std_logic;
  signal packet_data                 : std_logic_vector(g_bus_bits - 1 downto 0);
  signal packet_last                 : std_logic;
  signal fragment_valid              : std_logic;
  signal fragment                    : fragment_data_t;
  signal fragment_keep               : fragment_keep_t;
  signal fragment_last               : std_logic;
  signal cause                       : cause_t;
  signal triangle, fragment_taken    : std_logic;
  signal stalled                     : std_logic;

  -- fragments_to_memory
  signal frame                    : frame_t;
  signal frame_start, frame_done  : std_logic;
  signal memory_fault             : std_logic;
  signal passes, force_last       : std_logic;
  signal memory_valid             : std_logic;
  signal memory_ready             : std_logic;
  signal memory_data              : fragment_data_t;
  signal memory_keep              : fragment_keep_t;
  signal memory_last              : std_logic;
  signal last_taken               : std_logic;
  signal pixels                   : pixel_count_t;
  signal depth_arvalid            : std_logic;
  signal depth_arready            : std_logic;
  signal depth_araddr             : address_t;
  signal depth_arlen              : unsigned(7 downto 0);
  signal depth_rvalid             : std_logic;
  signal depth_rready             : std_logic;

begin

  reset         <= not aresetn;
  shader_resetn <= aresetn and not shader_reset;

  -- Report a broken contract in the user's simulation.
  check_reads : process (aclk)
    variable waiting                       : std_logic_vector(m_axi_rdata'length + m_axi_rresp'length + 1 downto 0);
    variable words_missing, bursts_missing : natural;
  begin
    if rising_edge(aclk) then
      check_stream("halfway_core: m_axi_r", reset, m_axi_rready,
        m_axi_rvalid & m_axi_rlast & m_axi_rresp & m_axi_rdata, waiting);
      check_answers("halfway_core: m_axi_r", reset, m_axi_arvalid and m_axi_arready, m_axi_arlen,
        m_axi_rvalid, m_axi_rvalid and m_axi_rready, words_missing);
      check_answers("halfway_core: m_axi_rlast", reset, m_axi_arvalid and m_axi_arready, "0",
        m_axi_rvalid and m_axi_rlast, m_axi_rvalid and m_axi_rready and m_axi_rlast, bursts_missing);
      assert (words_missing = 0) = (bursts_missing = 0)
        report "halfway_core: m_axi_rlast: not with the last word of a burst"
        severity failure;
    end if;
  end process;

  registers_port : entity work.register_port
    port map (
      clk           => aclk,
      reset         => reset,
      s_axi_awvalid => s_axi_awvalid,
      s_axi_awready => s_axi_awready,
      s_axi_awaddr  => s_axi_awaddr,
      s_axi_wvalid  => s_axi_wvalid,
      s_axi_wready  => s_axi_wready,
      s_axi_wdata   => s_axi_wdata,
      s_axi_wstrb   => s_axi_wstrb,
      s_axi_bvalid  => s_axi_bvalid,
      s_axi_bready  => s_axi_bready,
      s_axi_bresp   => s_axi_bresp,
      s_axi_arvalid => s_axi_arvalid,
      s_axi_arready => s_axi_arready,
      s_axi_araddr  => s_axi_araddr,
      s_axi_rvalid  => s_axi_rvalid,
      s_axi_rready  => s_axi_rready,
      s_axi_rdata   => s_axi_rdata,
      s_axi_rresp   => s_axi_rresp,
      write         => register_write,
      write_address => write_address,
      write_data    => write_data,
      write_strobes => write_strobes,
      write_error   => write_error,
      read          => open,
      read_address  => read_register,
      read_data     => read_data,
      read_error    => read_error
      );

  registers : entity work.core_registers
    generic map (
      g_shader  => c_shader,
      g_lights  => c_lights,
      g_objects => c_objects,
      g_memory  => c_memory
      )
    port map (
      clk            => aclk,
      reset          => reset,
      write          => register_write,
      write_address  => write_address,
      write_data     => write_data,
      write_strobes  => write_strobes,
      write_error    => write_error,
      read_address   => read_register,
      read_data      => read_data,
      read_error     => read_error,
      enable         => enable,
      abort          => abort,
      ring_base      => ring_base,
      ring_size      => ring_size,
      ring_head      => ring_head,
      ring_tail      => ring_tail,
      busy           => busy,
      command_done   => command_done,
      command_faults => faults,
      swap           => swap,
      picture_base   => frame.colour_base,
      picture        => picture,
      triangle       => triangle,
      fragment       => fragment_taken,
      pixels         => pixels,
      stalled        => stalled,
      interrupt      => irq
      );

  control : entity work.ring_control
    generic map (
      g_data_bits   => g_bus_bits,
      g_block_shift => c_block_shift
      )
    port map (
      clk          => aclk,
      reset        => reset,
      enable       => enable,
      abort        => abort,
      ring_base    => ring_base,
      ring_size    => ring_size,
      ring_head    => ring_head,
      ring_tail    => ring_tail,
      busy         => busy,
      command_done => command_done,
      faults       => faults,
      swap         => swap,
      read_start   => read_start,
      read_address => read_address,
      read_count   => read_count,
      read_stop    => read_stop,
      read_busy    => read_busy,
      read_fault   => read_fault,
      words_valid  => words_valid,
      words_ready  => words_ready,
      words_data   => words_data,
      words_last   => words_last,
      shader_reset => shader_reset,
      packet_valid => packet_valid,
      packet_ready => packet_ready,
      packet_data  => packet_data,
      packet_last  => packet_last,
      stalled      => stalled,
      last_taken   => last_taken,
      cause        => cause,
      passes       => passes,
      force_last   => force_last,
      frame        => frame,
      frame_start  => frame_start,
      frame_done   => frame_done,
      memory_fault => memory_fault
      );

  reader : entity work.burst_reader
    generic map (
      g_data_bits => g_bus_bits
      )
    port map (
      clk           => aclk,
      reset         => reset,
      start         => read_start,
      address       => read_address,
      count         => read_count,
      stop          => read_stop,
      busy          => read_busy,
      fault         => read_fault,
      m_axi_arvalid => words_arvalid,
      m_axi_arready => words_arready,
      m_axi_araddr  => words_araddr,
      m_axi_arlen   => words_arlen,
      m_axi_rvalid  => words_rvalid,
      m_axi_rdata   => m_axi_rdata,
      m_axi_rresp   => m_axi_rresp,
      out_valid     => words_valid,
      out_ready     => words_ready,
      out_data      => words_data,
      out_last      => words_last
      );

  shader : entity work.words_to_fragments
    generic map (
      g_shader             => g_shader,
      g_exact              => g_exact,
      g_channels           => g_channels,
      g_diffuse            => g_diffuse,
      g_specular           => g_specular,
      g_degree             => g_degree,
      g_lights             => g_lights,
      g_highlight_channels => g_highlight_channels,
      g_powers             => g_powers,
      g_cosine             => g_cosine,
      g_multiplier_bits    => g_multiplier_bits,
      g_directional        => g_directional,
      g_positional         => g_positional,
      g_spots              => g_spots,
      g_normalize          => g_normalize,
      g_shadows            => g_shadows,
      g_unrolled           => g_unrolled,
      g_objects            => g_objects,
      g_subpixels          => g_subpixels,
      g_bus_bits           => g_bus_bits,
      g_limit_bits         => g_limit_bits
      )
    port map (
      aclk          => aclk,
      aresetn       => shader_resetn,
      s_axis_tvalid => packet_valid,
      s_axis_tready => packet_ready,
      s_axis_tdata  => packet_data,
      s_axis_tlast  => packet_last,
      triangle      => triangle,
      m_axis_tvalid => fragment_valid,
      m_axis_tready => memory_ready,
      m_axis_tdata  => fragment,
      m_axis_tkeep  => fragment_keep,
      m_axis_tlast  => fragment_last,
      m_axis_tuser  => cause
      );

    -- End a frame without the shader: a last transfer without a fragment.
  memory_valid <= (fragment_valid and passes) or force_last;
  memory_last  <= fragment_last or force_last;
  memory_data  <= fragment when force_last = '0' else (others => '0');
  memory_keep  <= fragment_keep when force_last = '0' else (others => '0');
  last_taken   <= memory_valid and memory_ready and memory_last;

  fragment_taken <= fragment_valid and memory_ready and fragment_keep(0) and not force_last;
  stalled        <= fragment_valid and passes and not memory_ready and not force_last;

  writer : entity work.fragments_to_memory
    generic map (
      g_true_colour => g_true_colour,
      g_data_bits   => g_bus_bits,
      g_block_bits  => g_block_bits,
      g_slot_bits   => g_slot_bits
      )
    port map (
      clk           => aclk,
      reset         => reset,
      frame         => frame,
      start         => frame_start,
      busy          => open,
      done          => frame_done,
      fault         => memory_fault,
      pixels        => pixels,
      s_axis_tvalid => memory_valid,
      s_axis_tready => memory_ready,
      s_axis_tdata  => memory_data,
      s_axis_tkeep  => memory_keep,
      s_axis_tlast  => memory_last,
      s_axis_tuser  => c_no_fault,
      m_axi_arvalid => depth_arvalid,
      m_axi_arready => depth_arready,
      m_axi_araddr  => depth_araddr,
      m_axi_arlen   => depth_arlen,
      m_axi_arsize  => m_axi_arsize,
      m_axi_arburst => m_axi_arburst,
      m_axi_arcache => m_axi_arcache,
      m_axi_arprot  => m_axi_arprot,
      m_axi_rvalid  => depth_rvalid,
      m_axi_rready  => depth_rready,
      m_axi_rdata   => m_axi_rdata,
      m_axi_rresp   => m_axi_rresp,
      m_axi_awvalid => m_axi_awvalid,
      m_axi_awready => m_axi_awready,
      m_axi_awaddr  => m_axi_awaddr,
      m_axi_awlen   => m_axi_awlen,
      m_axi_awsize  => m_axi_awsize,
      m_axi_awburst => m_axi_awburst,
      m_axi_awcache => m_axi_awcache,
      m_axi_awprot  => m_axi_awprot,
      m_axi_wvalid  => m_axi_wvalid,
      m_axi_wready  => m_axi_wready,
      m_axi_wdata   => m_axi_wdata,
      m_axi_wstrb   => m_axi_wstrb,
      m_axi_wlast   => m_axi_wlast,
      m_axi_bvalid  => m_axi_bvalid,
      m_axi_bready  => m_axi_bready,
      m_axi_bresp   => m_axi_bresp
      );

  reads : entity work.read_arbiter
    port map (
      clk           => aclk,
      reset         => reset,
      a_arvalid     => depth_arvalid,
      a_arready     => depth_arready,
      a_araddr      => depth_araddr,
      a_arlen       => depth_arlen,
      a_rvalid      => depth_rvalid,
      a_rready      => depth_rready,
      b_arvalid     => words_arvalid,
      b_arready     => words_arready,
      b_araddr      => words_araddr,
      b_arlen       => words_arlen,
      b_rvalid      => words_rvalid,
      m_axi_arvalid => m_axi_arvalid,
      m_axi_arready => m_axi_arready,
      m_axi_araddr  => m_axi_araddr,
      m_axi_arlen   => m_axi_arlen,
      m_axi_rvalid  => m_axi_rvalid,
      m_axi_rready  => m_axi_rready,
      m_axi_rlast   => m_axi_rlast
      );

end architecture;
