-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A shader with AXI4-Stream ports: words of packets in, fragments out.
-- Contract    aclk, aresetn: rising edge; synchronous reset, active low, for at least one rising edge. All outputs depend
--             on registers only.
--             s_axis: the packets of frames; those of a frame are in the order of the host's set-up. A word that waits
--             does not change (a simulation stops otherwise).
--             triangle = '1': in this clock the shader takes a packet of kind 1: counters, outside, count triangles.
--             m_axis: one fragment per transfer, as in axi_adapter.
--             g_shader selects the shader, which has its generics. The others are not used.
--             After a fault the processors have no light: the next frame is drawn if it begins with new_frame and defines
--             all lights.
-- Formats     axi_pkg: packets, the fields of a fragment, causes; formats_pkg
-- Latency     from a packet's last word to its vector's first fragment: that of the shader and 4 clocks, if another
--             fragment follows
-- Throughput  those of the shader and of packet_reader within a frame. Between frames the pipeline becomes empty: see
--             axi_control
-- Error       that of the shader
-- Source      ours: AMBA 4 AXI4-Stream
-- Golden twin that of the shader; model/golden_run/packets.hpp writes its packets

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.axi_pkg.all;
use work.cosine_pkg.all;
use work.shader_pkg.all;
use work.stream_pkg.all;

entity words_to_fragments is
  generic (
    g_shader             : shader_t := quadratic;
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_diffuse            : boolean  := true;       -- spherical, processors
    g_specular           : boolean  := true;       -- spherical, processors
    g_degree             : positive := 2;          -- quadratic
    g_lights             : natural  := 1;          -- spherical, as the next four
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
    g_bus_bits           : positive := 32;         -- 32 or 64
    g_limit_bits         : positive := default_limit_bits(g_shader) -- of axi_control
  );
  port (
    aclk          : in  std_logic;
    aresetn       : in  std_logic;
    s_axis_tvalid : in  std_logic;
    s_axis_tready : out std_logic;
    s_axis_tdata  : in  std_logic_vector(g_bus_bits - 1 downto 0);
    s_axis_tlast  : in  std_logic;
    triangle      : out std_logic;
    m_axis_tvalid : out std_logic;
    m_axis_tready : in  std_logic;
    m_axis_tdata  : out fragment_data_t;
    m_axis_tkeep  : out fragment_keep_t;
    m_axis_tlast  : out std_logic;
    m_axis_tuser  : out cause_t
  );
end entity;

architecture rtl of words_to_fragments is

  constant c_formats : formats_t := formats(g_exact);

  constant c_vector : vector_sizes_t := vector_sizes((
    shader => g_shader, exact => g_exact, channels => g_channels, diffuse => g_diffuse, specular => g_specular,
    degree => g_degree, lights => g_lights, highlight_channels => g_highlight_channels, directional => g_directional,
    positional => g_positional, spots => g_spots, normalize => g_normalize, shadows => g_shadows, objects => g_objects
    ));

  signal reset                          : std_logic;
  signal init_valid, init_ready         : std_logic;
  signal init_data                      : std_logic_vector(c_vector.bits - 1 downto 0);
  signal fragment_valid, fragment_ready : std_logic;
  signal number                         : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal y                              : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal x                              : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
  signal z                              : std_logic_vector(c_formats.depth.bits - 1 downto 0);
  signal red, green, blue               : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment                       : fragment_data_t;
  signal busy                           : std_logic;
  signal shader_fault, shader_reset     : std_logic;

begin

  reset <= not aresetn;

  -- Report a broken contract in the user's simulation.
  check_words : process (aclk)
    variable waiting : std_logic_vector(g_bus_bits + 1 downto 0);
  begin
    if rising_edge(aclk) then
      check_stream("words_to_fragments: s_axis", reset, s_axis_tready,
        s_axis_tvalid & s_axis_tlast & s_axis_tdata, waiting);
    end if;
  end process;

  quadratic_core : if g_shader = quadratic generate

    core : entity work.quadratic_shader
      generic map (
        g_exact    => g_exact,
        g_channels => g_channels,
        g_degree   => g_degree
        )
      port map (
        clk               => aclk,
        reset             => shader_reset,
        init_valid        => init_valid,
        init_ready        => init_ready,
        init_data         => init_data,
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => number,
        fragment_y        => y,
        fragment_x        => x,
        fragment_z        => z,
        fragment_red      => red,
        fragment_green    => green,
        fragment_blue     => blue,
        busy              => busy,
        fault             => shader_fault
        );

  end generate;

  spherical_core : if g_shader = spherical generate

    core : entity work.spherical_shader
      generic map (
        g_exact              => g_exact,
        g_channels           => g_channels,
        g_lights             => g_lights,
        g_diffuse            => g_diffuse,
        g_specular           => g_specular,
        g_highlight_channels => g_highlight_channels,
        g_powers             => g_powers,
        g_cosine             => g_cosine,
        g_multiplier_bits    => g_multiplier_bits
        )
      port map (
        clk               => aclk,
        reset             => shader_reset,
        init_valid        => init_valid,
        init_ready        => init_ready,
        init_data         => init_data,
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => number,
        fragment_y        => y,
        fragment_x        => x,
        fragment_z        => z,
        fragment_red      => red,
        fragment_green    => green,
        fragment_blue     => blue,
        busy              => busy,
        fault             => shader_fault
        );

  end generate;

  processors_core : if g_shader = processors generate

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
        init_data         => init_data,
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => number,
        fragment_y        => y,
        fragment_x        => x,
        fragment_z        => z,
        fragment_red      => red,
        fragment_green    => green,
        fragment_blue     => blue,
        busy              => busy,
        fault             => shader_fault
        );

  end generate;

  fragment <= fragment_data(number, y, x, z, red, green, blue);

  adapter : entity work.axi_adapter
    generic map (
      g_init_bits  => c_vector.bits,
      g_lengths    => c_vector.lengths,
      g_bus_bits   => g_bus_bits,
      g_limit_bits => g_limit_bits
      )
    port map (
      clk            => aclk,
      reset          => reset,
      s_axis_tvalid  => s_axis_tvalid,
      s_axis_tready  => s_axis_tready,
      s_axis_tdata   => s_axis_tdata,
      s_axis_tlast   => s_axis_tlast,
      triangle       => triangle,
      init_valid     => init_valid,
      init_ready     => init_ready,
      init_data      => init_data,
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
      m_axis_tuser   => m_axis_tuser
      );

end architecture;
