-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Finds the last word of a frame. A word is output when the next word has come, or when the frame has
--             ended: it is then the last one. Three places: the word at the output, the next word, and one for the
--             word that comes in the clock in which the receiver stalls.
-- Contract    Both streams are valid/ready; in_ready, out_valid and out_last depend on registers only. frame_end is a
--             register: the frame's last word has come. It stays '1' up to and including the clock of done, and no word
--             comes meanwhile. Each frame has one transfer with out_last = '1'. In a frame without words it has no word:
--             out_empty = '1'. done = '1': that transfer is taken in this clock.
-- Formats     g_bits of any format
-- Latency     to out_valid: 1 clock from the next word, none from frame_end
-- Throughput  1 word per clock
-- Error       none: each word is output once, unchanged, in order
-- Source      ours: AXI4-Stream's tlast
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity axi_output is
  generic (
    g_bits : positive
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_data   : in  std_logic_vector(g_bits - 1 downto 0);
    frame_end : in  std_logic;
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_data  : out std_logic_vector(g_bits - 1 downto 0);
    out_last  : out std_logic;
    out_empty : out std_logic;
    done      : out std_logic
  );
end entity;

architecture rtl of axi_output is

  constant c_places : positive := 3;

  subtype word_t is std_logic_vector(g_bits - 1 downto 0);

  type words_t is array (0 to c_places - 1) of word_t;

  subtype count_t is unsigned(1 downto 0);

  type reg_t is record
    ready : std_logic; -- a place is free
    count : count_t; -- words inside
    words : words_t; -- the next word at the output is words(0)
  end record;

  signal r, r_next : reg_t;

  signal following : std_logic; -- another word follows the one at the output
  signal valid     : std_logic;
  signal take      : std_logic; -- a word comes
  signal give      : std_logic; -- a transfer is taken

begin

  following <= r.count(1);
  valid     <= following or frame_end;
  take      <= in_valid and r.ready;
  give      <= valid and out_ready;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    -- Move the words to the output.
    if give = '1' then
      v.words(0) := r.words(1);
      v.words(1) := r.words(2);
      if r.count /= 0 then
        v.count := r.count - 1;
      end if;
    end if;

    -- Store the word that comes in the first free place.
    if take = '1' then
      for place in words_t'range loop
        if v.count = place then
          v.words(place) := in_data;
        end if;
      end loop;
      v.count := v.count + 1;
    end if;
    v.ready := '1';
    if v.count = c_places then
      v.ready := '0';
    end if;
    if reset = '1' then
      v.ready := '0';
      v.count := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  in_ready  <= r.ready;
  out_valid <= valid;
  out_data  <= r.words(0);
  out_last  <= not following;
  out_empty <= not following and not r.count(0);
  done      <= give and not following;

end architecture;
