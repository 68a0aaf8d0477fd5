-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Requests the stored depths of blocks, one burst each, in order. A block waits as long as an older block that
--             has beats in common with it has not been retired. A block of a clear is not read, but it waits the same way.
-- Contract    Blocks have the slots 0, 1, ... in this order, again and again. The input is valid/ready, and a block that
--             waits does not change. out_valid = '1': the block in front of the input is requested; it must be taken in
--             this clock. retire = '1': the oldest of these blocks has no write without a response any more. At most
--             2**g_slot_bits blocks are not retired.
--             AXI4: m_axi_arvalid and its address depend on registers only.
-- Formats     a block's number, its address without the lowest bits, and its first and last beat
-- Latency     2 clocks from a block to m_axi_arvalid, 3 to out_valid
-- Throughput  1 block in 2 clocks
-- Error       none
-- Source      ours
-- Golden twin none: it passes addresses

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.memory_pkg.all;
use work.line_pkg.flag;

entity block_reader is
  generic (
    g_number_bits : positive; -- of a block's number
    g_mask_bits   : positive;
    g_beat_bits   : positive;
    g_slot_bits   : positive
  );
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    in_valid      : in  std_logic;
    in_ready      : out std_logic;
    in_fill       : in  std_logic; -- of a clear
    in_mask       : in  std_logic_vector(g_mask_bits - 1 downto 0);
    in_depth      : in  unsigned(g_number_bits - 1 downto 0);
    in_colour     : in  unsigned(g_number_bits - 1 downto 0);
    in_first      : in  unsigned(g_beat_bits - 1 downto 0);
    in_last       : in  unsigned(g_beat_bits - 1 downto 0);
    out_valid     : out std_logic;
    out_ready     : in  std_logic;
    out_fill      : out std_logic;
    out_mask      : out std_logic_vector(g_mask_bits - 1 downto 0);
    out_depth     : out unsigned(g_number_bits - 1 downto 0);
    out_colour    : out unsigned(g_number_bits - 1 downto 0);
    out_first     : out unsigned(g_beat_bits - 1 downto 0);
    out_last      : out unsigned(g_beat_bits - 1 downto 0);
    retire        : in  std_logic;
    m_axi_arvalid : out std_logic;
    m_axi_arready : in  std_logic;
    ar_block      : out unsigned(g_number_bits - 1 downto 0);
    ar_first      : out unsigned(g_beat_bits - 1 downto 0);
    ar_length     : out unsigned(g_beat_bits - 1 downto 0) -- beats - 1
  );
end entity;

architecture rtl of block_reader is

  constant c_slots : positive := 2 ** g_slot_bits;

  subtype slot_t is unsigned(g_slot_bits - 1 downto 0);
  subtype slots_t is std_logic_vector(c_slots - 1 downto 0);

  type place_t is record
    number : unsigned(in_depth'range);
    first  : unsigned(in_first'range);
    last   : unsigned(in_last'range);
  end record;

  type places_t is array (c_slots - 1 downto 0) of place_t;

  type reg_t is record
    places   : places_t; -- blocks that were requested
    busy     : slots_t; -- and are not retired
    slot     : slot_t; -- of the block at the input
    oldest   : slot_t;
    compared : std_logic; -- the block at the input has been compared with places
    conflict : slots_t; -- and has beats in common with these
    valid    : std_logic; -- a request waits
    request  : place_t;
  end record;

  signal r, r_next : reg_t;

  signal block_in : place_t;
  signal go       : std_logic; -- the block at the input is requested

  constant c_word_bits : positive := 1 + g_mask_bits + 2 * g_number_bits + 2 * g_beat_bits;

  signal queue_in, queue_out : std_logic_vector(c_word_bits - 1 downto 0);

begin

  block_in <= (in_depth, in_first, in_last);
  go <= in_valid and r.compared and flag(r.conflict = (slots_t'range => '0'))
    and (in_fill or m_axi_arready or not r.valid);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Retire the oldest block.
    if retire = '1' then
      v.busy(to_integer(r.oldest)) := '0';
      v.oldest := r.oldest + 1;
    end if;

    -- Compare the block at the input with those before it.
    v.compared := in_valid and not go;
    for i in slots_t'range loop
      v.conflict(i) := v.busy(i) and flag(r.places(i).number = in_depth and r.places(i).first <= in_last
        and r.places(i).last >= in_first);
    end loop;

    -- Request the block.
    if m_axi_arready = '1' then
      v.valid := '0';
    end if;
    if go = '1' then
      v.places(to_integer(r.slot)) := block_in;
      v.busy(to_integer(r.slot))   := '1';
      v.slot := r.slot + 1;
      if in_fill = '0' then
        v.valid   := '1';
        v.request := block_in;
      end if;
    end if;
    if reset = '1' then
      v.busy     := (others => '0');
      v.slot     := (others => '0');
      v.oldest   := (others => '0');
      v.compared := '0';
      v.valid    := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Blocks that wait for their depths.
  queue_in <= in_fill & in_mask & std_logic_vector(in_depth) & std_logic_vector(in_colour)
    & std_logic_vector(in_first) & std_logic_vector(in_last);

  queue : entity work.stream_queue
    generic map (
      g_bits       => c_word_bits,
      g_index_bits => g_slot_bits + 1
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => go,
      room      => open,
      pending   => open,
      in_valid  => go,
      in_data   => queue_in,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => queue_out
      );

  out_fill   <= queue_out(c_word_bits - 1);
  out_mask   <= queue_out(c_word_bits - 2 downto c_word_bits - 1 - g_mask_bits);
  out_depth  <= unsigned(queue_out(2 * g_number_bits + 2 * g_beat_bits - 1 downto g_number_bits + 2 * g_beat_bits));
  out_colour <= unsigned(queue_out(g_number_bits + 2 * g_beat_bits - 1 downto 2 * g_beat_bits));
  out_first  <= unsigned(queue_out(2 * g_beat_bits - 1 downto g_beat_bits));
  out_last   <= unsigned(queue_out(g_beat_bits - 1 downto 0));

  in_ready      <= go;
  m_axi_arvalid <= r.valid;
  ar_block      <= r.request.number;
  ar_first      <= r.request.first;
  ar_length     <= r.request.last - r.request.first;

end architecture;
