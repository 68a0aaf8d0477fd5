-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     AXI4-Stream ports around a shader: axi_control at its input, axi_output at its output.
-- Contract    reset: synchronous, for at least one rising edge. No output depends on an input in the same clock, except
--             that s_axis_tready depends on init_ready, and init_valid on s_axis_tvalid.
--             s_axis: one init vector per transfer. Its data go to the shader directly. tlast = '1' marks the last vector
--             of a frame.
--             init, fragment, busy, shader_fault, shader_reset: the shader's ports, as axi_control describes them.
--             m_axis: one fragment per transfer. tlast = '1' marks the frame's last fragment: each tlast of s_axis has one
--             of m_axis. The fragment before it waits until the next fragment or the frame's end is known. tkeep is all
--             ones, except in a frame without fragments: it has one transfer with tlast = '1' and tkeep all zeros.
--             fault = '1' in the transfer with tlast: the frame is faulty (axi_control), some of its fragments are
--             missing or wrong. The next frame is drawn. In other transfers fault = '0'.
-- Formats     axi_pkg: the fields of a fragment
-- Latency     0 from s_axis to init; 2 clocks from a fragment to m_axis if the next one follows at once
-- Throughput  1 vector and 1 fragment per clock within a frame. Between frames the shader becomes empty: see axi_control
-- Error       none: fragments are passed unchanged, in order
-- Source      ours: AMBA 4 AXI4-Stream
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use work.axi_pkg.all;

entity axi_adapter is
  generic (
    g_limit_bits : positive := 26 -- of axi_control
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    s_axis_tvalid  : in  std_logic;
    s_axis_tready  : out std_logic;
    s_axis_tlast   : in  std_logic;
    init_valid     : out std_logic;
    init_ready     : in  std_logic;
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
    fault          : out std_logic
  );
end entity;

architecture rtl of axi_adapter is

  signal output_ready              : std_logic;
  signal stalled                   : std_logic;
  signal frame_end, done, is_empty : std_logic;
  signal frame_fault, is_last      : std_logic;

begin

  control : entity work.axi_control
    generic map (
      g_limit_bits => g_limit_bits
      )
    port map (
      clk          => clk,
      reset        => reset,
      in_valid     => s_axis_tvalid,
      in_ready     => s_axis_tready,
      in_last      => s_axis_tlast,
      init_valid   => init_valid,
      init_ready   => init_ready,
      busy         => busy,
      stalled      => stalled,
      shader_fault => shader_fault,
      shader_reset => shader_reset,
      frame_end    => frame_end,
      done         => done,
      fault        => frame_fault
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

  m_axis_tkeep <= (others => not is_empty);
  m_axis_tlast <= is_last;
  fault        <= frame_fault and is_last;

end architecture;
