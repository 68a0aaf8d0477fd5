-- SPDX-License-Identifier: Apache-2.0
-- Both presets, with and without each part of a light. Every clock is compared with the golden model, each stage
-- stalling at random. Angles beyond the ends of the bell, and random words.
library ieee;
use ieee.std_logic_1164.all;
use work.spherical_pkg.all;
use work.tb_pkg.all;

entity spherical_light_tb is
  generic (g_folder : string := "spherical_light");
end entity;

architecture sim of spherical_light_tb is
  type form_t is record
    exact                : boolean;
    channels             : positive;
    diffuse, specular    : boolean;
    highlight_channels   : positive;
    powers, address_bits : positive;
    data_bits            : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  -- The lights are those of tb/vectors/illumination.cpp.
  constant c_forms : forms_t := (
    (true, 3, true, true, 3, 18, 9, 8),
    (true, 3, true, true, 1, 2, 9, 8),
    (true, 1, true, true, 1, 16, 9, 8),
    (true, 3, false, true, 3, 9, 9, 8),
    (true, 3, true, false, 1, 2, 9, 8),
    (false, 3, true, true, 1, 2, 6, 6),
    (false, 1, false, true, 1, 2, 4, 4));

  constant c_names : string := "coloured_highlights white_highlights grey highlights matte published published_highlights";
begin
  forms : for i in c_forms'range generate
    constant c_form      : form_t   := c_forms(i);
    constant c_term_bits : positive := term_bits(c_form.exact, c_form.data_bits);
    constant c_terms     : positive := light_terms(c_form.diffuse, c_form.specular) * c_form.channels;
    constant c_part_bits : positive := light_part_bits(c_form.exact, c_form.channels, c_form.diffuse, c_form.specular,
      c_form.highlight_channels);

    signal clk                               : std_logic := '0';
    signal part                              : std_logic_vector(c_part_bits - 1 downto 0);
    signal span_load, span_step, sample_step : std_logic;
    signal terms                             : std_logic_vector(c_terms * c_term_bits - 1 downto 0);
    begin
      dut : entity work.spherical_light
        generic map (
          g_exact              => c_form.exact,
          g_channels           => c_form.channels,
          g_diffuse            => c_form.diffuse,
          g_specular           => c_form.specular,
          g_highlight_channels => c_form.highlight_channels,
          g_powers             => c_form.powers,
          g_address_bits       => c_form.address_bits,
          g_data_bits          => c_form.data_bits)
        port map (
          clk         => clk,
          part        => part,
          span_load   => span_load,
          span_step   => span_step,
          sample_step => sample_step,
          terms       => terms);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & nth_word(c_names, i) & ".txt");
        while vectors.next_clock loop
          vectors.drive(part);
          vectors.drive(span_load);
          vectors.drive(span_step);
          vectors.drive(sample_step);
          settle;
          vectors.check_words("term", c_term_bits, terms);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "spherical_light_tb");
end architecture;
