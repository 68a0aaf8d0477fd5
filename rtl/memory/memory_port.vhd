-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A plain synchronous memory at the AXI4 port of fragments_to_memory: one port for reads and writes, one burst
--             after the other. Reads and writes that wait take turns.
-- Contract    s_axi: AXI4 as fragments_to_memory gives it: INCR bursts of whole words (a simulation stops if a
--             request or a word changes while it waits, or at an address inside a word). No errors. All outputs depend on
--             registers only. memory_enable = '1': memory_strobes are the bytes of memory_data to write at the word
--             memory_address; without strobes the word is read, and is memory_word g_clocks clocks later.
-- Formats     an address of memory is that of AXI4 without the bits of a word's bytes
-- Latency     4 clocks from an address to a read; g_clocks + 2 from this read to s_axi_rvalid
-- Throughput  1 word per clock in a burst, and 3 or 4 clocks between bursts
-- Error       none
-- Source      ours
-- Golden twin none: it moves words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.stream_pkg.all;
use work.line_pkg.flag;

entity memory_port is
  generic (
    g_data_bits : positive := 64;
    g_clocks    : positive := 1 -- 1 to 4
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    s_axi_arvalid  : in  std_logic;
    s_axi_arready  : out std_logic;
    s_axi_araddr   : in  address_t;
    s_axi_arlen    : in  unsigned(7 downto 0);
    s_axi_rvalid   : out std_logic;
    s_axi_rready   : in  std_logic;
    s_axi_rdata    : out std_logic_vector(g_data_bits - 1 downto 0);
    s_axi_rlast    : out std_logic;
    s_axi_awvalid  : in  std_logic;
    s_axi_awready  : out std_logic;
    s_axi_awaddr   : in  address_t;
    s_axi_wvalid   : in  std_logic;
    s_axi_wready   : out std_logic;
    s_axi_wdata    : in  std_logic_vector(g_data_bits - 1 downto 0);
    s_axi_wstrb    : in  std_logic_vector(bytes(g_data_bits) - 1 downto 0);
    s_axi_wlast    : in  std_logic;
    s_axi_bvalid   : out std_logic;
    s_axi_bready   : in  std_logic;
    memory_enable  : out std_logic;
    memory_strobes : out std_logic_vector(bytes(g_data_bits) - 1 downto 0);
    memory_address : out unsigned(address_t'length - log2(bytes(g_data_bits)) - 1 downto 0);
    memory_data    : out std_logic_vector(g_data_bits - 1 downto 0);
    memory_word    : in  std_logic_vector(g_data_bits - 1 downto 0)
  );
end entity;

architecture rtl of memory_port is

  type phase_t is (
    idle,
    take_read,
    take_write,
    read,
    write,
    respond
    );

  type reg_t is record
    phase   : phase_t;
    written : std_logic; -- the last burst was a write
    address : unsigned(memory_address'range); -- of the next word
    left    : unsigned(s_axi_arlen'range); -- words after the next one
    enable  : std_logic;
    strobes : std_logic_vector(memory_strobes'range);
    place   : unsigned(memory_address'range);
    data    : std_logic_vector(memory_data'range);
    reads   : std_logic_vector(0 to g_clocks); -- a word comes in this number of clocks, from the right
    lasts   : std_logic_vector(0 to g_clocks); -- it is the burst's last one
  end record;

  signal r, r_next : reg_t;

  signal room, step     : std_logic; -- for a word that is read; one is requested
  signal words, word_out : std_logic_vector(g_data_bits downto 0);

begin

  step <= flag(r.phase = read) and room;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.enable  := '0';
    v.strobes := (others => '0');
    v.place   := r.address;
    v.data    := s_axi_wdata;
    v.reads   := step & r.reads(0 to g_clocks - 1);
    v.lasts   := flag(r.left = 0) & r.lasts(0 to g_clocks - 1);
    case r.phase is
      when idle =>
        if s_axi_arvalid = '1' and (s_axi_awvalid = '0' or r.written = '1') then
          v.phase := take_read;
        elsif s_axi_awvalid = '1' then
          v.phase := take_write;
        end if;
      when take_read =>
        v.phase   := read;
        v.written := '0';
        v.address := s_axi_araddr(address_t'high downto address_t'length - memory_address'length);
        v.left    := s_axi_arlen;
      when take_write =>
        v.phase   := write;
        v.written := '1';
        v.address := s_axi_awaddr(address_t'high downto address_t'length - memory_address'length);
      when read =>
        if step = '1' then
          v.enable  := '1';
          v.address := r.address + 1;
          v.left    := r.left - 1;
          if r.left = 0 then
            v.phase := idle;
          end if;
        end if;
      when write =>
        if s_axi_wvalid = '1' then
          v.enable  := '1';
          v.strobes := s_axi_wstrb;
          v.address := r.address + 1;
          if s_axi_wlast = '1' then
            v.phase := respond;
          end if;
        end if;
      when respond =>
        if s_axi_bready = '1' then
          v.phase := idle;
        end if;
    end case;
    -- A word without strobes is not written, and must not be read either.
    if r.phase = write and s_axi_wstrb = (s_axi_wstrb'range => '0') then
      v.enable := '0';
    end if;
    if reset = '1' then
      v.phase   := idle;
      v.written := '0';
      v.enable  := '0';
      v.reads   := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Report a broken contract in the user's simulation.
  check_port : process (clk)
    constant c_low      : address_t := to_unsigned(bytes(g_data_bits) - 1, address_t'length); -- of an address: inside a word
    variable ar_waiting : std_logic_vector(address_t'length + s_axi_arlen'length downto 0);
    variable aw_waiting : std_logic_vector(address_t'length downto 0);
    variable w_waiting  : std_logic_vector(s_axi_wdata'length + s_axi_wstrb'length + 1 downto 0);
  begin
    if rising_edge(clk) then
      check_stream("memory_port: s_axi_ar", reset, flag(r.phase = take_read),
        s_axi_arvalid & std_logic_vector(s_axi_araddr & s_axi_arlen), ar_waiting);
      check_stream("memory_port: s_axi_aw", reset, flag(r.phase = take_write),
        s_axi_awvalid & std_logic_vector(s_axi_awaddr), aw_waiting);
      check_stream("memory_port: s_axi_w", reset, flag(r.phase = write),
        s_axi_wvalid & s_axi_wlast & s_axi_wstrb & s_axi_wdata, w_waiting);
      assert reset /= '0' or
        ((s_axi_arvalid /= '1' or (s_axi_araddr and c_low) = 0) and (s_axi_awvalid /= '1' or (s_axi_awaddr and c_low) = 0))
        report "memory_port: s_axi: an address is not that of a word"
        severity failure;
    end if;
  end process;

  words <= r.lasts(g_clocks) & memory_word;

  queue : entity work.stream_queue
    generic map (
      g_bits       => words'length,
      g_index_bits => 4
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => step,
      room      => room,
      pending   => open,
      in_valid  => r.reads(g_clocks),
      in_data   => words,
      out_valid => s_axi_rvalid,
      out_ready => s_axi_rready,
      out_data  => word_out
      );

  s_axi_arready  <= flag(r.phase = take_read);
  s_axi_awready  <= flag(r.phase = take_write);
  s_axi_wready   <= flag(r.phase = write);
  s_axi_bvalid   <= flag(r.phase = respond);
  s_axi_rlast    <= word_out(g_data_bits);
  s_axi_rdata    <= word_out(s_axi_rdata'range);
  memory_enable  <= r.enable;
  memory_strobes <= r.strobes;
  memory_address <= r.place;
  memory_data    <= r.data;

end architecture;
