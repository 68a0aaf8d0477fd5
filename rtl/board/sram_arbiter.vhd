-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Gives the SRAM to one of three users per clock: scan-out first, then the depth test, then the clear.
-- Contract    A request is taken where valid and ready are both '1' at a rising edge; a scan-out read is always taken.
--             A write is not taken in the clock after a read: the data pins change direction in between. The data of
--             reads come back in order, scan_data_valid or depth_data_valid in the clock in which the word is at
--             sram_data_in. The addresses are the users' own: each writes only inside its buffers.
-- Formats     board_pkg: address, word
-- Latency     3 clocks from a read taken to its data; the outputs are registers
-- Throughput  1 access per clock; one clock is lost where a write follows a read
-- Error       none
-- Source      ours
-- Golden twin none: it only selects

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;

entity sram_arbiter is
  port (
    clk              : in  std_logic;
    reset            : in  std_logic;
    -- Scan-out: reads.
    scan_valid       : in  std_logic;
    scan_address     : in  address_t;
    scan_data_valid  : out std_logic;
    -- Depth test: reads and writes.
    depth_valid      : in  std_logic;
    depth_ready      : out std_logic;
    depth_write      : in  std_logic;
    depth_address    : in  address_t;
    depth_data       : in  word_t;
    depth_data_valid : out std_logic;
    -- Clear: writes.
    clear_valid      : in  std_logic;
    clear_ready      : out std_logic;
    clear_address    : in  address_t;
    clear_data       : in  word_t;
    -- The SRAM, through the registers of the pins' cells: board_core.
    sram_address     : out address_t;
    sram_data_out    : out word_t;
    sram_read        : out std_logic;
    sram_write       : out std_logic
  );
end entity;

architecture rtl of sram_arbiter is

  -- Clocks from a read at the outputs to its word at sram_data_in.
  constant c_read_clocks : positive := 2;

  type reg_t is record
    read        : std_logic;
    write       : std_logic;
    address     : address_t;
    data        : word_t;
    scan_reads  : std_logic_vector(0 to c_read_clocks); -- which user's read it was, 0 to c_read_clocks clocks ago
    depth_reads : std_logic_vector(0 to c_read_clocks);
  end record;

  signal r, r_next : reg_t;

  signal depth_take, clear_take : std_logic;

begin

  depth_take <= depth_valid and not scan_valid and not (depth_write and r.read);
  clear_take <= clear_valid and not scan_valid and not depth_valid and not r.read;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;

    -- Select the user.
    v.address := clear_address;
    v.data    := clear_data;
    if scan_valid = '1' then
      v.address := scan_address;
    elsif depth_valid = '1' then
      v.address := depth_address;
      v.data    := depth_data;
    end if;
    v.read  := scan_valid or (depth_take and not depth_write);
    v.write := (depth_take and depth_write) or clear_take;

    -- Follow the reads to their data.
    v.scan_reads  := scan_valid & r.scan_reads(0 to c_read_clocks - 1);
    v.depth_reads := (depth_take and not depth_write) & r.depth_reads(0 to c_read_clocks - 1);

    if reset = '1' then
      v.read        := '0';
      v.write       := '0';
      v.scan_reads  := (others => '0');
      v.depth_reads := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  scan_data_valid  <= r.scan_reads(c_read_clocks);
  depth_ready      <= depth_take;
  depth_data_valid <= r.depth_reads(c_read_clocks);
  clear_ready      <= clear_take;
  sram_address     <= r.address;
  sram_data_out    <= r.data;
  sram_read        <= r.read;
  sram_write       <= r.write;

end architecture;
