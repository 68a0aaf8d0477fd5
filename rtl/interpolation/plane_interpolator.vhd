-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A value that is linear on the screen, at every pixel, by first differences: along the start edge a line a
--             step, along the line a pixel a step.
--               v(x + q,     y + 1) = v(x, y) + de0    where the edge's remainder does not carry
--               v(x + q + 1, y + 1) = v(x, y) + de1    where it does
--               v(x +- 1,    y)     = v(x, y) + dx     the sign is the span's direction
-- Contract    line_load and line_step are never both '1', nor span_load and span_step; a part's bits of the plane's
--             words stand still in the clock of its line_load, a clock behind the part's below it
-- Formats     plane: value, dx, de0 and, with g_carries, de1, the first lowest, g_bits each, signed; sums wrap, the value
--             at a covered pixel fits
-- Latency     g_parts clocks from a load or step to its value
-- Throughput  1 line and 1 pixel a clock
-- Error       each word half a unit off, so the value (1 + lines + steps)/2 units at most: see plane_sum and depth_sum
--             in formats_pkg
-- Source      linear interpolation as in Gouraud's shading; processors paper: N and P arrive interpolated linearly
-- Golden twin model/golden/plane_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;

entity plane_interpolator is
  generic (
    g_bits    : positive;
    g_carries : boolean  := true; -- false: edges step by a real slope, and de1 does not exist
    g_parts   : positive := 1     -- of a word, each a clock behind the one below it
  );
  port (
    clk        : in  std_logic;
    plane      : in  std_logic_vector((3 + boolean'pos(g_carries)) * g_bits - 1 downto 0);
    line_load  : in  std_logic; -- take the plane
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step goes a pixel further
    span_load  : in  std_logic; -- begin the line
    span_step  : in  std_logic; -- go to the next pixel
    value      : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of plane_interpolator is

  -- The strobes, clock by clock: each part of the words takes them from a register of its own, the lowest first.
  subtype strobe_t is std_logic_vector(g_parts - 1 downto 0);

  signal line_loads, line_steps, line_carries, span_loads, span_steps : strobe_t;

  -- Along the edge and along the line, each part a clock behind the one below it.
  signal edge_value, span_value : std_logic_vector(g_bits - 1 downto 0);

  -- From part to part.
  signal edge_carries, span_carries : std_logic_vector(g_parts downto 0);

begin

  line_loads(0)   <= line_load;
  line_steps(0)   <= line_step;
  line_carries(0) <= line_carry;
  span_loads(0)   <= span_load;
  span_steps(0)   <= span_step;
  edge_carries(0) <= '0';
  span_carries(0) <= '0';

  later : if strobe_t'length > 1 generate

    registers : process (clk)
    begin
      if rising_edge(clk) then
        line_loads(strobe_t'high downto 1)   <= line_loads(strobe_t'high - 1 downto 0);
        line_steps(strobe_t'high downto 1)   <= line_steps(strobe_t'high - 1 downto 0);
        line_carries(strobe_t'high downto 1) <= line_carries(strobe_t'high - 1 downto 0);
        span_loads(strobe_t'high downto 1)   <= span_loads(strobe_t'high - 1 downto 0);
        span_steps(strobe_t'high downto 1)   <= span_steps(strobe_t'high - 1 downto 0);
      end if;
    end process;

  end generate;

  parts : for part in 0 to g_parts - 1 generate

    constant c_low       : natural  := part * g_bits / g_parts; -- elaboration only
    constant c_high      : natural  := (part + 1) * g_bits / g_parts - 1; -- elaboration only
    constant c_part_bits : positive := c_high - c_low + 1;

    subtype part_t is std_logic_vector(c_part_bits - 1 downto 0);

    signal dx, de0, de, span_dx : part_t;

    begin

      dx_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => line_loads(part),
          start => plane(1 * g_bits + c_high downto 1 * g_bits + c_low),
          value => dx
          );

      de0_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => line_loads(part),
          start => plane(2 * g_bits + c_high downto 2 * g_bits + c_low),
          value => de0
          );

      carried : if g_carries generate

        signal de1 : part_t;

        begin

          de1_register : entity work.parameter_register
            generic map (
              g_bits => c_part_bits
              )
            port map (
              clk   => clk,
              load  => line_loads(part),
              start => plane(3 * g_bits + c_high downto 3 * g_bits + c_low),
              value => de1
              );

          de <= de1 when line_carries(part) = '1' else de0;

      else generate

        de <= de0;

      end generate;

      along_edge : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => line_loads(part),
          start     => plane(0 * g_bits + c_high downto 0 * g_bits + c_low),
          step      => line_steps(part),
          increment => de,
          carry_in  => edge_carries(part),
          value     => edge_value(c_high downto c_low),
          carry_out => edge_carries(part + 1)
          );

        -- The line stage may hold the next triangle already, so the span keeps its own step.
      span_dx_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => span_loads(part),
          start => dx,
          value => span_dx
          );

      along_line : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => span_loads(part),
          start     => edge_value(c_high downto c_low),
          step      => span_steps(part),
          increment => span_dx,
          carry_in  => span_carries(part),
          value     => span_value(c_high downto c_low),
          carry_out => span_carries(part + 1)
          );

        -- A lower part waits for the upper ones.
      span_waits : if part < g_parts - 1 generate

        type waits_t is array (1 to g_parts - 1 - part) of part_t;

        signal waits : waits_t;

        begin

          registers : process (clk)
          begin
            if rising_edge(clk) then
              waits <= waits_t'(span_value(c_high downto c_low) & waits(1 to waits_t'high - 1));
            end if;
          end process;

          value(c_high downto c_low) <= waits(waits_t'high);

      else generate

        value(c_high downto c_low) <= span_value(c_high downto c_low);

      end generate;

  end generate;

end architecture;
