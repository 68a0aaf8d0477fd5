-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one channel and three, one term per channel and several. Sums around the largest colour and above.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity colour_sum_tb is
  generic (g_folder : string := "colour_sum");
end entity;

architecture sim of colour_sum_tb is
  type form_t is record
    exact                      : boolean;
    channels, terms, data_bits : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  -- the ambient term only, a light, two lights, grey, preset published
  constant c_forms : forms_t := ((true, 3, 1, 8), (true, 3, 3, 8), (true, 3, 5, 8), (true, 1, 3, 8), (false, 3, 3, 6));
begin
  forms : for i in c_forms'range generate
    constant c_form : form_t := c_forms(i);

    signal clk     : std_logic := '0';
    signal enable  : std_logic;
    signal terms   : std_logic_vector(c_form.terms * c_form.channels * term_bits(c_form.exact, c_form.data_bits) - 1 downto 0);
    signal colours : std_logic_vector(3 * formats(c_form.exact).colour.bits - 1 downto 0);
    begin
      dut : entity work.colour_sum
        generic map (
          g_exact     => c_form.exact,
          g_channels  => c_form.channels,
          g_terms     => c_form.terms,
          g_data_bits => c_form.data_bits)
        port map (clk => clk, enable => enable, terms => terms, colours => colours);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_"
          & joined((c_form.channels, c_form.terms, c_form.data_bits)) & ".txt", 1);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(terms);
          settle;
          vectors.check("colours", colours);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "colour_sum_tb");
end architecture;
