-- SPDX-License-Identifier: Apache-2.0
-- Runs scripts of a host on halfway_core with each shader, on both widths of the bus and in both formats: registers,
-- commands, frames, wrong commands and packets, aborts, error responses, resets. After each frame all of the memory must be
-- golden. axi_rules checks every clock of the memory's port; what waits at the register port must not change.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_memory_pkg.all;
use work.axi_words_pkg.all;
use work.core_registers_pkg.all;
use work.memory_pkg.all;
use work.stream_pkg.all;
use work.tb_pkg.all;
use work.tb_shaders_pkg.all;

entity halfway_core_checker is
  generic (
    g_number : natural; -- of the hardware; it has the memories 2 * g_number and 2 * g_number + 1
    g_folder : string
  );
end entity;

architecture sim of halfway_core_checker is
  constant h             : hardware_t := packet_hardware(g_number);
  constant c_name        : string := nth_word(c_packet_names, g_number);
  constant c_bus_bits    : positive := 32 + 32 * (g_number mod 2);
  constant c_bytes       : positive := c_bus_bits / 8;
  constant c_true_colour : boolean  := g_number mod 4 >= 2; -- as in tb/vectors/core.cpp
  constant c_memory      : natural  := 2 * g_number;
  constant c_expected    : natural  := c_memory + 1;
  constant c_limit       : positive := 30_000; -- clocks of a frame that count as a hang

  signal running          : boolean   := false;
  signal clk              : std_logic := '0';
  signal aresetn, reset   : std_logic := '0';
  signal interrupt        : std_logic;
  signal picture          : address_t;
  signal awvalid, wvalid  : std_logic := '0';
  signal awready, wready  : std_logic;
  signal awaddr, araddr   : unsigned(7 downto 0) := (others => '0');
  signal wdata            : std_logic_vector(31 downto 0) := (others => '0');
  signal wstrb            : std_logic_vector(3 downto 0) := (others => '1');
  signal bvalid, rvalid   : std_logic;
  signal bready, rready   : std_logic := '0';
  signal bresp, rresp     : std_logic_vector(1 downto 0);
  signal arvalid          : std_logic := '0';
  signal arready          : std_logic;
  signal rdata            : std_logic_vector(31 downto 0);
  signal m                : manager_t;
  signal s                : subordinate_t;
  signal latency          : positive := 1;
  signal pauses, errors   : natural := 0;
begin
  dut : entity work.halfway_core
    generic map (
      g_shader             => h.shader,
      g_exact              => h.exact,
      g_channels           => h.channels,
      g_diffuse            => h.diffuse,
      g_specular           => h.specular,
      g_degree             => h.degree,
      g_lights             => h.lights,
      g_highlight_channels => h.highlight_channels,
      g_powers             => h.powers,
      g_cosine             => h.cosine,
      g_directional        => h.directional,
      g_positional         => h.positional,
      g_spots              => h.spots,
      g_normalize          => h.normalize,
      g_shadows            => h.shadows,
      g_unrolled           => h.unrolled,
      g_objects            => h.objects,
      g_subpixels          => h.subpixels,
      g_bus_bits           => c_bus_bits,
      g_limit_bits         => 13,
      g_true_colour        => c_true_colour)
    port map (
      aclk          => clk,
      aresetn       => aresetn,
      irq           => interrupt,
      picture       => picture,
      s_axi_awvalid => awvalid,
      s_axi_awready => awready,
      s_axi_awaddr  => awaddr,
      s_axi_awprot  => "000",
      s_axi_wvalid  => wvalid,
      s_axi_wready  => wready,
      s_axi_wdata   => wdata,
      s_axi_wstrb   => wstrb,
      s_axi_bvalid  => bvalid,
      s_axi_bready  => bready,
      s_axi_bresp   => bresp,
      s_axi_arvalid => arvalid,
      s_axi_arready => arready,
      s_axi_araddr  => araddr,
      s_axi_arprot  => "000",
      s_axi_rvalid  => rvalid,
      s_axi_rready  => rready,
      s_axi_rdata   => rdata,
      s_axi_rresp   => rresp,
      m_axi_arvalid => m.ar.valid,
      m_axi_arready => s.arready,
      m_axi_araddr  => m.ar.addr,
      m_axi_arlen   => m.ar.len,
      m_axi_arsize  => m.ar.size,
      m_axi_arburst => m.ar.burst,
      m_axi_arcache => open,
      m_axi_arprot  => open,
      m_axi_rvalid  => s.rvalid,
      m_axi_rready  => m.rready,
      m_axi_rdata   => s.rdata(c_bus_bits - 1 downto 0),
      m_axi_rresp   => s.rresp,
      m_axi_rlast   => s.rlast,
      m_axi_awvalid => m.aw.valid,
      m_axi_awready => s.awready,
      m_axi_awaddr  => m.aw.addr,
      m_axi_awlen   => m.aw.len,
      m_axi_awsize  => m.aw.size,
      m_axi_awburst => m.aw.burst,
      m_axi_awcache => open,
      m_axi_awprot  => open,
      m_axi_wvalid  => m.wvalid,
      m_axi_wready  => s.wready,
      m_axi_wdata   => m.wdata(c_bus_bits - 1 downto 0),
      m_axi_wstrb   => m.wstrb(c_bytes - 1 downto 0),
      m_axi_wlast   => m.wlast,
      m_axi_bvalid  => s.bvalid,
      m_axi_bready  => m.bready,
      m_axi_bresp   => s.bresp);

  memory : entity work.axi_memory
    generic map (g_memory => c_memory, g_data_bits => c_bus_bits)
    port map (clk => clk, reset => reset, latency => latency, pause => pauses, errors => errors, m => m, s => s);

  rules : entity work.axi_rules
    generic map (g_true_colour => c_true_colour, g_data_bits => c_bus_bits, g_any_place => true)
    port map (clk => clk, reset => reset, m => m, s => s);

  register_port : process (clk) is
    variable response_waiting : std_logic_vector(0 to 2)  := (others => '0');
    variable word_waiting     : std_logic_vector(0 to 34) := (others => '0');
  begin
    if rising_edge(clk) then
      check_stream("s_axi b", reset, bready, bvalid & bresp, response_waiting);
      check_stream("s_axi r", reset, rready, rvalid & rresp & rdata, word_waiting);
    end if;
  end process;

  reset <= not aresetn;
  clk   <= not clk after c_half_period when running;

  -- The first frame, at a memory that answers at once: docs/rtl/core.md.
  latencies : process is
    constant c_units     : positive := 512 / c_bus_bits; -- words of a command
    variable clocks      : natural := 0;

    procedure count_clock is
    begin
      wait until rising_edge(clk);
      clocks := clocks + 1;
    end procedure;
  begin
    wait until rising_edge(clk) and bvalid = '1' and awaddr = c_address_ring_head;
    while m.ar.valid = '0' loop
      count_clock;
    end loop;
    check(c_name, 0, "clocks from the write of ring_head to the request of the command", clocks, c_units + 3);
    wait until rising_edge(clk) and (s.rvalid and m.rready and s.rlast) = '1';
    clocks := 0;
    count_clock;
    while m.ar.valid = '0' loop
      count_clock;
    end loop;
    check(c_name, 0, "clocks from the command's last word to the request of packets", clocks, 22);
    while interrupt = '0' loop
      count_clock;
      if s.bvalid = '1' and m.bready = '1' then
        clocks := 0;
      end if;
    end loop;
    check(c_name, 0, "clocks from the last response to the interrupt, more than 7", maximum(clocks, 7), 7);
    wait;
  end process;

  host : process is
    variable script         : vectors_t;
    variable random         : unsigned(31 downto 0) := to_unsigned(7, 32);
    variable number         : natural := 0; -- of the step
    variable kind           : std_logic_vector(3 downto 0);
    variable a, b, c, value : std_logic_vector(31 downto 0);
    variable clocks         : natural;

    procedure write_register (offset, word : std_logic_vector(31 downto 0); response : std_logic_vector(1 downto 0)) is
      variable address_taken, word_taken : boolean := false;
    begin
      awaddr <= unsigned(offset(7 downto 0));
      wdata  <= word;
      -- The address first, the word first, or both at once.
      random := next_random(random);
      awvalid <= to_flag(random(9 downto 8) /= 0);
      wvalid  <= to_flag(random(9 downto 8) /= 1);
      while not (address_taken and word_taken) loop
        wait until rising_edge(clk);
        address_taken := address_taken or (awvalid = '1' and awready = '1');
        word_taken    := word_taken or (wvalid = '1' and wready = '1');
        awvalid <= to_flag(not address_taken);
        wvalid  <= to_flag(not word_taken);
      end loop;
      pause(clk, random, 1);
      bready <= '1';
      wait until rising_edge(clk) and bvalid = '1';
      bready <= '0';
      check(c_name & ": step", number, "bresp of register " & to_hstring(offset), bresp, response);
    end procedure;

    procedure read_register (offset : std_logic_vector(31 downto 0); response : std_logic_vector(1 downto 0)) is
    begin
      araddr  <= unsigned(offset(7 downto 0));
      arvalid <= '1';
      wait until rising_edge(clk) and arready = '1';
      arvalid <= '0';
      pause(clk, random, 1);
      rready <= '1';
      wait until rising_edge(clk) and rvalid = '1';
      rready <= '0';
      value := rdata;
      check(c_name & ": step", number, "rresp of register " & to_hstring(offset), rresp, response);
    end procedure;

    function register_offset (offset : natural) return std_logic_vector is
    begin
      return std_logic_vector(to_unsigned(offset, 32));
    end function;
  begin
    memories.fill(c_memory, x"00000000");
    memories.fill(c_expected, x"00000000");
    take_turn;
    running <= true;
    script.open_file(g_folder & "/" & c_name & ".txt");
    while script.next_vector loop
      script.read_word(kind);
      script.read_word(a);
      script.read_word(b);
      script.read_word(c);
      case to_integer(unsigned(kind)) is
        when 0 => -- set a word of memory
          memories.set(c_memory, to_integer(unsigned(a)), b);
          memories.set(c_expected, to_integer(unsigned(a)), b);
        when 1 =>
          write_register(a, b, c(1 downto 0));
        when 2 =>
          read_register(a, c(1 downto 0));
          check(c_name & ": step", number, "register " & to_hstring(a), value, b);
        when 3 => -- wait until commands are done
          clocks := 0;
          loop
            read_register(register_offset(c_address_ring_tail), "00");
            exit when value = a;
            clocks := clocks + 4;
            assert clocks < c_limit report c_name & ": step " & to_string(number) & ": the core hangs" severity failure;
          end loop;
          wait until rising_edge(clk);
          check(c_name & ": step", number, "interrupt", interrupt, '1');
        when 4 =>
          memories.compare(c_name & ": step", number, c_memory, c_expected);
        when 5 =>
          aresetn <= '0';
          wait_clocks(clk, 3);
          aresetn <= '1';
          wait_clocks(clk, 2);
        when 6 =>
          wait_clocks(clk, to_integer(unsigned(a)));
        when 7 =>
          latency <= to_integer(unsigned(a));
          pauses  <= to_integer(unsigned(b));
          errors  <= to_integer(unsigned(c));
          wait until rising_edge(clk);
        when 8 => -- one of these bits at least, and no other
          read_register(a, "00");
          check(c_name & ": step", number, "other bits of register " & to_hstring(a), value and not b, x"00000000");
          check(c_name & ": step", number, "a bit of register " & to_hstring(a), or value, '1');
        when 9 => -- a word that must be in memory
          memories.set(c_expected, to_integer(unsigned(a)), b);
        when others =>
          script.fail("an unknown step");
      end case;
      number := number + 1;
    end loop;
    running <= false;
    end_turn(finished);
  end process;
end architecture;

use work.tb_pkg.all;

entity halfway_core_tb is
  generic (g_folder : string := "halfway_core");
end entity;

architecture sim of halfway_core_tb is
begin
  runs : for index in 0 to 4 generate
    checker : entity work.halfway_core_checker
      generic map (g_number => index, g_folder => g_folder);
  end generate;

  report_end(finished, "halfway_core_tb");
end architecture;
