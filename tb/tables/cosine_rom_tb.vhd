-- SPDX-License-Identifier: Apache-2.0
-- Reads every entry of every table: in order, one per clock, then at random with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity cosine_rom_tb is
  generic (g_folder : string := "cosine_rom");
end entity;

architecture sim of cosine_rom_tb is
  type form_t is record
    exact                          : boolean;
    power, address_bits, data_bits : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  constant c_forms : forms_t := ((true, 1, 9, 8), (true, 2, 9, 8), (true, 4, 9, 8), (true, 8, 9, 8), (true, 16, 9, 8),
    (false, 1, 6, 6), (false, 2, 6, 6), (false, 1, 4, 4), (false, 2, 4, 4));
begin
  forms : for i in c_forms'range generate
    constant c_form : form_t := c_forms(i);

    signal clk     : std_logic := '0';
    signal enable  : std_logic;
    signal address : std_logic_vector(c_form.address_bits - 1 downto 0);
    signal sample  : std_logic_vector(c_form.data_bits - 1 downto 0);
    begin
      dut : entity work.cosine_rom
        generic map (
          g_exact        => c_form.exact,
          g_power        => c_form.power,
          g_address_bits => c_form.address_bits,
          g_data_bits    => c_form.data_bits)
        port map (clk => clk, enable => enable, address => address, sample => sample);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_"
          & joined((c_form.power, c_form.address_bits, c_form.data_bits)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(address);
          settle;
          vectors.check("sample", sample);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "cosine_rom_tb");
end architecture;
