-- SPDX-License-Identifier: Apache-2.0
-- The planes of both presets, and one without de1. Every combination of the walker's strobes at random, in one part and
-- in several, by interpolator_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity plane_interpolator_tb is
  generic (g_folder : string := "plane_interpolator");
end entity;

architecture sim of plane_interpolator_tb is
  constant c_parts : positive := 3;

  -- The last form has no de1.
  constant c_bits  : integer_vector := (formats(true).plane_sum.bits, formats(false).plane_sum.bits, 7);
  constant c_names : string         := "exact published without_carry";
begin
  widths : for form in c_bits'range generate
    constant c_carries : boolean := form < 2;

    signal clk                              : std_logic;
    signal plane                            : std_logic_vector((3 + boolean'pos(c_carries)) * c_bits(form) - 1 downto 0);
    signal line_load, line_step, line_carry : std_logic;
    signal span_load, span_step             : std_logic;
    signal values                           : std_logic_vector(c_parts * c_bits(form) - 1 downto 0);
    begin
      forms : for parts in 1 to c_parts generate
        dut : entity work.plane_interpolator
          generic map (g_bits => c_bits(form), g_carries => c_carries, g_parts => parts)
          port map (
            clk        => clk,
            plane      => plane,
            line_load  => line_load,
            line_step  => line_step,
            line_carry => line_carry,
            span_load  => span_load,
            span_step  => span_step,
            value      => values(parts * c_bits(form) - 1 downto (parts - 1) * c_bits(form)));
      end generate;

      checker : entity work.interpolator_checker
        generic map (g_file => g_folder & "/" & nth_word(c_names, form) & ".txt", g_parts => c_parts)
        port map (
          clk        => clk,
          init       => plane,
          line_load  => line_load,
          line_step  => line_step,
          line_carry => line_carry,
          span_load  => span_load,
          span_step  => span_step,
          values     => values);
  end generate;

  report_end(finished, "plane_interpolator_tb");
end architecture;
