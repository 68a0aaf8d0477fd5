-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     AXI4-Lite for a register file: accesses one after the other, each with one clock at the registers.
-- Contract    s_axi: AXI4-Lite; what waits does not change (a simulation stops otherwise). Address and data of a write come
--             in any order. All outputs depend on registers only. awprot and arprot are not needed. An access with an error
--             is answered with SLVERR.
--             write = '1' for one clock per write: write_error is its answer in this clock. read = '1' for one clock per
--             read: read_data and read_error are its answer in this clock. Address and data are stable from then until
--             the answer is taken. A write and a read may come in the same clock.
-- Formats     addresses of 8 bits; a register has 32 bits, and its number is the address without the lower 2 bits
-- Latency     2 clocks from the address, or the data of a write, to the answer
-- Throughput  1 write and 1 read in 3 clocks
-- Error       none
-- Source      ours: AMBA AXI4-Lite
-- Golden twin none: it moves words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.stream_pkg.all;

entity register_port is
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    s_axi_awvalid : in  std_logic;
    s_axi_awready : out std_logic;
    s_axi_awaddr  : in  unsigned(7 downto 0);
    s_axi_wvalid  : in  std_logic;
    s_axi_wready  : out std_logic;
    s_axi_wdata   : in  std_logic_vector(31 downto 0);
    s_axi_wstrb   : in  std_logic_vector(3 downto 0);
    s_axi_bvalid  : out std_logic;
    s_axi_bready  : in  std_logic;
    s_axi_bresp   : out std_logic_vector(1 downto 0);
    s_axi_arvalid : in  std_logic;
    s_axi_arready : out std_logic;
    s_axi_araddr  : in  unsigned(7 downto 0);
    s_axi_rvalid  : out std_logic;
    s_axi_rready  : in  std_logic;
    s_axi_rdata   : out std_logic_vector(31 downto 0);
    s_axi_rresp   : out std_logic_vector(1 downto 0);
    write         : out std_logic;
    write_address : out unsigned(5 downto 0);
    write_data    : out std_logic_vector(31 downto 0);
    write_strobes : out std_logic_vector(3 downto 0);
    write_error   : in  std_logic;
    read          : out std_logic;
    read_address  : out unsigned(5 downto 0);
    read_data     : in  std_logic_vector(31 downto 0);
    read_error    : in  std_logic
  );
end entity;

architecture rtl of register_port is

  type reg_t is record
    write_address : unsigned(write_address'range);
    addressed     : std_logic; -- the address of a write has come, and its answer has not been taken
    write_data    : std_logic_vector(write_data'range);
    write_strobes : std_logic_vector(write_strobes'range);
    supplied      : std_logic; -- the same of its data
    written       : std_logic; -- the answer waits
    write_error   : std_logic;
    read_address  : unsigned(read_address'range);
    reading       : std_logic; -- the address of a read has come, and its answer has not been taken
    read_done     : std_logic; -- the answer waits
    read_data     : std_logic_vector(read_data'range);
    read_error    : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal write_now, read_now : std_logic;

begin

  write_now <= r.addressed and r.supplied and not r.written;
  read_now  <= r.reading and not r.read_done;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    -- Take the address and the data of a write.
    if s_axi_awvalid = '1' and r.addressed = '0' then
      v.addressed     := '1';
      v.write_address := s_axi_awaddr(7 downto 2);
    end if;
    if s_axi_wvalid = '1' and r.supplied = '0' then
      v.supplied      := '1';
      v.write_data    := s_axi_wdata;
      v.write_strobes := s_axi_wstrb;
    end if;

    -- Write, and answer.
    if write_now = '1' then
      v.written     := '1';
      v.write_error := write_error;
    end if;
    if r.written = '1' and s_axi_bready = '1' then
      v.addressed := '0';
      v.supplied  := '0';
      v.written   := '0';
    end if;

    -- Take the address of a read, read, and answer.
    if s_axi_arvalid = '1' and r.reading = '0' then
      v.reading      := '1';
      v.read_address := s_axi_araddr(7 downto 2);
    end if;
    if read_now = '1' then
      v.read_done  := '1';
      v.read_data  := read_data;
      v.read_error := read_error;
    end if;
    if r.read_done = '1' and s_axi_rready = '1' then
      v.reading   := '0';
      v.read_done := '0';
    end if;

    if reset = '1' then
      v.addressed := '0';
      v.supplied  := '0';
      v.written   := '0';
      v.reading   := '0';
      v.read_done := '0';
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
    variable write_waiting, read_waiting : std_logic_vector(s_axi_awaddr'length downto 0);
    variable data_waiting                : std_logic_vector(s_axi_wdata'length + s_axi_wstrb'length downto 0);
  begin
    if rising_edge(clk) then
      check_stream("register_port: s_axi_aw", reset, not r.addressed,
        s_axi_awvalid & std_logic_vector(s_axi_awaddr), write_waiting);
      check_stream("register_port: s_axi_w", reset, not r.supplied, s_axi_wvalid & s_axi_wstrb & s_axi_wdata, data_waiting);
      check_stream("register_port: s_axi_ar", reset, not r.reading,
        s_axi_arvalid & std_logic_vector(s_axi_araddr), read_waiting);
    end if;
  end process;

  s_axi_awready <= not r.addressed;
  s_axi_wready  <= not r.supplied;
  s_axi_bvalid  <= r.written;
  s_axi_bresp   <= r.write_error & '0';
  s_axi_arready <= not r.reading;
  s_axi_rvalid  <= r.read_done;
  s_axi_rdata   <= r.read_data;
  s_axi_rresp   <= r.read_error & '0';
  write         <= write_now;
  write_address <= r.write_address;
  write_data    <= r.write_data;
  write_strobes <= r.write_strobes;
  read          <= read_now;
  read_address  <= r.read_address;

end architecture;
