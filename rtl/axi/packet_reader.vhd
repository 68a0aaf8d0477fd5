-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Makes items of packets of 32-bit words: a vector, the end of a frame, or a packet that is not one. A
--             packet whose kind the hardware does not take, or whose number of words is not that of its kind, is
--             discarded whole and is an item with its cause.
-- Contract    in is a stream of words, axi_pkg describes packets. A packet ends with the words that its header
--             announces, or with in_last = '1' before: then its length is wrong. in_last = '1' at its last word changes
--             nothing. out is valid/ready and does not change while it waits. All outputs depend on registers only.
--             out_cause /= c_no_fault: no vector; out_end = '1': the end of a frame, without a vector. Bits of out_vector
--             above those of its packet are zero.
-- Formats     axi_pkg: packets
-- Latency     2 clocks from a packet's last word to its item
-- Throughput  a packet of n bus words in n + 2 clocks
-- Error       none: vectors are passed unchanged, in order
-- Source      ours: AMBA 4 AXI4-Stream
-- Golden twin model/golden_run/packets.hpp writes what this entity reads

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.line_pkg.flag;

entity packet_reader is
  generic (
    g_bits     : positive         := 32; -- of a vector
    g_lengths  : packet_lengths_t := (others => 1);
    g_bus_bits : positive         := 32 -- 32 or 64
  );
  port (
    clk        : in  std_logic;
    reset      : in  std_logic;
    in_valid   : in  std_logic;
    in_ready   : out std_logic;
    in_data    : in  std_logic_vector(g_bus_bits - 1 downto 0);
    in_last    : in  std_logic;
    out_valid  : out std_logic;
    out_ready  : in  std_logic;
    out_end    : out std_logic;
    out_kind   : out unsigned(15 downto 0);
    out_cause  : out cause_t;
    out_vector : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of packet_reader is

  constant c_lanes : positive := g_bus_bits / c_word_bits; -- evaluated at elaboration
  constant c_words : positive := words_of(g_bits);

  subtype half_t   is unsigned(15 downto 0); -- of a header word
  subtype beat_t   is unsigned(half_t'length downto 0);
  subtype vector_t is std_logic_vector(c_words * c_word_bits - 1 downto 0);

  type reg_t is record
    ready  : std_logic; -- a word can be taken
    opened : std_logic; -- a header has been taken, but not its packet's last word
    left   : beat_t;    -- bus words of the packet still to come
    beat   : half_t;    -- number of the next bus word in its packet
    kind   : half_t;    -- of the header
    length : half_t;
    check  : std_logic; -- the packet's last word has been taken
    cut    : std_logic; -- before the last one that the header announces
    vector : vector_t;
    valid  : std_logic; -- an item waits
    is_end : std_logic;
    cause  : cause_t;
  end record;

  signal r, r_next : reg_t;

  -- Bus words after the header's.
  function beats_after (length : half_t) return beat_t is
    constant c_pairs : half_t := '0' & length(15 downto 1); -- the header and its pad make one more
  begin
    if c_lanes = 2 then
      return resize(c_pairs, beat_t'length);
    end if;
    return c_pairs & '1';
  end function;

  -- What is wrong with a header.
  function cause_of (kind, length : half_t) return cause_t is
  begin
    if kind = c_end_packet then
      if length /= 0 then
        return c_wrong_length;
      end if;
      return c_no_fault;
    end if;
    for known in packet_lengths_t'range loop
      if kind = known and g_lengths(known) > 0 then
        if length /= g_lengths(known) then
          return c_wrong_length;
        end if;
        return c_no_fault;
      end if;
    end loop;
    return c_wrong_kind;
  end function;

begin

  assert g_bus_bits = 32 or g_bus_bits = 64
    report "packet_reader: g_bus_bits is " & integer'image(g_bus_bits) & ", it must be 32 or 64"
    severity failure;

  combinational : process (all)
    variable v      : reg_t;
    variable length : half_t;
    variable whole  : boolean; -- the announced words have come
    variable word   : integer;
  begin
    v := r;
    -- Give the item.
    if r.valid = '1' and out_ready = '1' then
      v.valid := '0';
    end if;

    -- Take a word.
    length := unsigned(in_data(31 downto 16));
    if r.opened = '1' then
      whole := r.left = 1;
    else
      whole := beats_after(length) = 0;
    end if;
    if in_valid = '1' and r.ready = '1' then
      v.opened := '1';
      v.left   := r.left - 1;
      v.beat   := r.beat + 1;
      if r.opened = '0' then
        v.left   := beats_after(length);
        v.kind   := unsigned(in_data(15 downto 0));
        v.length := length;
        v.vector := (others => '0');
      end if;

      -- Store the vector's words that it contains.
      for beat in 0 to c_words loop
        for lane in 0 to c_lanes - 1 loop
          word := beat * c_lanes + lane - 1;
          if r.beat = beat and word >= 0 and word < c_words then
            v.vector((word + 1) * c_word_bits - 1 downto word * c_word_bits)
              := in_data((lane + 1) * c_word_bits - 1 downto lane * c_word_bits);
          end if;
        end loop;
      end loop;

      -- End a packet.
      if whole or in_last = '1' then
        v.opened := '0';
        v.beat   := (others => '0');
        v.check  := '1';
        v.cut    := flag(not whole);
      end if;
    end if;

    -- Check the packet.
    if r.check = '1' then
      v.check  := '0';
      v.valid  := '1';
      v.is_end := flag(r.kind = c_end_packet);
      v.cause  := cause_of(r.kind, r.length);
      if r.cut = '1' and v.cause = c_no_fault then
        v.cause := c_wrong_length;
      end if;
    end if;

    v.ready := not v.check and not v.valid;
    if reset = '1' then
      v.ready  := '0';
      v.opened := '0';
      v.beat   := (others => '0');
      v.check  := '0';
      v.valid  := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  in_ready   <= r.ready;
  out_valid  <= r.valid;
  out_end    <= r.is_end;
  out_kind   <= r.kind;
  out_cause  <= r.cause;
  out_vector <= r.vector(g_bits - 1 downto 0);

end architecture;
