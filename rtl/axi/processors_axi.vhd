-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The processors shader with AXI4-Stream ports.
-- Contract    aclk, aresetn: rising edge; synchronous reset, active low, for at least one rising edge. No output depends
--             on an input in the same clock.
--             s_axis: one init vector per transfer, in the order of the host's set-up.
--             m_axis, fault: one fragment per transfer, as in axi_adapter.
--             The frame after a fault is drawn if it begins with new_frame and defines all lights: the fault has
--             deleted them.
-- Formats     axi_pkg: 32-bit words of an init vector, the fields of a fragment; formats_pkg
-- Latency     that of processors_shader and 2 clocks, if another fragment follows
-- Throughput  that of processors_shader within a frame. Between frames the pipeline becomes empty: see axi_control
-- Error       that of processors_shader
-- Source      ours: AMBA 4 AXI4-Stream
-- Golden twin that of processors_shader

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.axi_pkg.all;
use work.processors_pkg.all;

entity processors_axi is
  generic (
    g_exact       : boolean := true;
    g_channels    : positive := 3;
    g_directional : natural := 1;
    g_positional  : natural := 0;
    g_spots       : natural := 0;
    g_diffuse     : boolean := true;
    g_specular    : boolean := true;
    g_normalize   : boolean := true;
    g_shadows     : boolean := false;
    g_unrolled    : boolean := true;
    g_objects     : natural := 0;
    g_subpixels   : positive := 1;
    g_limit_bits  : positive := 31 -- of axi_control; folded processors take several clocks per fragment
  );
  port (
    aclk          : in  std_logic;
    aresetn       : in  std_logic;
    s_axis_tvalid : in  std_logic;
    s_axis_tready : out std_logic;
    s_axis_tdata  : in  std_logic_vector(whole_words(init_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows))) - 1 downto 0);
    s_axis_tlast  : in  std_logic;
    m_axis_tvalid : out std_logic;
    m_axis_tready : in  std_logic;
    m_axis_tdata  : out fragment_data_t;
    m_axis_tkeep  : out fragment_keep_t;
    m_axis_tlast  : out std_logic;
    fault         : out std_logic
  );
end entity;

architecture rtl of processors_axi is

  constant c_formats   : formats_t := formats(g_exact);
  constant c_init_bits : positive  := init_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
    g_diffuse, g_specular, g_normalize, g_shadows));

  signal reset                          : std_logic;
  signal init_valid, init_ready         : std_logic;
  signal fragment_valid, fragment_ready : std_logic;
  signal triangle                       : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal y                              : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal x                              : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
  signal z                              : std_logic_vector(c_formats.depth.bits - 1 downto 0);
  signal red, green, blue               : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment                       : fragment_data_t;
  signal busy                           : std_logic;
  signal shader_fault, shader_reset     : std_logic;

begin

  reset <= not aresetn;

  core : entity work.processors_shader
    generic map (
      g_exact       => g_exact,
      g_channels    => g_channels,
      g_directional => g_directional,
      g_positional  => g_positional,
      g_spots       => g_spots,
      g_diffuse     => g_diffuse,
      g_specular    => g_specular,
      g_normalize   => g_normalize,
      g_shadows     => g_shadows,
      g_unrolled    => g_unrolled,
      g_objects     => g_objects,
      g_subpixels   => g_subpixels
      )
    port map (
      clk               => aclk,
      reset             => shader_reset,
      init_valid        => init_valid,
      init_ready        => init_ready,
      init_data         => s_axis_tdata(c_init_bits - 1 downto 0),
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => triangle,
      fragment_y        => y,
      fragment_x        => x,
      fragment_z        => z,
      fragment_red      => red,
      fragment_green    => green,
      fragment_blue     => blue,
      busy              => busy,
      fault             => shader_fault
      );

  fragment <= fragment_data(triangle, y, x, z, red, green, blue);

  adapter : entity work.axi_adapter
    generic map (
      g_limit_bits => g_limit_bits
      )
    port map (
      clk            => aclk,
      reset          => reset,
      s_axis_tvalid  => s_axis_tvalid,
      s_axis_tready  => s_axis_tready,
      s_axis_tlast   => s_axis_tlast,
      init_valid     => init_valid,
      init_ready     => init_ready,
      fragment_valid => fragment_valid,
      fragment_ready => fragment_ready,
      fragment       => fragment,
      busy           => busy,
      shader_fault   => shader_fault,
      shader_reset   => shader_reset,
      m_axis_tvalid  => m_axis_tvalid,
      m_axis_tready  => m_axis_tready,
      m_axis_tdata   => m_axis_tdata,
      m_axis_tkeep   => m_axis_tkeep,
      m_axis_tlast   => m_axis_tlast,
      fault          => fault
      );

end architecture;
