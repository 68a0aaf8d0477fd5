-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The end of a pipeline that never stalls: a place for every word that is in the pipeline. The start of the
--             pipeline claims a place for each word. One registered signal, `room`, stalls the start. With claim =
--             in_valid it is a buffer whose in_ready is `room`.
-- Contract    A place is claimed where claim = '1' at a rising edge. Assert claim only while room = '1': a simulation
--             stops otherwise. The word of the place comes in that clock or a later one: in_valid = '1'. Words come in
--             the order of their claims. A word leaves where out_valid and out_ready are both '1'; out_data does not
--             change while out_valid = '1' and out_ready = '0'. pending: a place is claimed or a word is in the queue.
-- Formats     g_bits of any format
-- Latency     2 clocks from in_valid to out_valid
-- Throughput  1 word per clock, if each word comes at most 2**g_index_bits - 4 clocks after its claim
-- Error       none: each word is output once, unchanged, in order
-- Source      ours: the papers show no receiver that stalls
-- Golden twin model/golden/stream_queue.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity stream_queue is
  generic (
    g_bits       : positive;
    g_index_bits : positive := 3 -- at most 2**g_index_bits - 1 places are claimed
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    claim     : in  std_logic;
    room      : out std_logic; -- a register
    pending   : out std_logic;
    in_valid  : in  std_logic;
    in_data   : in  std_logic_vector(g_bits - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_data  : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of stream_queue is

  constant c_words_bits : positive := 64; -- Verilator copies 64 bits as one word
  constant c_words      : positive := (g_bits + c_words_bits - 1) / c_words_bits; -- evaluated at elaboration

  subtype index_t is unsigned(g_index_bits - 1 downto 0);

  constant c_most : index_t := (others => '1');

  type reg_t is record
    claimed   : index_t; -- places claimed
    room      : std_logic;
    stored    : std_logic; -- a word is in the memory; a register instead of a comparison of the indices, for the clock
    single    : std_logic; -- exactly one word is in the memory
    write     : index_t;
    read      : index_t;
    second    : index_t; -- read + 2
    out_valid : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal advance : std_logic; -- a word moves from the memory to the output
  signal reads   : std_logic; -- the same, from the indices
  signal taken   : std_logic;

begin

  advance <= r.stored and (out_ready or not r.out_valid);
  taken   <= r.out_valid and out_ready;

  -- This form shows a synthesizer that no place is read while it is written; otherwise it adds registers for that case.
  reads <= (out_ready or not r.out_valid) when not (r.write = r.read) else '0';

  combinational : process (all)
    variable v   : reg_t;
    variable two : std_logic; -- two words are in the memory, if any is
  begin
    v := r;
    if claim = '1' and taken = '0' then
      v.claimed := r.claimed + 1;
    elsif claim = '0' and taken = '1' then
      v.claimed := r.claimed - 1;
    end if;
    v.room := '1';
    if v.claimed = c_most then
      v.room := '0';
    end if;
    two := '0';
    if r.write = r.second then
      two := '1';
    end if;
    if in_valid = '1' and advance = '0' then
      v.stored := '1';
      v.single := not r.stored;
    elsif in_valid = '0' and advance = '1' then
      v.stored := not r.single;
      v.single := two;
    end if;
    if in_valid = '1' then
      v.write := r.write + 1;
    end if;
    if advance = '1' then
      v.read   := r.read + 1;
      v.second := r.second + 1;
    end if;
    v.out_valid := r.stored or (r.out_valid and not out_ready);
    if reset = '1' then
      v.claimed   := (others => '0');
      v.room      := '1';
      v.stored    := '0';
      v.single    := '0';
      v.write     := (others => '0');
      v.read      := (others => '0');
      v.second    := resize(to_unsigned(2, g_index_bits + 1), g_index_bits);
      v.out_valid := '0';
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
  check_claim : process (clk)
  begin
    if rising_edge(clk) then
      assert claim /= '1' or r.room /= '0' or reset = '1'
        report "stream_queue: claim while room = '0'"
        severity failure;
    end if;
  end process;

  words : for word in 0 to c_words - 1 generate

    constant c_low  : natural := word * g_bits / c_words; -- evaluated at elaboration
    constant c_high : natural := (word + 1) * g_bits / c_words - 1; -- evaluated at elaboration

    subtype word_t is std_logic_vector(c_high downto c_low);

    type memory_t is array (2 ** g_index_bits - 1 downto 0) of word_t;

    signal places_memory : memory_t;

  begin

    places : process (clk)
    begin
      if rising_edge(clk) then
        if reads = '1' then
          out_data(word_t'range) <= places_memory(to_integer(r.read));
        end if;
        if in_valid = '1' then
          places_memory(to_integer(r.write)) <= in_data(word_t'range);
        end if;
      end if;
    end process;

  end generate;

  room      <= r.room;
  pending   <= '0' when r.claimed = 0 else '1';
  out_valid <= r.out_valid;

end architecture;
