-- SPDX-License-Identifier: Apache-2.0
-- Colours and terms of any size, sums below and above the largest colour: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity radiance_sum_tb is
  generic (g_folder : string := "radiance_sum");
end entity;

architecture sim of radiance_sum_tb is
begin
  presets : for exact in boolean generate
    widths : for coloured in boolean generate
      constant c_channels : positive := 1 + 2 * boolean'pos(coloured);

      signal clk              : std_logic := '0';
      signal enable, add      : std_logic;
      signal radiance, result : std_logic_vector(c_channels * formats(exact).radiance.bits - 1 downto 0);
      signal terms            : std_logic_vector(c_channels * product_bits(exact) - 1 downto 0);
      begin
        dut : entity work.radiance_sum
          generic map (g_exact => exact, g_channels => c_channels)
          port map (clk => clk, enable => enable, add => add, radiance => radiance, terms => terms, result => result);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(c_channels) & ".txt", 1);
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(add);
            vectors.drive(radiance);
            vectors.drive(terms);
            settle;
            vectors.check("result", result);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "radiance_sum_tb");
end architecture;
