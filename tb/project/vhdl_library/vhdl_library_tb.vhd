-- SPDX-License-Identifier: Apache-2.0
-- A user's design that takes a top from the library halfway. It offers words of zeros with pauses, and some wait.
-- g_fault: take a word that waits back ("valid"), or change it ("data"); change the frame that is drawn ("frame"); answer
-- without a request, or request an address inside a word ("wrong"): the top must stop the simulation.
library ieee, halfway;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use halfway.axi_pkg.all;
use halfway.memory_pkg.all;

entity vhdl_library_tb is
  generic (
    g_top   : string;
    g_fault : string
  );
end entity;

architecture sim of vhdl_library_tb is

  constant c_last_clock : positive := 200;

  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal valid     : std_logic := '0';
  signal bit_value : std_logic := '0'; -- of all bits that g_fault changes
  signal ready     : std_logic;
  signal wrong     : std_logic;
  signal clocks    : natural   := 0;
  signal taken     : natural   := 0; -- words
  signal waited    : boolean   := false;
  signal frames    : natural   := 0;

begin

  clk   <= not clk after 5 ns when clocks < c_last_clock;
  reset <= '0' when clocks > 3;

  wrong <= '1' when g_fault = "wrong" and clocks > 50 else '0';

  offer : process (clk)
  begin
    if rising_edge(clk) then
      clocks <= clocks + 1;
      valid  <= not reset;
      if valid = '1' and ready = '1' then
        taken <= taken + 1;
        if clocks mod 4 = 0 then
          valid <= '0';
        end if;
      elsif valid = '1' then
        waited <= true;
        if g_fault = "valid" then
          valid <= '0';
        elsif g_fault = "data" then
          bit_value <= not bit_value;
        end if;
      end if;
    end if;
  end process;

  finish : process is
  begin
    wait until clocks = c_last_clock;
    assert waited and (frames > 0 or g_top /= "words_to_fragments")
      report "vhdl_library_tb: no word waits, or no frame ends"
      severity failure;
    report "vhdl_library_tb: " & integer'image(taken) & " words, " & integer'image(frames) & " frames";
    wait;
  end process;

  -- A packet of zeros ends a frame: each one is a transfer without a fragment.
  stream : if g_top = "words_to_fragments" generate
    signal aresetn, m_axis_tvalid, m_axis_tlast : std_logic;
    signal m_axis_tkeep                         : fragment_keep_t;
  begin
    aresetn <= not reset;

    shader : entity halfway.words_to_fragments
      port map (
        aclk          => clk,
        aresetn       => aresetn,
        s_axis_tvalid => valid,
        s_axis_tready => ready,
        s_axis_tdata  => (others => bit_value),
        s_axis_tlast  => '0',
        m_axis_tvalid => m_axis_tvalid,
        m_axis_tready => '1',
        m_axis_tkeep  => m_axis_tkeep,
        m_axis_tlast  => m_axis_tlast);

    count : process (clk)
    begin
      if rising_edge(clk) and m_axis_tvalid = '1' then
        assert m_axis_tlast = '1' and m_axis_tkeep = (m_axis_tkeep'range => '0')
          report "vhdl_library_tb: not the end of a frame without fragments"
          severity failure;
        frames <= frames + 1;
      end if;
    end process;
  end generate;

  quadratic : if g_top = "quadratic_shader" generate
    shader : entity halfway.quadratic_shader
      port map (
        clk            => clk,
        reset          => reset,
        init_valid     => valid,
        init_ready     => ready,
        init_data      => (others => bit_value),
        fragment_ready => '1');
  end generate;

  spherical : if g_top = "spherical_shader" generate
    shader : entity halfway.spherical_shader
      port map (
        clk            => clk,
        reset          => reset,
        init_valid     => valid,
        init_ready     => ready,
        init_data      => (others => bit_value),
        fragment_ready => '1');
  end generate;

  -- The command is new_object: 1.
  processors : if g_top = "processors_shader" generate
    shader : entity halfway.processors_shader
      port map (
        clk            => clk,
        reset          => reset,
        init_valid     => valid,
        init_ready     => ready,
        init_data      => (0 => '1', others => bit_value),
        fragment_ready => '1');
  end generate;

  -- A word waits, because no address comes.
  core : if g_top = "halfway_core" generate
    signal aresetn : std_logic;
  begin
    aresetn <= not reset;

    drawing : entity halfway.halfway_core
      port map (
        aclk          => clk,
        aresetn       => aresetn,
        s_axi_awvalid => '0',
        s_axi_awaddr  => x"00",
        s_axi_awprot  => "000",
        s_axi_wvalid  => valid,
        s_axi_wready  => ready,
        s_axi_wdata   => (others => '0'),
        s_axi_wstrb   => (others => bit_value),
        s_axi_bready  => '0',
        s_axi_arvalid => '0',
        s_axi_araddr  => x"00",
        s_axi_arprot  => "000",
        s_axi_rready  => '0',
        m_axi_arready => '0',
        m_axi_rvalid  => wrong,
        m_axi_rdata   => (others => '0'),
        m_axi_rresp   => "00",
        m_axi_rlast   => '0',
        m_axi_awready => '0',
        m_axi_wready  => '0',
        m_axi_bvalid  => '0',
        m_axi_bresp   => "00");
  end generate;

  -- The second address waits, because no data come.
  plain_memory : if g_top = "memory_port" generate
    port_of_memory : entity halfway.memory_port
      port map (
        clk           => clk,
        reset         => reset,
        s_axi_arvalid => wrong,
        s_axi_araddr  => (0 => wrong, others => '0'),
        s_axi_arlen   => x"00",
        s_axi_rready  => '0',
        s_axi_awvalid => valid,
        s_axi_awready => ready,
        s_axi_awaddr  => (31 => bit_value, others => '0'),
        s_axi_wvalid  => '0',
        s_axi_wdata   => (others => '0'),
        s_axi_wstrb   => (others => '0'),
        s_axi_wlast   => '0',
        s_axi_bready  => '0',
        memory_word   => (others => '0'));
  end generate;

  -- A fragment waits, because no frame begins.
  memory : if g_top = "fragments_to_memory" generate
    signal start : std_logic;
    signal frame : frame_t := (
      colour_base | depth_base => x"00000000", colour_stride | depth_stride => x"0000", clear => '1',
      red | green | blue => x"00", others => to_unsigned(1, 13)
      );
  begin
    start     <= '1' when g_fault = "frame" and clocks = 50 else '0';
    frame.red <= x"01" when g_fault = "frame" and clocks > 60 else x"00";

    picture : entity halfway.fragments_to_memory
      port map (
        clk           => clk,
        reset         => reset,
        frame         => frame,
        start         => start,
        s_axis_tvalid => valid,
        s_axis_tready => ready,
        s_axis_tdata  => (others => '0'),
        s_axis_tkeep  => (others => bit_value),
        s_axis_tlast  => '0',
        s_axis_tuser  => (others => '0'),
        m_axi_arready => '0',
        m_axi_rvalid  => '0',
        m_axi_rdata   => (others => '0'),
        m_axi_rresp   => "00",
        m_axi_awready => '0',
        m_axi_wready  => '0',
        m_axi_bvalid  => wrong,
        m_axi_bresp   => "00");
  end generate;

end architecture;
