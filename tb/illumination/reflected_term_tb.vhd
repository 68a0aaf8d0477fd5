-- SPDX-License-Identifier: Apache-2.0
-- Coefficients and intensities of any size, with and without a weight: one product per clock, then with pauses. The
-- weight follows its coefficients after one clock.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity reflected_term_tb is
  generic (g_folder : string := "reflected_term");
end entity;

architecture sim of reflected_term_tb is
  type form_t is record
    exact    : boolean;
    channels : positive;
    weighted : boolean;
  end record;

  type forms_t is array (natural range <>) of form_t;

  constant c_forms : forms_t := ((true, 1, false), (true, 3, false), (true, 1, true), (true, 3, true), (false, 1, false),
    (false, 3, false), (false, 1, true), (false, 3, true));
begin
  forms : for i in c_forms'range generate
    constant c_form    : form_t    := c_forms(i);
    constant c_formats : formats_t := formats(c_form.exact);

    signal clk                 : std_logic := '0';
    signal enable              : std_logic;
    signal coefficients        : std_logic_vector(c_form.channels * c_formats.coefficient.bits - 1 downto 0);
    signal intensities         : std_logic_vector(c_form.channels * c_formats.light_intensity.bits - 1 downto 0);
    signal weight, weight_late : std_logic_vector(c_formats.weight.bits - 1 downto 0);
    signal terms               : std_logic_vector(c_form.channels * product_bits(c_form.exact) - 1 downto 0);
    begin
      dut : entity work.reflected_term
        generic map (g_exact => c_form.exact, g_channels => c_form.channels, g_weighted => c_form.weighted)
        port map (
          clk          => clk,
          enable       => enable,
          coefficients => coefficients,
          intensities  => intensities,
          weight       => weight_late,
          terms        => terms);

      late : entity work.delay_line
        generic map (weight'length, 1)
        port map (clk, enable, weight, weight_late);

      run : process is
        constant c_weighted : natural := boolean'pos(c_form.weighted);

        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_" & joined((c_form.channels, c_weighted)) & ".txt",
          1 + c_weighted);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(coefficients);
          vectors.drive(intensities);
          vectors.drive(weight);
          settle;
          vectors.check("terms", terms);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "reflected_term_tb");
end architecture;
