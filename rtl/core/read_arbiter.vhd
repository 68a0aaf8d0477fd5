-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One AXI4 read port for two readers. Requests that wait take turns. The words come in the order of the requests,
--             as all have one identifier; a queue tells the reader of each burst.
-- Contract    a, b: a reader's request waits unchanged until its arready = '1'; its words come with rvalid, for which it
--             asks with rready. b takes each of its words at once, so it has no rready. Data and responses go from
--             the bus to both readers. A reader that takes its words only after the other reader's words would block both:
--             a must take its words without waiting for b, and b has room for its words when it requests them.
--             m_axi: outputs depend on registers only. rlast = '1' with the last word of a burst.
-- Formats     none
-- Latency     1 clock from a request to m_axi_arvalid; none for words, which wait up to 2 clocks behind their request
-- Throughput  1 request in 2 clocks, 1 word per clock
-- Error       none: each request is passed once, each word goes to the reader that requested it
-- Source      ours
-- Golden twin none: it passes words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;

entity read_arbiter is
  generic (
    g_index_bits : positive := 4 -- at most 2**g_index_bits - 1 bursts are on their way
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    a_arvalid     : in  std_logic;
    a_arready     : out std_logic;
    a_araddr      : in  address_t;
    a_arlen       : in  unsigned(7 downto 0);
    a_rvalid      : out std_logic;
    a_rready      : in  std_logic;
    b_arvalid     : in  std_logic;
    b_arready     : out std_logic;
    b_araddr      : in  address_t;
    b_arlen       : in  unsigned(7 downto 0);
    b_rvalid      : out std_logic;
    m_axi_arvalid : out std_logic;
    m_axi_arready : in  std_logic;
    m_axi_araddr  : out address_t;
    m_axi_arlen   : out unsigned(7 downto 0);
    m_axi_rvalid  : in  std_logic;
    m_axi_rready  : out std_logic;
    m_axi_rlast   : in  std_logic
  );
end entity;

architecture rtl of read_arbiter is

  type reg_t is record
    valid   : std_logic;
    address : address_t;
    length  : unsigned(7 downto 0);
    last_b  : std_logic; -- the last request was b's
  end record;

  signal r, r_next : reg_t;

  signal room, free         : std_logic; -- for another request
  signal take_a, take_b     : std_logic;
  signal takes              : std_logic;
  signal owned, ready, ends : std_logic; -- the reader of the next word is known, and takes it; its burst ends
  signal take, owner        : std_logic_vector(0 downto 0); -- '1': b

begin

  free   <= room and not r.valid;
  take_a <= free and a_arvalid and (r.last_b or not b_arvalid);
  take_b <= free and b_arvalid and not take_a;
  takes  <= take_a or take_b;
  ready  <= owned and (a_rready or owner(0));
  ends   <= ready and m_axi_rvalid and m_axi_rlast;
  take   <= (0 => take_b);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if m_axi_arready = '1' then
      v.valid := '0';
    end if;
    if take_a = '1' then
      v := (valid => '1', address => a_araddr, length => a_arlen, last_b => '0');
    elsif take_b = '1' then
      v := (valid => '1', address => b_araddr, length => b_arlen, last_b => '1');
    end if;
    if reset = '1' then
      v.valid  := '0';
      v.last_b := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  owners : entity work.stream_queue
    generic map (
      g_bits       => 1,
      g_index_bits => g_index_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => takes,
      room      => room,
      pending   => open,
      in_valid  => takes,
      in_data   => take,
      out_valid => owned,
      out_ready => ends,
      out_data  => owner
      );

  a_arready     <= take_a;
  b_arready     <= take_b;
  a_rvalid      <= m_axi_rvalid and owned and not owner(0);
  b_rvalid      <= m_axi_rvalid and owned and owner(0);
  m_axi_arvalid <= r.valid;
  m_axi_araddr  <= r.address;
  m_axi_arlen   <= r.length;
  m_axi_rready  <= ready;

end architecture;
