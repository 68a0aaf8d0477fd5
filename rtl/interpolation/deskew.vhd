-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Aligns the parts of a skewed word (skew_pkg): each part waits for the part above it.
-- Formats     g_bits of anything
-- Latency     g_parts - 1 clocks from part 0 of skewed to the word
-- Throughput  1 word per clock
-- Error       none
-- Source      skew_pkg
-- Golden twin none: a delay

library ieee;
use ieee.std_logic_1164.all;
use work.skew_pkg.all;

entity deskew is
  generic (
    g_bits  : positive;
    g_parts : positive := 1
  );
  port (
    clk    : in  std_logic;
    skewed : in  std_logic_vector(g_bits - 1 downto 0);
    word   : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of deskew is

begin

  parts : for part in 0 to g_parts - 1 generate

    constant c_low    : natural := part_low(g_bits, g_parts, part);
    constant c_high   : natural := part_low(g_bits, g_parts, part + 1) - 1;
    constant c_clocks : natural := g_parts - 1 - part; -- until the last part is valid

    type history_t is array (0 to c_clocks) of std_logic_vector(c_high - c_low downto 0);

    signal history : history_t; -- the part now, one clock ago, and so on

  begin

    history(0) <= skewed(c_high downto c_low);

    delays : for clock in 1 to c_clocks generate

      registers : process (clk)
      begin
        if rising_edge(clk) then
          history(clock) <= history(clock - 1);
        end if;
      end process;

    end generate;

    word(c_high downto c_low) <= history(c_clocks);

  end generate;

end architecture;
