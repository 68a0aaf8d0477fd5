-- SPDX-License-Identifier: Apache-2.0
-- Colour and grey planes in preset exact, by axi_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.axi_pkg.all;
use work.quadratic_pkg.all;
use work.tb_pkg.all;

entity quadratic_axi_run is
  generic (
    g_exact : boolean := true;
    g_channels : positive := 3;
    g_degree : positive := 2;
    g_stem : string -- start of the file names
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of quadratic_axi_run is
  constant c_init_bits  : positive := init_bits(g_exact, g_degree, g_channels);
  constant c_limit_bits : positive := 13;

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
  dut : entity work.quadratic_axi
    generic map (
      g_exact => g_exact,
      g_channels => g_channels,
      g_degree => g_degree,
      g_limit_bits => c_limit_bits)
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
      g_walk_low   => 0,
      g_records    => 0,
      g_timed      => true,
      g_limit_bits => c_limit_bits,
      g_faults     => false,
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

entity quadratic_axi_tb is
  generic (
    g_folder : string := "quadratic_axi"
  );
end entity;

architecture sim of quadratic_axi_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact_colour : entity work.quadratic_axi_run
    generic map (g_stem => g_folder & "/exact3_")
    port map (finished => finished(0));

  exact_grey_planes : entity work.quadratic_axi_run
    generic map (g_channels => 1, g_degree => 1, g_stem => g_folder & "/exact1_planes_")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "quadratic_axi_tb: passed" severity note;
    wait;
  end process;
end architecture;
