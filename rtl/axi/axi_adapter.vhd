-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     AXI4-Stream ports around a shader: packet_reader and axi_control at its input, axi_output at its output.
-- Contract    reset: synchronous, for at least one rising edge. All outputs depend on
--             registers only.
--             s_axis: words of packets, as packet_reader describes them. A packet without a vector ends the frame.
--             triangle = '1': in this clock the shader takes a packet of kind 1.
--             init, fragment, busy, shader_fault, shader_reset: the shader's ports, as axi_control describes them.
--             m_axis: one fragment per transfer. tlast = '1' marks the frame's last fragment: each end of a frame at
--             s_axis has one tlast of m_axis. The fragment before it waits until the next fragment or the frame's end is
--             known. tkeep is all ones, except in a frame without fragments: it has one transfer with tlast = '1' and
--             tkeep all zeros. tuser in the transfer with tlast is the cause of the frame's first fault: some of its
--             fragments are missing or wrong. The next frame is drawn. In other transfers, and without a fault, tuser is
--             zero.
-- Formats     axi_pkg: packets, the fields of a fragment, causes
-- Latency     2 clocks from a packet's last word to init; 2 clocks from a fragment to m_axis if the next one follows at once
-- Throughput  that of packet_reader, and 1 fragment per clock, within a frame. Between frames the shader becomes empty:
--             see axi_control
-- Error       none: fragments are passed unchanged, in order
-- Source      ours: AMBA 4 AXI4-Stream
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.line_pkg.flag;

entity axi_adapter is
  generic (
    g_init_bits  : positive         := 32;
    g_lengths    : packet_lengths_t := (others => 1);
    g_bus_bits   : positive         := 32;
    g_limit_bits : positive         := 26 -- of axi_control
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    s_axis_tvalid  : in  std_logic;
    s_axis_tready  : out std_logic;
    s_axis_tdata   : in  std_logic_vector(g_bus_bits - 1 downto 0);
    s_axis_tlast   : in  std_logic;
    triangle       : out std_logic;
    init_valid     : out std_logic;
    init_ready     : in  std_logic;
    init_data      : out std_logic_vector(g_init_bits - 1 downto 0);
    fragment_valid : in  std_logic;
    fragment_ready : out std_logic;
    fragment       : in  fragment_data_t;
    busy           : in  std_logic;
    shader_fault   : in  std_logic;
    shader_reset   : out std_logic;
    m_axis_tvalid  : out std_logic;
    m_axis_tready  : in  std_logic;
    m_axis_tdata   : out fragment_data_t;
    m_axis_tkeep   : out fragment_keep_t;
    m_axis_tlast   : out std_logic;
    m_axis_tuser   : out cause_t
  );
end entity;

architecture rtl of axi_adapter is

  signal output_ready              : std_logic;
  signal stalled                   : std_logic;
  signal frame_end, done, is_empty : std_logic;
  signal is_last                   : std_logic;
  signal item_valid, item_ready    : std_logic;
  signal item_end                  : std_logic;
  signal item_kind                 : unsigned(15 downto 0);
  signal item_cause, frame_cause   : cause_t;

begin

  packets : entity work.packet_reader
    generic map (
      g_bits     => g_init_bits,
      g_lengths  => g_lengths,
      g_bus_bits => g_bus_bits
      )
    port map (
      clk        => clk,
      reset      => reset,
      in_valid   => s_axis_tvalid,
      in_ready   => s_axis_tready,
      in_data    => s_axis_tdata,
      in_last    => s_axis_tlast,
      out_valid  => item_valid,
      out_ready  => item_ready,
      out_end    => item_end,
      out_kind   => item_kind,
      out_cause  => item_cause,
      out_vector => init_data
      );

  control : entity work.axi_control
    generic map (
      g_limit_bits => g_limit_bits
      )
    port map (
      clk          => clk,
      reset        => reset,
      in_valid     => item_valid,
      in_ready     => item_ready,
      in_end       => item_end,
      in_cause     => item_cause,
      init_valid   => init_valid,
      init_ready   => init_ready,
      busy         => busy,
      stalled      => stalled,
      shader_fault => shader_fault,
      shader_reset => shader_reset,
      frame_end    => frame_end,
      done         => done,
      cause        => frame_cause
      );

  stalled        <= fragment_valid and not output_ready;
  fragment_ready <= output_ready;

  fragments : entity work.axi_output
    generic map (
      g_bits => c_fragment_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => fragment_valid,
      in_ready  => output_ready,
      in_data   => fragment,
      frame_end => frame_end,
      out_valid => m_axis_tvalid,
      out_ready => m_axis_tready,
      out_data  => m_axis_tdata,
      out_last  => is_last,
      out_empty => is_empty,
      done      => done
      );

  triangle     <= init_valid and init_ready and flag(item_kind = c_triangle_packet);
  m_axis_tkeep <= (others => not is_empty);
  m_axis_tlast <= is_last;
  m_axis_tuser <= frame_cause when is_last = '1' else c_no_fault;

end architecture;
