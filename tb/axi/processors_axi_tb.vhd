-- SPDX-License-Identifier: Apache-2.0
-- Without and with shadows, by axi_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.axi_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity processors_axi_run is
  generic (
    g_exact : boolean := true;
    g_channels : positive := 3;
    g_directional : natural := 1;
    g_positional : natural := 0;
    g_spots : natural := 0;
    g_diffuse : boolean := true;
    g_specular : boolean := true;
    g_normalize : boolean := true;
    g_shadows : boolean := false;
    g_unrolled : boolean := true;
    g_limit_bits : positive := 10; -- with shadows a new frame takes 2**12 clocks
    g_stem : string -- start of the file names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of processors_axi_run is
  constant c_config     : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_init_bits  : positive := init_bits(c_config);
  signal aclk          : std_logic;
  signal aresetn       : std_logic;
  signal s_axis_tvalid : std_logic;
  signal s_axis_tready : std_logic;
  signal s_axis_tdata  : std_logic_vector(whole_words(c_init_bits) - 1 downto 0);
  signal s_axis_tlast  : std_logic;
  signal m_axis_tvalid : std_logic;
  signal m_axis_tready : std_logic;
  signal m_axis_tdata  : fragment_data_t;
  signal m_axis_tkeep  : fragment_keep_t;
  signal m_axis_tlast  : std_logic;
  signal fault         : std_logic;
begin
  dut : entity work.processors_axi
    generic map (
      g_exact => g_exact,
      g_channels => g_channels,
      g_directional => g_directional,
      g_positional => g_positional,
      g_spots => g_spots,
      g_diffuse => g_diffuse,
      g_specular => g_specular,
      g_normalize => g_normalize,
      g_shadows => g_shadows,
      g_unrolled => g_unrolled,
      g_limit_bits => g_limit_bits)
    port map (
      aclk          => aclk,
      aresetn       => aresetn,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tready => s_axis_tready,
      s_axis_tdata  => s_axis_tdata,
      s_axis_tlast  => s_axis_tlast,
      m_axis_tvalid => m_axis_tvalid,
      m_axis_tready => m_axis_tready,
      m_axis_tdata  => m_axis_tdata,
      m_axis_tkeep  => m_axis_tkeep,
      m_axis_tlast  => m_axis_tlast,
      fault         => fault);

  checker : entity work.axi_checker
    generic map (
      g_exact      => g_exact,
      g_init_bits  => c_init_bits,
      g_walk_low   => walk_low(c_config),
      g_records    => 0,
      g_timed      => false,
      g_limit_bits => g_limit_bits,
      g_faults     => g_shadows,
      g_stem       => g_stem)
    port map (
      aclk          => aclk,
      aresetn       => aresetn,
      s_axis_tvalid => s_axis_tvalid,
      s_axis_tready => s_axis_tready,
      s_axis_tdata  => s_axis_tdata,
      s_axis_tlast  => s_axis_tlast,
      m_axis_tvalid => m_axis_tvalid,
      m_axis_tready => m_axis_tready,
      m_axis_tdata  => m_axis_tdata,
      m_axis_tkeep  => m_axis_tkeep,
      m_axis_tlast  => m_axis_tlast,
      fault         => fault,
      finished      => finished);
end architecture;

entity processors_axi_tb is
  generic (
    g_folder : string := "processors_axi"
  );
end entity;

architecture sim of processors_axi_tb is
  signal finished : boolean_vector(0 to 1);
begin
  directional : entity work.processors_axi_run
    generic map (g_stem => g_folder & "/directional_")
    port map (finished => finished(0));

  shadows : entity work.processors_axi_run
    generic map (g_positional => 1, g_shadows => true, g_limit_bits => 13, g_stem => g_folder & "/shadows_")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "processors_axi_tb: passed" severity note;
    wait;
  end process;
end architecture;
