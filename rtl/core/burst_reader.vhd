-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Reads consecutive words of memory in bursts, and outputs them as a stream. A place in a queue is claimed for
--             each word before it is requested, so that a word on its way never waits at the bus.
-- Contract    start = '1' while busy = '0' begins to read count * 8 bytes at address, a multiple of 8. busy = '1': words
--             are requested, on their way, or in the queue. fault = '1': since start a word came with an error response.
--             stop = '1': no further burst is begun; words on their way are still output.
--             out is valid/ready; out_last = '1' with the last word.
--             AXI4: INCR bursts that end at multiples of 2**g_burst_bits words, so none crosses 4 KiB; m_axi_arvalid and its
--             address depend on registers only. A word is taken in each clock with m_axi_rvalid = '1'.
-- Formats     count: of 8 bytes, 1 word of 64 bits or 2 of 32
-- Latency     from start to m_axi_arvalid: 1 clock and 1 for each word of the first burst; from m_axi_rvalid to out_valid: 2
-- Throughput  1 word per clock, if the first word of a burst comes at most 44 clocks after its address
-- Error       none: each word is output once, unchanged, in order
-- Source      ours
-- Golden twin none: it moves words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity burst_reader is
  generic (
    g_data_bits  : positive; -- 32 or 64
    g_count_bits : positive := 29;
    g_burst_bits : positive := 4; -- a burst has at most 2**g_burst_bits words
    g_queue_bits : positive := 6  -- of places in the queue
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    start         : in  std_logic;
    address       : in  address_t;
    count         : in  unsigned(g_count_bits - 1 downto 0);
    stop          : in  std_logic;
    busy          : out std_logic;
    fault         : out std_logic;
    m_axi_arvalid : out std_logic;
    m_axi_arready : in  std_logic;
    m_axi_araddr  : out address_t;
    m_axi_arlen   : out unsigned(7 downto 0);
    m_axi_rvalid  : in  std_logic;
    m_axi_rdata   : in  std_logic_vector(g_data_bits - 1 downto 0);
    m_axi_rresp   : in  std_logic_vector(1 downto 0);
    out_valid     : out std_logic;
    out_ready     : in  std_logic;
    out_data      : out std_logic_vector(g_data_bits - 1 downto 0);
    out_last      : out std_logic
  );
end entity;

architecture rtl of burst_reader is

  constant c_word_shift : positive := log2(bytes(g_data_bits)); -- of the bytes of a word
  constant c_unit_shift : natural  := 3 - c_word_shift; -- of the words of a unit

  subtype word_address_t is unsigned(address_t'length - c_word_shift - 1 downto 0);
  subtype words_t is unsigned(g_count_bits + c_unit_shift - 1 downto 0);

  type reg_t is record
    address : word_address_t; -- of the next word
    left    : words_t; -- words that are not claimed yet
    to_come : words_t; -- words that have not come yet
    claimed : unsigned(g_burst_bits - 1 downto 0); -- words of the burst, before the next one
    valid   : std_logic; -- a request waits
    first   : word_address_t; -- of its burst
    length  : unsigned(g_burst_bits - 1 downto 0); -- its words - 1
    fault   : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal room, pending      : std_logic;
  signal claim              : std_logic;
  signal ends               : std_logic; -- the next word is the last one of its burst
  signal queue_in, queue_out : std_logic_vector(g_data_bits downto 0);

begin

  ends <= flag(r.left = 1 or r.address(g_burst_bits - 1 downto 0) = 2 ** g_burst_bits - 1);

  -- Claim a place for each word. The last word of a burst waits until the request before it is taken. After stop only a
  -- burst that has begun goes on.
  claim <= room and flag(r.left /= 0) and not (ends and r.valid) and not (stop and flag(r.claimed = 0));

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if m_axi_arready = '1' then
      v.valid := '0';
    end if;
    if claim = '1' then
      v.address := r.address + 1;
      v.left    := r.left - 1;
      v.claimed := r.claimed + 1;
      if ends = '1' then
        v.valid   := '1';
        v.first   := r.address - r.claimed;
        v.length  := r.claimed;
        v.claimed := (others => '0');
      end if;
    end if;
    if stop = '1' and v.claimed = 0 then
      v.left := (others => '0');
    end if;
    if m_axi_rvalid = '1' then
      v.to_come := r.to_come - 1;
      v.fault   := r.fault or m_axi_rresp(1);
    end if;
    if start = '1' then
      v.address := address(address_t'high downto c_word_shift);
      v.left    := resize(count, words_t'length) sll c_unit_shift;
      v.to_come := resize(count, words_t'length) sll c_unit_shift;
      v.fault   := '0';
    end if;
    if reset = '1' then
      v.left    := (others => '0');
      v.claimed := (others => '0');
      v.valid   := '0';
      v.fault   := '0';
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
  check_start : process (clk)
  begin
    if rising_edge(clk) then
      assert start /= '1' or reset /= '0' or (pending = '0' and r.left = 0)
        report "burst_reader: start while busy = '1'"
        severity failure;
    end if;
  end process;

  queue_in <= flag(r.to_come = 1) & m_axi_rdata;

  queue : entity work.stream_queue
    generic map (
      g_bits       => g_data_bits + 1,
      g_index_bits => g_queue_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => claim,
      room      => room,
      pending   => pending,
      in_valid  => m_axi_rvalid,
      in_data   => queue_in,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => queue_out
      );

  busy          <= pending or flag(r.left /= 0);
  fault         <= r.fault;
  m_axi_arvalid <= r.valid;
  m_axi_araddr  <= r.first & to_unsigned(0, c_word_shift);
  m_axi_arlen   <= resize(r.length, m_axi_arlen'length);
  out_data      <= queue_out(g_data_bits - 1 downto 0);
  out_last      <= queue_out(g_data_bits);

end architecture;
