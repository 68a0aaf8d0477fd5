-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A second buffer for a triangle's init vector, from which the interpolators load their words. They load
--             after the walker has started the triangle, part by part; meanwhile the init buffer takes the next vector.
--
--               init buffer --+--> header --> triangle_walker --> start, strobes --+
--                             |                                                    v
--                             +--> words ---> word_buffer ----> words -----> interpolators
--
-- Contract    in_valid is '1' while in_data is a vector. A vector is stable and stays for 2 clocks or more. It leaves
--             before its triangle starts, or in the clock of start. It leaves at least 2 clocks after the start of the
--             previous triangle. start is '1' in the clock in which the walker starts the triangle. The
--             interpolators load one clock later. The depth words and the channels' words of out_data are skewed words
--             (skew_pkg); the rest of the header is zero
-- Formats     formats_pkg: init
-- Latency     1 clock from a vector in an empty buffer to part 0 of its words
-- Throughput  1 vector in 2 clocks
-- Error       none
-- Source      quadratic paper, section 6: initialization of the next triangle while this one is drawn
-- Golden twin none: a delay

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.quadratic_pkg.all;

entity word_buffer is
  generic (
    g_exact    : boolean  := true;
    g_channels : positive := 3;
    g_degree   : positive := 2; -- of the channels: see quadratic_pkg
    g_parts    : positive := 2
  );
  port (
    clk      : in  std_logic;
    reset    : in  std_logic;
    in_valid : in  std_logic;
    in_data  : in  std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0);
    start    : in  std_logic;
    out_data : out std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0)
  );
end entity;

architecture rtl of word_buffer is

  -- The depth words are the last of the header; the channels' words follow them.
  constant c_depth_low    : positive := init_header(g_exact).z.low;
  constant c_depth_bits   : positive := formats(g_exact).depth_sum.bits;
  constant c_channels_low : positive := init_bits(g_exact, 0);
  constant c_value_bits   : positive := formats(g_exact).intensity.bits;

  type reg_t is record
    full : std_logic; -- the words of a triangle that has not started
  end record;

  signal r, r_next : reg_t;

  signal copy : std_logic;

begin

  -- Copy the next vector as soon as the triangle before it has started.
  copy <= in_valid and not r.full;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.full := (r.full or copy) and not start;
    if reset = '1' then
      v.full := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  out_data(c_depth_low - 1 downto 0) <= (others => '0');

  depth_words : entity work.skewed_register
    generic map (
      g_bits  => c_depth_bits,
      g_words => (c_channels_low - c_depth_low) / c_depth_bits, -- evaluated at elaboration
      g_parts => g_parts)
    port map (
      clk   => clk,
      load  => copy,
      start => in_data(c_channels_low - 1 downto c_depth_low),
      value => out_data(c_channels_low - 1 downto c_depth_low));

  channel_words : entity work.skewed_register
    generic map (
      g_bits  => c_value_bits,
      g_words => (in_data'length - c_channels_low) / c_value_bits, -- evaluated at elaboration
      g_parts => g_parts)
    port map (
      clk   => clk,
      load  => copy,
      start => in_data(in_data'high downto c_channels_low),
      value => out_data(in_data'high downto c_channels_low));

end architecture;
