-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     I_out = I_in + term for each channel, clamped to the largest value. Without add, I_out = I_in.
-- Formats     radiance, result: radiance, terms: product_bits of terms_pkg, a word per channel, the first lowest
-- Latency     1 clock with enable
-- Throughput  1 colour per clock
-- Error       (-1, 0] steps of radiance: the term is cut
-- Source      processors paper, equation 5 and figure 1: the vector addition
-- Golden twin model/golden/radiance_sum.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.terms_pkg.all;

entity radiance_sum is
  generic (
    g_exact    : boolean              := true;
    g_channels : natural range 1 to 3 := 3
  );
  port (
    clk      : in  std_logic;
    enable   : in  std_logic;
    add      : in  std_logic;
    radiance : in  std_logic_vector(g_channels * formats(g_exact).radiance.bits - 1 downto 0);
    terms    : in  std_logic_vector(g_channels * product_bits(g_exact) - 1 downto 0);
    result   : out std_logic_vector(g_channels * formats(g_exact).radiance.bits - 1 downto 0)
  );
end entity;

architecture rtl of radiance_sum is

begin

  registers : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        result <= radiance;
        if add = '1' then
          result <= brightened(g_exact, radiance, terms, g_channels);
        end if;
      end if;
    end if;
  end process;

end architecture;
