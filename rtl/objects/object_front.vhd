-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The system of object processors: triangles and shadow polygons in, for each pixel of a strip the sorted list of
--             what is not hidden out, as tokens of the shading processors.
--
--               vectors --> object_source --> object_processor 1 --> ... --> object_processor g_objects --> object_output --> tokens
--
--             Each processor holds one triangle. A line of a strip must not need more than g_objects of them; one that has
--             ended takes the next one. The tokens depend neither on the number of processors nor on the order of the
--             triangles that start on one line. Exception: a triangle that is cut into several walks may have two elements
--             with equal depth and number in one pixel. Their order is that of the processors; their masks do not
--             overlap.
-- Contract    Both streams are valid/ready. in_vector must not change while it waits; see object_source for the order of
--             vectors. in_ready depends on in_valid and in_vector in the same clock, not on token_ready. token_mask and
--             token_ends: see object_output. They and token do not change while the token waits.
--             fault stays '1' after a triangle for which no processor was free, and as in object_source. Then discard
--             all tokens. busy: a word is in the chain, or a strip is not scanned to its end.
-- Formats     in_vector: processors_pkg; see object_source and object_processor. token: token_pkg
-- Latency     2 clocks per processor, and 2
-- Throughput  1 head or element per clock
-- Error       see raster_interpolator
-- Source      processors paper, section 2; Schneider and Claussen 1988 (a distributed z-buffer)
-- Golden twin model/golden/object_front.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.objects_pkg.all;

entity object_front is
  generic (
    g_config    : config_t := c_default_config;
    g_subpixels : positive := 1; -- 1, 4 or 16
    g_objects   : positive := 4  -- processors
  );
  port (
    clk         : in  std_logic;
    reset       : in  std_logic;
    in_valid    : in  std_logic;
    in_ready    : out std_logic;
    in_vector   : in  std_logic_vector(init_bits(g_config) - 1 downto 0);
    token_valid : out std_logic;
    token_ready : in  std_logic;
    token       : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    token_mask  : out std_logic_vector(g_subpixels - 1 downto 0);
    token_ends  : out std_logic;
    busy        : out std_logic;
    fault       : out std_logic
  );
end entity;

architecture rtl of object_front is

  type words_t is array (0 to g_objects) of std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);

  -- Before each processor, and after the last.
  signal valid      : std_logic_vector(0 to g_objects);
  signal ready      : std_logic_vector(0 to g_objects);
  signal words      : words_t;
  signal works      : std_logic_vector(0 to g_objects + 1);
  signal order_lost : std_logic; -- fault of object_source
  signal none_free  : std_logic;

begin

  source : entity work.object_source
    generic map (
      g_config    => g_config,
      g_subpixels => g_subpixels
      )
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => in_valid,
      in_ready  => in_ready,
      in_vector => in_vector,
      out_valid => valid(0),
      out_ready => ready(0),
      out_word  => words(0),
      busy      => works(g_objects),
      fault     => order_lost
      );

  chain : for i in 0 to g_objects - 1 generate

    processor : entity work.object_processor
      generic map (
        g_config    => g_config,
        g_subpixels => g_subpixels
        )
      port map (
        clk       => clk,
        reset     => reset,
        in_valid  => valid(i),
        in_ready  => ready(i),
        in_word   => words(i),
        out_valid => valid(i + 1),
        out_ready => ready(i + 1),
        out_word  => words(i + 1),
        busy      => works(i)
        );

  end generate;

  tokens : entity work.object_output
    generic map (
      g_config    => g_config,
      g_subpixels => g_subpixels
      )
    port map (
      clk         => clk,
      reset       => reset,
      in_valid    => valid(g_objects),
      in_ready    => ready(g_objects),
      in_word     => words(g_objects),
      token_valid => token_valid,
      token_ready => token_ready,
      token       => token,
      token_mask  => token_mask,
      token_ends  => token_ends,
      busy        => works(g_objects + 1),
      fault       => none_free
      );

  busy  <= or works;
  fault <= order_lost or none_free;

end architecture;
