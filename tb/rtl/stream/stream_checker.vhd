-- SPDX-License-Identifier: Apache-2.0
-- Clocks, resets and feeds an entity with a stream at both ends, and compares each word that leaves it with a file: at full
-- speed, with a slow source, with a slow sink, and with both. The entity is busy while a word leaves, and is not at the
-- end. At the end fault has its expected value.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity stream_checker is
  generic (
    g_file   : string;             -- without _in.txt and _out.txt
    g_fault  : std_logic := '0';
    g_passes : boolean   := false; -- words pass while the entity is not busy
    g_pace   : positive  := 60;    -- number of words between changes of the pace of the source; twice as many: of the sink
    g_widths : integer_vector      -- bits of the words of a row of _out.txt
  );
  port (
    clk       : buffer std_logic := '0';
    reset     : buffer std_logic;
    in_valid  : out    std_logic;
    in_ready  : in     std_logic;
    in_word   : out    std_logic_vector;
    out_valid : in     std_logic;
    out_ready : buffer std_logic;
    out_word  : in     std_logic_vector;
    busy      : in     std_logic;
    fault     : in     std_logic
  );
end entity;

architecture sim of stream_checker is
  -- Clocks after the last word in which nothing more may leave.
  constant c_rest : positive := 400;

  signal running, fed : boolean := false;
  signal words        : std_logic_vector(out_word'length - 1 downto 0);
begin
  words <= out_word;

  clk <= not clk after c_half_period when running;

  source : entity work.stream_source
    generic map (g_file => g_file & "_in.txt", g_pace => g_pace, g_pause => 2)
    port map (clk => clk, reset => reset, valid => in_valid, ready => in_ready, word => in_word, fed => fed);

  sink : entity work.stream_sink
    generic map (g_name => g_file, g_pace => 2 * g_pace, g_pause => 2)
    port map (clk => clk, reset => reset, valid => out_valid, ready => out_ready, word => out_word);

  check : process is
    variable vectors : vectors_t;
    variable still   : natural := 0; -- clocks without a word
    variable low     : natural;
  begin
    take_turn;
    running <= true;
    vectors.open_file(g_file & "_out.txt");
    while vectors.next_vector loop
      loop
        wait until rising_edge(clk) and reset = '0';
        exit when out_valid = '1' and out_ready = '1';
        still := still + 1;
        if still > 100000 then
          vectors.fail("this word does not leave");
        end if;
      end loop;
      if busy /= '1' and not g_passes then
        vectors.fail("a word leaves, but busy is " & to_string(busy));
      end if;
      still := 0;
      low   := 0;
      for i in g_widths'range loop
        vectors.check("word " & to_string(i), words(low + g_widths(i) - 1 downto low));
        low := low + g_widths(i);
      end loop;
    end loop;
    if not fed then
      wait until fed for 100000 * c_half_period;
    end if;
    for i in 1 to c_rest loop
      wait until rising_edge(clk);
      if out_valid /= '0' then
        vectors.fail("a word more than there are");
      end if;
    end loop;
    if not fed then
      vectors.fail("not all words are taken");
    end if;
    if busy /= '0' then
      vectors.fail("busy after the last word");
    end if;
    if fault /= g_fault then
      vectors.fail("fault is " & to_string(fault));
    end if;
    running <= false;
    end_turn(finished);
  end process;
end architecture;
