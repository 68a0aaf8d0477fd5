-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The host's port: receives packets over SPI (mode 0), checks their CRC and length, and gives out init
--             vectors and ends of frames. Returns a status byte in each packet. docs/board.md describes packets and
--             status.
--
--             pins --> edges --> counter of bits, command, CRC --> at the packet's end: taken or dropped
--                        |
--                        +--> shift register of the vector, shift register of the background
--
-- Contract    select_n, clock and data_in are registers that sample the pins with clk. High and low phases of clock
--             last at least 2 clocks, its period at least 4. Its first rising edge comes at least 6 clocks after
--             select_n = '0'. select_n = '1' comes at least 2 clocks after its last falling edge, and lasts at least 6
--             clocks, so that the next status byte shows what the packet has changed. The init stream is valid/ready; a vector does not change
--             while it waits. A vector is taken if it was complete and correct, and if there was room when its packet
--             started: there is room if no vector waits and no frame is being ended. frame_end is '1' for one clock,
--             with background, only if ending was '0' when the packet started.
-- Formats     g_init_bits: init vector, most significant bit first
-- Latency     2 clocks from select_n = '1' to init_valid or frame_end
-- Throughput  1 bit in 4 clocks
-- Error       a damaged packet is taken with probability 2**-16 if its errors are random; bursts of up to 16 bits are
--             always found
-- Source      CRC-16/CCITT-FALSE; the rest is ours
-- Golden twin none: the CRC of the message and its CRC is 0

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.word_t;
use work.line_pkg.flag;

entity spi_receiver is
  generic (
    g_init_bits : positive
  );
  port (
    clk        : in  std_logic;
    reset      : in  std_logic;
    -- SPI
    select_n   : in  std_logic;
    clock      : in  std_logic;
    data_in    : in  std_logic;
    data_out   : out std_logic;
    -- Packets
    init_valid : out std_logic;
    init_ready : in  std_logic;
    init_data  : out std_logic_vector(g_init_bits - 1 downto 0);
    frame_end  : out std_logic;
    background : out word_t;
    -- Status
    ending     : in  std_logic;
    fault      : in  std_logic; -- '1' for one clock or more per fault
    shown      : in  unsigned(3 downto 0)
  );
end entity;

architecture rtl of spi_receiver is

  constant c_command_bits : positive := 8;
  constant c_crc_bits     : positive := 16;
  constant c_vector_bits  : positive := (g_init_bits + 7) / 8 * 8; -- evaluated at elaboration
  constant c_vector_end   : positive := c_command_bits + c_vector_bits;
  constant c_colour_end   : positive := c_command_bits + word_t'length;
  constant c_count_bits   : positive := 12;

  constant c_read_status : std_logic_vector(7 downto 0) := x"00";
  constant c_vector      : std_logic_vector(7 downto 0) := x"01";
  constant c_frame_end   : std_logic_vector(7 downto 0) := x"02";

  subtype count_t is unsigned(c_count_bits - 1 downto 0);

  constant c_most : count_t := (others => '1');

  -- CRC-16/CCITT-FALSE of one more bit.
  function next_crc (crc : std_logic_vector(15 downto 0); bit_in : std_logic) return std_logic_vector is
    variable shifted : std_logic_vector(15 downto 0);
  begin
    shifted := crc(14 downto 0) & '0';
    if (crc(15) xor bit_in) = '1' then
      shifted := shifted xor x"1021";
    end if;
    return shifted;
  end function;

  type reg_t is record
    -- The pins, one clock after their registers, and before that.
    active      : std_logic;
    was_active  : std_logic;
    clock       : std_logic;
    was_clock   : std_logic;
    data        : std_logic;
    -- The packet.
    count       : count_t; -- bits, at most c_most
    command     : std_logic_vector(7 downto 0);
    crc         : std_logic_vector(15 downto 0);
    background  : word_t;
    room        : std_logic; -- at its start: a vector would be taken
    can_end     : std_logic; -- at its start: an end of frame would be taken
    -- Results.
    valid       : std_logic; -- a vector waits
    frame_end   : std_logic;
    -- Status.
    fault       : std_logic;
    error       : std_logic;
    status      : std_logic_vector(7 downto 0); -- shifted out
    sent_fault  : std_logic; -- in the status byte of this packet
    sent_error  : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal bit_in       : std_logic; -- a bit is received
  signal vector_shift : std_logic;
  signal vector       : std_logic_vector(init_data'range);

begin

  assert c_vector_end + c_crc_bits < 2 ** c_count_bits - 1
    report "spi_receiver: a packet has " & integer'image(c_vector_end + c_crc_bits) & " bits, at most "
    & integer'image(2 ** c_count_bits - 2) & " are counted"
    severity failure;

  bit_in       <= r.active and r.clock and not r.was_clock;
  vector_shift <= bit_in and r.room and flag(r.command = c_vector and r.count >= c_command_bits and r.count < c_vector_end);

  combinational : process (all)
    variable v       : reg_t;
    variable correct : std_logic; -- the packet is complete, and its CRC is right
  begin
    v := r;

    -- Sample the pins.
    v.active     := not select_n;
    v.was_active := r.active;
    v.clock      := clock;
    v.was_clock  := r.clock;
    v.data       := data_in;

    v.frame_end := '0';
    if init_ready = '1' then
      v.valid := '0';
    end if;

    -- Receive a bit, and send the next bit of the status.
    if bit_in = '1' then
      v.crc    := next_crc(r.crc, r.data);
      v.status := r.status(6 downto 0) & '0';
      if r.count /= c_most then
        v.count := r.count + 1;
      end if;
      if r.count < c_command_bits then
        v.command := r.command(6 downto 0) & r.data;
      elsif r.count < c_colour_end then
        v.background := r.background(14 downto 0) & r.data;
      end if;
      -- The status byte is sent: forget what it has reported.
      if r.count = c_command_bits - 1 then
        v.fault := r.fault and not r.sent_fault;
        v.error := r.error and not r.sent_error;
      end if;
    end if;

    -- At the end of a packet, take it or report it.
    correct := flag(r.crc = x"0000");
    if r.was_active = '1' and r.active = '0' then
      v.room    := '0';
      v.can_end := '0';
    end if;
    if r.was_active = '1' and r.active = '0' and r.count /= 0 then
      if r.command = c_vector and r.count = c_vector_end + c_crc_bits and r.room = '1' and correct = '1' then
        v.valid := '1';
      elsif r.command = c_frame_end and r.count = c_colour_end + c_crc_bits and r.can_end = '1' and correct = '1' then
        v.frame_end := '1';
      elsif not (r.command = c_read_status and r.count = c_command_bits) then
        v.error := '1';
      end if;
    end if;

    -- At the start of a packet, promise room and sample the status.
    if r.was_active = '0' and r.active = '1' then
      v.count      := (others => '0');
      v.command    := (others => '0');
      v.crc        := (others => '1');
      v.can_end    := not ending and not r.frame_end;
      v.room       := v.can_end and not r.valid;
      v.sent_fault := r.fault;
      v.sent_error := r.error;
      v.status     := v.room & not v.can_end & r.fault & r.error & std_logic_vector(shown);
    end if;

    -- Report a fault in a status byte that is sampled after it.
    if fault = '1' then
      v.fault      := '1';
      v.sent_fault := '0';
    end if;
    if reset = '1' then
      v.active     := '0';
      v.was_active := '0';
      v.was_clock  := '1';
      v.count      := (others => '0');
      v.room       := '0';
      v.can_end    := '0';
      v.valid      := '0';
      v.frame_end  := '0';
      v.fault      := '0';
      v.error      := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
      if vector_shift = '1' then
        vector <= vector(g_init_bits - 2 downto 0) & r.data;
      end if;
    end if;
  end process;

  data_out   <= r.status(7);
  init_valid <= r.valid;
  init_data  <= vector;
  frame_end  <= r.frame_end;
  background <= r.background;

end architecture;
