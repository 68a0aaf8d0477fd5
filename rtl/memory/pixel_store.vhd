-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The memories of the blocks in flight: depth, colour and a keep bit of each pixel, a beat per place. The
--             depths are stored twice, for two readers.
-- Contract    pixel_write: a bit per lane, of one pixel. A place is not read in the clock in which it is written.
-- Formats     memory_pkg: a place is slot and beat; the lowest lane is lowest
-- Latency     1 clock from an address to its words
-- Throughput  1 beat per clock for each reader
-- Error       none
-- Source      ours
-- Golden twin none: it holds words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity pixel_store is
  generic (
    g_bits       : positive; -- of a depth and of a colour
    g_lane_bits  : natural;
    g_place_bits : positive
  );
  port (
    clk          : in  std_logic;
    pixel_write  : in  std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    pixel_place  : in  unsigned(g_place_bits - 1 downto 0);
    pixel_depth  : in  std_logic_vector(g_bits - 1 downto 0);
    pixel_colour : in  std_logic_vector(g_bits - 1 downto 0);
    -- For the depth test.
    test_place   : in  unsigned(g_place_bits - 1 downto 0);
    test_depth   : out std_logic_vector(2 ** g_lane_bits * g_bits - 1 downto 0);
    keep_write   : in  std_logic;
    keep_place   : in  unsigned(g_place_bits - 1 downto 0);
    keep_bits    : in  std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    -- For the write.
    place        : in  unsigned(g_place_bits - 1 downto 0);
    keep         : out std_logic_vector(2 ** g_lane_bits - 1 downto 0);
    depth        : out std_logic_vector(2 ** g_lane_bits * g_bits - 1 downto 0);
    colour       : out std_logic_vector(2 ** g_lane_bits * g_bits - 1 downto 0)
  );
end entity;

architecture rtl of pixel_store is

  constant c_places : positive := 2 ** g_place_bits;

  type keep_t is array (c_places - 1 downto 0) of std_logic_vector(keep'range);

  signal keep_memory : keep_t;

begin

  lanes : for lane in pixel_write'range generate

    constant c_low : natural := lane * g_bits;

    type words_t is array (c_places - 1 downto 0) of std_logic_vector(g_bits - 1 downto 0);

    signal test_memory, depth_memory, colour_memory : words_t;

  begin

    -- One port writes and one port reads: block RAMs.
    memories : process (clk)
    begin
      if rising_edge(clk) then
        test_depth(c_low + g_bits - 1 downto c_low) <= test_memory(to_integer(test_place));
        depth(c_low + g_bits - 1 downto c_low)      <= depth_memory(to_integer(place));
        colour(c_low + g_bits - 1 downto c_low)     <= colour_memory(to_integer(place));
        if pixel_write(lane) = '1' then
          test_memory(to_integer(pixel_place))   <= pixel_depth;
          depth_memory(to_integer(pixel_place))  <= pixel_depth;
          colour_memory(to_integer(pixel_place)) <= pixel_colour;
        end if;
      end if;
    end process;

  end generate;

  kept : process (clk)
  begin
    if rising_edge(clk) then
      keep <= keep_memory(to_integer(place));
      if keep_write = '1' then
        keep_memory(to_integer(keep_place)) <= keep_bits;
      end if;
    end if;
  end process;

end architecture;
