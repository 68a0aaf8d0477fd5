-- SPDX-License-Identifier: Apache-2.0
-- Accepts the words of a stream: by turns g_pace words at full speed and g_pace words with random stalls. A word that
-- waits must not change.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity stream_sink is
  generic (
    g_name  : string;
    g_pace  : positive;
    g_pause : positive -- ready is '1' in one of 2**g_pause clocks
  );
  port (
    clk   : in     std_logic;
    reset : in     std_logic;
    valid : in     std_logic;
    ready : buffer std_logic := '0';
    word  : in     std_logic_vector
  );
end entity;

architecture sim of stream_sink is
begin
  accept_words : process (clk) is
    variable random : unsigned(31 downto 0) := to_unsigned(3 * word'length, 32);
    variable count  : natural               := 0;
  begin
    if rising_edge(clk) and reset = '0' then
      if valid = '1' and ready = '1' then
        count := count + 1;
      end if;
      random := next_random(random);
      ready  <= to_flag((count / g_pace) mod 2 = 0 or chance(random(31 downto 24), g_pause));
    end if;
  end process;

  steady : process (clk) is
    variable waiting : boolean := false;
    variable held    : std_logic_vector(word'range);
  begin
    if rising_edge(clk) then
      assert not waiting or (valid = '1' and word = held)
        report g_name & ": a word changes while it waits" severity failure;
      waiting := valid = '1' and ready = '0' and reset = '0';
      held    := word;
    end if;
  end process;
end architecture;
