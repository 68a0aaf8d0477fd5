-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Adds the terms of each channel and saturates the sum to a colour. With one channel the three colours are
--             equal.
-- Contract    colours do not change without enable. One term of each channel contains the 0.5 that rounds the colour
--             (saturating_sum).
-- Formats     terms: g_terms groups, each with a term of term_bits (spherical_pkg) per channel, the first group and the
--             first channel lowest; colours: colour of formats_pkg, red lowest
-- Latency     1 clock from terms with enable to their colours
-- Throughput  1 pixel per clock
-- Error       the sum is exact and rounded once
-- Source      spherical paper, section 4 and figure 12 (the adders of red, green and blue)
-- Golden twin model/golden/colour_sum.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;

entity colour_sum is
  generic (
    g_exact     : boolean  := true;
    g_channels  : positive := 3;
    g_terms     : positive := 3; -- of a channel
    g_data_bits : positive := 8  -- of a light's sample
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    terms   : in  std_logic_vector(g_terms * g_channels * term_bits(g_exact, g_data_bits) - 1 downto 0);
    colours : out std_logic_vector(3 * formats(g_exact).colour.bits - 1 downto 0)
  );
end entity;

architecture rtl of colour_sum is

  constant c_term_bits : positive := term_bits(g_exact, g_data_bits);
  constant c_colour    : positive := formats(g_exact).colour.bits;

  signal sums : std_logic_vector(g_channels * c_colour - 1 downto 0);

begin

  assert g_channels = 1 or g_channels = 3
    report "colour_sum: g_channels is " & integer'image(g_channels) & ", not 1 (grey) or 3 (red, green, blue)"
    severity failure;

  channels : for channel in 0 to g_channels - 1 generate

    signal channel_terms : std_logic_vector(g_terms * c_term_bits - 1 downto 0);

  begin

    -- Take the channel's term of every group.
    groups : for group_number in 0 to g_terms - 1 generate

      constant c_term : natural := group_number * g_channels + channel;

    begin

      channel_terms((group_number + 1) * c_term_bits - 1 downto group_number * c_term_bits) <=
        terms((c_term + 1) * c_term_bits - 1 downto c_term * c_term_bits);

    end generate;

    sum : entity work.saturating_sum
      generic map (
        g_terms         => g_terms,
        g_term_bits     => c_term_bits,
        g_fraction_bits => formats(g_exact).factor.fraction + g_data_bits,
        g_result_bits   => c_colour
        )
      port map (
        clk    => clk,
        enable => enable,
        terms  => channel_terms,
        result => sums((channel + 1) * c_colour - 1 downto channel * c_colour)
        );

  end generate;

  three : for colour in 0 to 2 generate

    -- With one channel, copy it to all three colours.
    constant c_from : natural := colour * boolean'pos(g_channels > 1);

  begin

    colours((colour + 1) * c_colour - 1 downto colour * c_colour) <=
      sums((c_from + 1) * c_colour - 1 downto c_from * c_colour);

  end generate;

end architecture;
