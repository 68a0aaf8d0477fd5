-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Delays a word by g_depth clocks with enable, for words that accompany a pipeline: a shift register.
-- Contract    `delayed` is undefined until g_depth words have been taken
-- Formats     g_bits of any format
-- Latency     g_depth clocks with enable
-- Throughput  1 word per clock
-- Error       none
-- Source      ours: the papers have no pipeline of this depth
-- Golden twin model/golden/delay_line.hpp

library ieee;
use ieee.std_logic_1164.all;

entity delay_line is
  generic (
    g_bits  : positive;
    g_depth : natural -- 0: no delay
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    word    : in  std_logic_vector(g_bits - 1 downto 0);
    delayed : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of delay_line is

  subtype word_t is std_logic_vector(g_bits - 1 downto 0);

  type words_t is array (natural range <>) of word_t;

begin

  direct : if g_depth = 0 generate

    delayed <= word;

  else generate

    signal words : words_t(1 to g_depth); -- words(i): taken i clocks with enable ago

  begin

    registers : process (clk)
    begin
      if rising_edge(clk) then
        if enable = '1' then
          words <= word & words(1 to g_depth - 1);
        end if;
      end if;
    end process;

    delayed <= words(g_depth);

  end generate;

end architecture;
