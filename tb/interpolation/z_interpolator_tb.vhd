-- SPDX-License-Identifier: Apache-2.0
-- Both presets. Every combination of the walker's strobes at random, in one part and in several, by
-- interpolator_checker.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity z_interpolator_tb is
  generic (g_folder : string := "z_interpolator");
end entity;

architecture sim of z_interpolator_tb is
  constant c_parts : positive := 3;
begin
  presets : for exact in boolean generate
    constant c_bits : positive := formats(exact).depth_sum.bits;

    signal clk                              : std_logic;
    signal init                             : std_logic_vector(init_channel_low(exact, 0) - 1 downto 0);
    signal line_load, line_step, line_carry : std_logic;
    signal span_load, span_step             : std_logic;
    signal values                           : std_logic_vector(c_parts * c_bits - 1 downto 0);
    begin
      forms : for parts in 1 to c_parts generate
        dut : entity work.z_interpolator
          generic map (g_exact => exact, g_parts => parts)
          port map (
            clk        => clk,
            init       => init,
            line_load  => line_load,
            line_step  => line_step,
            line_carry => line_carry,
            span_load  => span_load,
            span_step  => span_step,
            value      => values(parts * c_bits - 1 downto (parts - 1) * c_bits));
      end generate;

      checker : entity work.interpolator_checker
        generic map (g_file => g_folder & "/" & preset_name(exact) & ".txt", g_parts => c_parts)
        port map (
          clk        => clk,
          init       => init,
          line_load  => line_load,
          line_step  => line_step,
          line_carry => line_carry,
          span_load  => span_load,
          span_step  => span_step,
          values     => values);
  end generate;

  report_end(finished, "z_interpolator_tb");
end architecture;
