-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The address of an angle in a cosine table. Preset exact: the upper fraction bits of the magnitude;
--             in_range is '1' if the angle is inside the bell, -1 <= angle < 1. The magnitude is the ones' complement
--             of a negative angle, so that both sides of the bell read the same entries at the same distance from the
--             top. Preset published: the upper bits of the word; it wraps where the table does.
-- Formats     formats_pkg: angle
-- Latency     0 (combinational)
-- Throughput  1 address per clock
-- Error       none: the address is exactly the cell that contains the angle
-- Source      spherical paper, section 4: the upper bits of the line interpolator address the ROM. in_range is ours: the
--             paper's bell is zero outside, and that its angle wraps is our reading
-- Golden twin model/golden/angle_address.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.cosine_pkg.all;
use work.formats_pkg.all;

entity angle_address is
  generic (
    g_exact  : boolean := true;
    g_cosine : cosine_t
  );
  port (
    angle    : in  std_logic_vector(formats(g_exact).angle.bits - 1 downto 0);
    address  : out std_logic_vector(address_bits(g_cosine) - 1 downto 0);
    in_range : out std_logic -- preset published: always '1'
  );
end entity;

architecture rtl of angle_address is

  constant c_sign     : natural := formats(g_exact).angle.bits - 1;
  constant c_fraction : natural := formats(g_exact).angle.fraction;

begin

  folded : if g_exact generate

    constant c_inside : std_logic_vector(c_sign downto c_fraction) := (others => '0');

    signal magnitude : std_logic_vector(c_sign downto 0);

  begin

    magnitude <= not angle when angle(c_sign) = '1' else angle;
    address   <= magnitude(c_fraction - 1 downto c_fraction - address'length);
    in_range  <= '1' when magnitude(c_sign downto c_fraction) = c_inside else '0';

  else generate

    address  <= angle(c_sign downto c_sign - address'length + 1);
    in_range <= '1';

  end generate;

end architecture;
