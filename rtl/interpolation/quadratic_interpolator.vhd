-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One colour channel of a quadratic over the triangle, by second-order forward differences. edge_... and span_...
--             are interpolators: registers that load a word and add the value of the arrow. a | b: b where the edge carries
--
--               along the edge, one step per line                along the span, one step per pixel
--
--               de0e0 | de0e1 --> edge_de0 --+
--                                            |--> edge_value --start--> span_value --> deskew --> value
--               de0e1 | de1e1 --> edge_de1 --+                              ^
--                                                                           |
--               dxe0 | dxe1 --------------------> edge_dx -----start--> span_dx
--                                                                           ^
--                                                                           |
--               dxx -------------------------------------------start--> span_dxx, a register
--
--             symbol         is the change of   per                                         in the paper
--             value          -, the intensity   -                                           I(X,Y)
--             dx             value              pixel of the span, x + 1 or x - 1           dI(X,Y)
--             de0            value              line where the edge steps by (q, 1)         dI_start
--             de1            value              line where it carries: by (q + 1, 1)
--             dxx            dx                 pixel                                       2 T5
--             dxe0 | dxe1    dx                 line without | with carry                   2 T5 A + T4
--             de0e0 | de0e1  de0                line without | with carry                   2 (T5 A^2 + T4 A + T3)
--             de0e1 | de1e1  de1                line without | with carry
--             In preset published the edge steps by its real slope A, as in the paper, and does not carry: de1 and the
--             right-hand words do not exist. q: start_quotient of init; T3, T4, T5, A: the paper's coefficients and slope.
-- Contract    line_load and line_step are never both '1', nor span_load and span_step. The words of init are skewed words
--             (skew_pkg), part 0 in the clock of line_load
-- Formats     formats_pkg: intensity; sums wrap, the value at a covered pixel fits
-- Latency     g_parts clocks from span_load or span_step to value; 1 clock from each load or step to part 0 of the
--             interpolators that it changes
-- Throughput  1 line and 1 pixel per clock
-- Error       0.15 of a colour step at most in preset exact, 16 in published, without the
--             rounding of the edge: see intensity in formats_pkg
-- Source      quadratic paper, section 5 (the nested loops) and figure 6
-- Golden twin model/golden/quadratic_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity quadratic_interpolator is
  generic (
    g_exact : boolean  := true;
    g_parts : positive := 1 -- parts of each skewed word (skew_pkg)
  );
  port (
    clk        : in  std_logic;
    init       : in  std_logic_vector(init_bits(g_exact, 1) - init_bits(g_exact, 0) - 1 downto 0);
    line_load  : in  std_logic; -- take the channel's block of the init vector
    line_step  : in  std_logic; -- go to the next line
    line_carry : in  std_logic; -- that step ends one pixel further right
    span_load  : in  std_logic; -- start the span at the edge
    span_step  : in  std_logic; -- go to the next pixel
    value      : out std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0)
  );
end entity;

architecture rtl of quadratic_interpolator is

  constant c_bits : positive       := formats(g_exact).intensity.bits;
  constant c_init : init_channel_t := init_channel(g_exact);

  subtype word_t is std_logic_vector(c_bits - 1 downto 0);

  -- The second differences, constant over the triangle: the block's upper words.
  signal constants : std_logic_vector(init'high downto c_init.dxx.low);

  -- Skewed words: the interpolators of the figure, and the addends of those along the edge.
  signal edge_value, edge_dx, edge_de0, edge_de1 : word_t;
  signal value_step, dx_step, de0_step           : word_t;
  signal dxx, dxe0, de0e0                        : word_t;
  signal span_value, span_dx                     : word_t;
  signal span_dxx                                : word_t; -- the span's own: the edge may have loaded the next triangle

begin

  -- Hold the second differences of the triangle.
  constants_register : entity work.skewed_register
    generic map (g_bits => c_bits, g_words => constants'length / c_bits, g_parts => g_parts) -- evaluated at elaboration
    port map (clk => clk, load => line_load, start => init(constants'range), value => constants);

  dxx   <= constants(c_init.dxx.high downto c_init.dxx.low);
  dxe0  <= constants(c_init.dxe0.high downto c_init.dxe0.low);
  de0e0 <= constants(c_init.de0e0.high downto c_init.de0e0.low);

  -- Select the edge's step by its carry.
  carried : if g_exact generate

    signal dxe1, de0e1, de1e1, de1_step : word_t;

  begin

    dxe1  <= constants(c_init.dxe1.high downto c_init.dxe1.low);
    de0e1 <= constants(c_init.de0e1.high downto c_init.de0e1.low);
    de1e1 <= constants(c_init.de1e1.high downto c_init.de1e1.low);

    value_multiplexer : entity work.skewed_multiplexer
      generic map (g_bits => c_bits, g_parts => g_parts)
      port map (clk => clk, select_b => line_carry, a => edge_de0, b => edge_de1, value => value_step);

    dx_multiplexer : entity work.skewed_multiplexer
      generic map (g_bits => c_bits, g_parts => g_parts)
      port map (clk => clk, select_b => line_carry, a => dxe0, b => dxe1, value => dx_step);

    de0_multiplexer : entity work.skewed_multiplexer
      generic map (g_bits => c_bits, g_parts => g_parts)
      port map (clk => clk, select_b => line_carry, a => de0e0, b => de0e1, value => de0_step);

    de1_multiplexer : entity work.skewed_multiplexer
      generic map (g_bits => c_bits, g_parts => g_parts)
      port map (clk => clk, select_b => line_carry, a => de0e1, b => de1e1, value => de1_step);

    de1_along_edge : entity work.skewed_interpolator
      generic map (g_bits => c_bits, g_parts => g_parts)
      port map (
        clk       => clk,
        load      => line_load,
        start     => init(c_init.de1.high downto c_init.de1.low),
        step      => line_step,
        increment => de1_step,
        value     => edge_de1);

  else generate

    edge_de1   <= (others => '0');
    value_step <= edge_de0;
    dx_step    <= dxe0;
    de0_step   <= de0e0;

  end generate;

  -- Step the line's first value and its differences along the edge.
  de0_along_edge : entity work.skewed_interpolator
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.de0.high downto c_init.de0.low),
      step      => line_step,
      increment => de0_step,
      value     => edge_de0);

  value_along_edge : entity work.skewed_interpolator
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.value.high downto c_init.value.low),
      step      => line_step,
      increment => value_step,
      value     => edge_value);

  dx_along_edge : entity work.skewed_interpolator
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => line_load,
      start     => init(c_init.dx.high downto c_init.dx.low),
      step      => line_step,
      increment => dx_step,
      value     => edge_dx);

  span_dxx_register : entity work.skewed_register
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (clk => clk, load => span_load, start => dxx, value => span_dxx);

  dx_along_span : entity work.skewed_interpolator
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => span_load,
      start     => edge_dx,
      step      => span_step,
      increment => span_dxx,
      value     => span_dx);

  value_along_span : entity work.skewed_interpolator
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (
      clk       => clk,
      load      => span_load,
      start     => edge_value,
      step      => span_step,
      increment => span_dx,
      value     => span_value);

  align_value : entity work.deskew
    generic map (g_bits => c_bits, g_parts => g_parts)
    port map (clk => clk, skewed => span_value, word => value);

end architecture;
