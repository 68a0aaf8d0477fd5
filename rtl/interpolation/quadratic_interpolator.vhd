-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One colour channel of a quadratic over the triangle, by second-order forward differences. With e0 = (q, 1)
--             and e1 = (q + 1, 1) the two steps of the start edge and x = (+-1, 0) the step of a span:
--               line   value += de0    dx += dxe0    de0 += de0e0    de1 += de0e1    where the remainder does not carry
--                      value += de1    dx += dxe1    de0 += de0e1    de1 += de1e1    where it does
--               pixel  value += dx     dx += dxx
--             In preset published the edge steps by its real slope: e0 = (A, 1), and there is no e1.
-- Contract    line_load and line_step are never both '1', nor span_load and span_step; a part's bits of init's words stand
--             still in the clock of its line_load, a clock behind the part's below it
-- Formats     formats_pkg: intensity; sums wrap, the value at a covered pixel fits
-- Latency     g_parts clocks from a load or step to its value
-- Throughput  1 line and 1 pixel a clock
-- Error       0.15 of a colour step at most in preset exact, 16 in published: see intensity in formats_pkg
-- Source      quadratic paper, section 5 (the nested loops) and figure 6
-- Golden twin model/golden/quadratic_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity quadratic_interpolator is
  generic (
    g_exact : boolean  := true;
    g_parts : positive := 1     -- of a word, each a clock behind the one below it
  );
  port (
    clk        : in  std_logic;
    init       : in  std_logic_vector(init_channel_low(g_exact, 1) - init_channel_low(g_exact, 0) - 1 downto 0);
    line_load  : in  std_logic; -- take the channel's part of the init vector
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step goes a pixel further
    span_load  : in  std_logic; -- begin the line
    span_step  : in  std_logic; -- go to the next pixel
    value      : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0)
  );
end entity;

architecture rtl of quadratic_interpolator is

  constant c_bits : positive       := formats(g_exact).intensity.bits;
  constant c_init : init_channel_t := init_channel(g_exact);

  -- The strobes, clock by clock: each part of the words takes them from a register of its own, the lowest first.
  subtype strobe_t is std_logic_vector(g_parts - 1 downto 0);

  signal line_loads, line_steps, line_carries, span_loads, span_steps : strobe_t;

  -- The sums along the edge and along the line, each part a clock behind the one below it.
  signal edge_value, edge_dx, edge_de0, edge_de1 : std_logic_vector(c_bits - 1 downto 0);
  signal span_value, span_dx                     : std_logic_vector(c_bits - 1 downto 0);

  -- What each carries from part to part.
  subtype carries_t is std_logic_vector(g_parts downto 0);

  signal edge_value_carries, edge_dx_carries, edge_de0_carries, edge_de1_carries : carries_t;
  signal span_value_carries, span_dx_carries                                     : carries_t;

begin

  line_loads(0)   <= line_load;
  line_steps(0)   <= line_step;
  line_carries(0) <= line_carry;
  span_loads(0)   <= span_load;
  span_steps(0)   <= span_step;

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

  edge_value_carries(0) <= '0';
  edge_dx_carries(0)    <= '0';
  edge_de0_carries(0)   <= '0';
  edge_de1_carries(0)   <= '0';
  span_value_carries(0) <= '0';
  span_dx_carries(0)    <= '0';

  parts : for part in 0 to g_parts - 1 generate

    constant c_low       : natural  := part * c_bits / g_parts; -- elaboration only
    constant c_high      : natural  := (part + 1) * c_bits / g_parts - 1; -- elaboration only
    constant c_part_bits : positive := c_high - c_low + 1;

    subtype part_t is std_logic_vector(c_part_bits - 1 downto 0);

    -- Constant over the triangle, and over the span.
    signal dxx, dxe0, de0e0 : part_t;
    signal span_dxx         : part_t;

    -- What the next step along the edge adds.
    signal value_step, dx_step, de0_step : part_t;

    begin

      dxx_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => line_loads(part),
          start => init(c_init.dxx.low + c_high downto c_init.dxx.low + c_low),
          value => dxx
          );

      dxe0_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => line_loads(part),
          start => init(c_init.dxe0.low + c_high downto c_init.dxe0.low + c_low),
          value => dxe0
          );

      de0e0_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => line_loads(part),
          start => init(c_init.de0e0.low + c_high downto c_init.de0e0.low + c_low),
          value => de0e0
          );

      carried : if g_exact generate

        signal dxe1, de0e1, de1e1 : part_t;
        signal de1_step           : part_t;

        begin

          dxe1_register : entity work.parameter_register
            generic map (
              g_bits => c_part_bits
              )
            port map (
              clk   => clk,
              load  => line_loads(part),
              start => init(c_init.dxe1.low + c_high downto c_init.dxe1.low + c_low),
              value => dxe1
              );

          de0e1_register : entity work.parameter_register
            generic map (
              g_bits => c_part_bits
              )
            port map (
              clk   => clk,
              load  => line_loads(part),
              start => init(c_init.de0e1.low + c_high downto c_init.de0e1.low + c_low),
              value => de0e1
              );

          de1e1_register : entity work.parameter_register
            generic map (
              g_bits => c_part_bits
              )
            port map (
              clk   => clk,
              load  => line_loads(part),
              start => init(c_init.de1e1.low + c_high downto c_init.de1e1.low + c_low),
              value => de1e1
              );

          de1_along_edge : entity work.part_interpolator
            generic map (
              g_bits => c_part_bits
              )
            port map (
              clk       => clk,
              load      => line_loads(part),
              start     => init(c_init.de1.low + c_high downto c_init.de1.low + c_low),
              step      => line_steps(part),
              increment => de1_step,
              carry_in  => edge_de1_carries(part),
              value     => edge_de1(c_high downto c_low),
              carry_out => edge_de1_carries(part + 1)
              );

          value_step <= edge_de1(c_high downto c_low) when line_carries(part) = '1' else edge_de0(c_high downto c_low);
          dx_step    <= dxe1 when line_carries(part) = '1' else dxe0;
          de0_step   <= de0e1 when line_carries(part) = '1' else de0e0;
          de1_step   <= de1e1 when line_carries(part) = '1' else de0e1;

      else generate

        edge_de1(c_high downto c_low)                    <= (others => '0');
        edge_de1_carries(part + 1) <= '0';
        value_step                  <= edge_de0(c_high downto c_low);
        dx_step                     <= dxe0;
        de0_step                    <= de0e0;

      end generate;

      value_along_edge : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => line_loads(part),
          start     => init(c_init.value.low + c_high downto c_init.value.low + c_low),
          step      => line_steps(part),
          increment => value_step,
          carry_in  => edge_value_carries(part),
          value     => edge_value(c_high downto c_low),
          carry_out => edge_value_carries(part + 1)
          );

      dx_along_edge : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => line_loads(part),
          start     => init(c_init.dx.low + c_high downto c_init.dx.low + c_low),
          step      => line_steps(part),
          increment => dx_step,
          carry_in  => edge_dx_carries(part),
          value     => edge_dx(c_high downto c_low),
          carry_out => edge_dx_carries(part + 1)
          );

      de0_along_edge : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => line_loads(part),
          start     => init(c_init.de0.low + c_high downto c_init.de0.low + c_low),
          step      => line_steps(part),
          increment => de0_step,
          carry_in  => edge_de0_carries(part),
          value     => edge_de0(c_high downto c_low),
          carry_out => edge_de0_carries(part + 1)
          );

        -- The line stage may hold the next triangle already, so the span keeps its own second difference.
      span_dxx_register : entity work.parameter_register
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk   => clk,
          load  => span_loads(part),
          start => dxx,
          value => span_dxx
          );

      value_along_line : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => span_loads(part),
          start     => edge_value(c_high downto c_low),
          step      => span_steps(part),
          increment => span_dx(c_high downto c_low),
          carry_in  => span_value_carries(part),
          value     => span_value(c_high downto c_low),
          carry_out => span_value_carries(part + 1)
          );

      dx_along_line : entity work.part_interpolator
        generic map (
          g_bits => c_part_bits
          )
        port map (
          clk       => clk,
          load      => span_loads(part),
          start     => edge_dx(c_high downto c_low),
          step      => span_steps(part),
          increment => span_dxx,
          carry_in  => span_dx_carries(part),
          value     => span_dx(c_high downto c_low),
          carry_out => span_dx_carries(part + 1)
          );

        -- A lower part waits for the upper ones.
      values : if part < g_parts - 1 generate

        type waits_t is array (1 to g_parts - 1 - part) of part_t;

        signal value_waits : waits_t;

        begin

          registers : process (clk)
          begin
            if rising_edge(clk) then
              value_waits <= waits_t'(span_value(c_high downto c_low) & value_waits(1 to waits_t'high - 1));
            end if;
          end process;

          value(c_high downto c_low) <= value_waits(waits_t'high);

      else generate

        value(c_high downto c_low) <= span_value(c_high downto c_low);

      end generate;

  end generate;

end architecture;
