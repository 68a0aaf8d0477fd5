-- SPDX-License-Identifier: Apache-2.0
-- All values of three small formats; corner cases and random values of the intensity of both presets.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity saturate_tb is
  generic (g_folder : string := "saturate");
end entity;

architecture sim of saturate_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 2);

  function intensity (exact : boolean) return integer_vector is
  begin
    return (formats(exact).intensity.bits, formats(exact).intensity.fraction, formats(exact).colour.bits);
  end function;

  -- value, fraction and result bits; the second has no spare bit
  constant c_sizes : sizes_t := ((16, 4, 8), (12, 2, 8), (11, 0, 8), intensity(true), intensity(false));
begin
  sizes : for i in c_sizes'range generate
    signal value  : std_logic_vector(c_sizes(i)(0) - 1 downto 0);
    signal result : std_logic_vector(c_sizes(i)(2) - 1 downto 0);
    begin
      dut : entity work.saturate
        generic map (g_value_bits => value'length, g_fraction_bits => c_sizes(i)(1), g_result_bits => result'length)
        port map (value => value, result => result);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & joined(c_sizes(i)) & ".txt");
        while vectors.next_vector loop
          vectors.drive(value);
          settle;
          vectors.check("result", result);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "saturate_tb");
end architecture;
