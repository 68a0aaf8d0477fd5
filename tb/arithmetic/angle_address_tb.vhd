-- SPDX-License-Identifier: Apache-2.0
-- Preset published: every angle. Preset exact: both ends of every cell within three half bells of the top, every power
-- of two and its neighbours, random words.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity angle_address_tb is
  generic (g_folder : string := "angle_address");
end entity;

architecture sim of angle_address_tb is
  type form_t is record
    exact        : boolean;
    address_bits : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  constant c_forms : forms_t := ((true, 3), (true, 9), (true, 12), (false, 4), (false, 6), (false, 12));
begin
  forms : for i in c_forms'range generate
    constant c_form : form_t := c_forms(i);

    signal angle    : std_logic_vector(formats(c_form.exact).angle.bits - 1 downto 0);
    signal address  : std_logic_vector(c_form.address_bits - 1 downto 0);
    signal in_range : std_logic;
    begin
      dut : entity work.angle_address
        generic map (g_exact => c_form.exact, g_address_bits => c_form.address_bits)
        port map (angle => angle, address => address, in_range => in_range);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_" & to_string(c_form.address_bits) & ".txt");
        while vectors.next_vector loop
          vectors.drive(angle);
          settle;
          vectors.check("address", address);
          vectors.check("in_range", in_range);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "angle_address_tb");
end architecture;
