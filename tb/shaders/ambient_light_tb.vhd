-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one channel and three, several depths. Random words and strobes.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity ambient_light_tb is
  generic (g_folder : string := "ambient_light");
end entity;

architecture sim of ambient_light_tb is
  type form_t is record
    exact               : boolean;
    channels, data_bits : positive;
    depth               : natural;
  end record;

  type forms_t is array (natural range <>) of form_t;

  constant c_forms : forms_t := ((true, 3, 8, 4), (true, 1, 8, 4), (false, 3, 6, 2));
begin
  forms : for i in c_forms'range generate
    constant c_form      : form_t   := c_forms(i);
    constant c_term_bits : positive := term_bits(c_form.exact, c_form.data_bits);

    signal clk       : std_logic := '0';
    signal ambient   : std_logic_vector(ambient_bits(c_form.exact, c_form.channels) - 1 downto 0);
    signal span_load : std_logic;
    signal terms     : std_logic_vector(c_form.channels * c_term_bits - 1 downto 0);
    begin
      dut : entity work.ambient_light
        generic map (
          g_exact     => c_form.exact,
          g_channels  => c_form.channels,
          g_data_bits => c_form.data_bits,
          g_depth     => c_form.depth)
        port map (clk => clk, ambient => ambient, span_load => span_load, terms => terms);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_"
          & joined((c_form.channels, c_form.data_bits, c_form.depth)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(ambient);
          vectors.drive(span_load);
          settle;
          vectors.check_words("term of channel", c_term_bits, terms);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "ambient_light_tb");
end architecture;
