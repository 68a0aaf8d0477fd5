-- SPDX-License-Identifier: Apache-2.0
-- Both presets, with one channel, three channels, and the horizon only. Every clock is compared with the golden model,
-- each stage stalling at random. Spans of one pixel and long spans, angles beyond the ends of the bell, and random
-- words.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity diffuse_slice_tb is
  generic (g_folder : string := "diffuse_slice");
end entity;

architecture sim of diffuse_slice_tb is
  type form_t is record
    exact                   : boolean;
    channels                : natural;
    address_bits, data_bits : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  -- with 0 channels: the horizon only
  constant c_forms : forms_t := ((true, 3, 9, 8), (true, 1, 9, 8), (true, 0, 9, 8), (false, 3, 6, 6), (false, 1, 4, 4));
begin
  forms : for i in c_forms'range generate
    constant c_form         : form_t   := c_forms(i);
    constant c_product_bits : positive := formats(c_form.exact).factor.bits + c_form.data_bits;

    signal clk                               : std_logic := '0';
    signal part                              : std_logic_vector(diffuse_bits(c_form.exact, c_form.channels) - 1 downto 0);
    signal span_load, span_step, sample_step : std_logic;
    signal lit                               : std_logic;
    signal products                          : std_logic_vector(maximum(c_form.channels, 1) * c_product_bits - 1 downto 0);
    begin
      dut : entity work.diffuse_slice
        generic map (
          g_exact        => c_form.exact,
          g_channels     => c_form.channels,
          g_address_bits => c_form.address_bits,
          g_data_bits    => c_form.data_bits)
        port map (
          clk         => clk,
          part        => part,
          span_load   => span_load,
          span_step   => span_step,
          sample_step => sample_step,
          lit         => lit,
          products    => products);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_"
          & joined((c_form.channels, c_form.address_bits, c_form.data_bits)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(part);
          vectors.drive(span_load);
          vectors.drive(span_step);
          vectors.drive(sample_step);
          settle;
          vectors.check("lit", lit);
          if c_form.channels > 0 then
            vectors.check_words("product of channel", c_product_bits, products);
          elsif products /= (products'range => '0') then
            vectors.fail("products are " & to_hstring(products) & " though there is none");
          end if;
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "diffuse_slice_tb");
end architecture;
