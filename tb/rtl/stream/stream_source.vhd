-- SPDX-License-Identifier: Apache-2.0
-- Resets for three clocks, then offers the first word of each line of a file as a stream: by turns g_pace words at full
-- speed and g_pace words with random pauses before them. The word is 'X' where it is not valid.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity stream_source is
  generic (
    g_file  : string;
    g_pace  : positive;
    g_pause : positive -- a pause ends in one of 2**g_pause clocks
  );
  port (
    clk   : in  std_logic;
    reset : out std_logic := '1';
    valid : out std_logic := '0';
    ready : in  std_logic;
    word  : out std_logic_vector;
    fed   : out boolean := false -- all words are taken
  );
end entity;

architecture sim of stream_source is
begin
  feed : process is
    variable vectors  : vectors_t;
    variable word_now : std_logic_vector(word'range);
    variable random   : unsigned(31 downto 0) := to_unsigned(word'length, 32);
    variable count    : natural               := 0;
  begin
    vectors.open_file(g_file);
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    while vectors.next_vector loop
      vectors.read_word(word_now);
      if (count / g_pace) mod 2 = 1 then
        pause(clk, random, g_pause);
      end if;
      word  <= word_now;
      valid <= '1';
      wait until rising_edge(clk) and ready = '1';
      word  <= (word'range => 'X');
      valid <= '0';
      count := count + 1;
    end loop;
    fed <= true;
    wait;
  end process;
end architecture;
