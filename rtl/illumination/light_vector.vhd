-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     L, the unit vector from a point of a surface to the light. Of a positional light it is
--             (P_p - P) / |P_p - P|; of a directional light it is the direction in the light's registers.
--
--                                                              | clocks
--               place * distance      position of the light, on the scale of the point (preset exact)
--                 - point             vector to the light        | 1, exact 3
--                 / length            unit_vector                | unit_vector_latency
--
-- Contract    positional, place and shift must not change while a point is in the stages
-- Formats     place: light_place, a vector or a direction; shift: light_shift; point: vector, distance: vector (not
--             used by preset published); to_light: direction. A vector is three components, x lowest.
-- Latency     light_vector_latency of terms_pkg, clocks: 0 without g_positional, otherwise 8 in
--             preset published and 18 in preset exact
-- Throughput  1 vector per clock
-- Error       that of unit_vector, and half a step of offset in each component of the vector to the light
-- Source      processors paper, equation 3 and figure 2
-- Golden twin model/golden/light_vector.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;

entity light_vector is
  generic (
    g_exact      : boolean := true;
    g_positional : boolean := true -- the light can have a position
  );
  port (
    clk        : in  std_logic;
    positional : in  std_logic; -- the light has a position
    place      : in  std_logic_vector(c_axes * formats(g_exact).light_place.bits - 1 downto 0);
    shift      : in  std_logic_vector(shift_bits(g_exact) - 1 downto 0);
    point      : in  std_logic_vector(c_axes * formats(g_exact).vector.bits - 1 downto 0);
    distance   : in  std_logic_vector(formats(g_exact).vector.bits - 1 downto 0);
    to_light   : out std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0)
  );
end entity;

architecture rtl of light_vector is

  constant c_offset : positive := formats(g_exact).offset.bits;
  constant c_place  : positive := formats(g_exact).light_place.bits;
  constant c_vector : positive := formats(g_exact).vector.bits;

  signal direction : std_logic_vector(to_light'range); -- of a directional light

begin

  direction <= light_directions(g_exact, place);

  normalized : if g_positional generate

    signal way  : std_logic_vector(c_axes * c_offset - 1 downto 0);
    signal unit : std_logic_vector(to_light'range);

  begin

    scaled : if g_exact generate

      signal places : std_logic_vector(c_axes * (c_place + c_vector) - 1 downto 0);
      signal points : std_logic_vector(point'range);

    begin

      scale : entity work.vector_multiply
        generic map (
          g_a_bits => c_place,
          g_b_bits => c_vector,
          g_clocks => vector_multiply_latency(g_exact)
          )
        port map (
          clk      => clk,
          a        => place,
          b        => distance & distance & distance,
          products => places
          );

      align_points : entity work.delay_line
        generic map (
          g_bits  => point'length,
          g_depth => vector_multiply_latency(g_exact)
          )
        port map (
          clk     => clk,
          enable  => '1',
          word    => point,
          delayed => points
          );

      subtract : process (clk)
      begin
        if rising_edge(clk) then
          way <= offsets(g_exact, places, points, shift);
        end if;
      end process;

    else generate

      subtract : process (clk)
      begin
        if rising_edge(clk) then
          way <= offsets(g_exact, place, point, shift);
        end if;
      end process;

    end generate;

    normalize : entity work.unit_vector
      generic map (
        g_exact       => g_exact,
        g_vector_bits => c_offset
        )
      port map (
        clk        => clk,
        components => way,
        unit       => unit
        );

    to_light <= unit when positional = '1' else direction;

  else generate

    to_light <= direction;

  end generate;

end architecture;
