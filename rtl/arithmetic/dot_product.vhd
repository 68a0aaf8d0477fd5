-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Dot product of two vectors of three components.
-- Formats     a, b: components of g_bits, signed, x lowest; sum: signed, 2 g_bits + 1
-- Latency     1 clock with enable (shading_pkg)
-- Throughput  1 vector per clock
-- Error       none
-- Source      processors paper, figures 1 and 2
-- Golden twin model/golden/dot_product.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

entity dot_product is
  generic (
    g_bits : positive
  );
  port (
    clk    : in  std_logic;
    enable : in  std_logic;
    a      : in  std_logic_vector(c_axes * g_bits - 1 downto 0);
    b      : in  std_logic_vector(c_axes * g_bits - 1 downto 0);
    sum    : out std_logic_vector(2 * g_bits downto 0)
  );
end entity;

architecture rtl of dot_product is

begin

  registers : process (clk)
    variable whole : signed(sum'range);
  begin
    if rising_edge(clk) then
      if enable = '1' then
        whole := (others => '0');
        for axis in 0 to c_axes - 1 loop
          whole := whole + axis_of(a, axis) * axis_of(b, axis);
        end loop;
        sum <= std_logic_vector(whole);
      end if;
    end if;
  end process;

end architecture;
