-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Delays a word by g_depth clocks, for words that accompany a pipeline. Contains a circular buffer of
--             g_depth - 1 words and a register, so that each clock writes only one word at any depth.
-- Contract    `delayed` is undefined until g_depth words have been taken
-- Formats     g_bits of any format
-- Latency     g_depth clocks with enable
-- Throughput  1 word per clock
-- Source      ours: the papers have no pipeline of this depth
-- Golden twin model/golden/delay_line.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity delay_line is
  generic (
    g_bits  : positive;
    g_depth : natural -- 0: no delay
  );
  port (
    clk     : in  std_logic;
    reset   : in  std_logic;
    enable  : in  std_logic;
    word    : in  std_logic_vector(g_bits - 1 downto 0);
    delayed : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of delay_line is

  subtype word_t is std_logic_vector(g_bits - 1 downto 0);

begin

  places : if g_depth = 0 generate

    delayed <= word;

  elsif g_depth = 1 generate

    registers : process (clk)
    begin
      if rising_edge(clk) then
        if enable = '1' then
          delayed <= word;
        end if;
      end if;
    end process;

  elsif g_depth = 2 generate

    signal before : word_t;

    begin

      registers : process (clk)
      begin
        if rising_edge(clk) then
          if enable = '1' then
            before  <= word;
            delayed <= before;
          end if;
        end if;
      end process;

  else generate

    constant c_places : positive := g_depth - 1;

    function index_bits return positive is
      variable bits : positive := 1;
    begin
      while 2 ** bits < c_places loop
        bits := bits + 1;
      end loop;
      return bits;
    end function;

    subtype index_t is unsigned(index_bits - 1 downto 0);

    -- Round up to a power of two, so that every index is in the array.
    type memory_t is array (2 ** index_bits - 1 downto 0) of word_t;

    signal index : index_t;

    begin

      count : process (clk)
      begin
        if rising_edge(clk) then
          if reset = '1' then
            index <= (others => '0');
          elsif enable = '1' then
            index <= index + 1;
            if index = c_places - 1 then
              index <= (others => '0');
            end if;
          end if;
        end if;
      end process;

      -- A variable, because GHDL keeps a driver for every bit of a signal.
      buffered : process (clk)
        variable memory : memory_t;
      begin
        if rising_edge(clk) then
          if enable = '1' then
            delayed                   <= memory(to_integer(index));
            memory(to_integer(index)) := word;
          end if;
        end if;
      end process;

  end generate;

end architecture;
