-- SPDX-License-Identifier: Apache-2.0
-- Both terms of a directional light, a positional light and a spot: one object per clock, then with pauses. A light is
-- constant for 60 objects.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_term_tb is
  generic (g_folder : string := "light_term");
end entity;

architecture sim of light_term_tb is
begin
  presets : for exact in boolean generate
    kinds : for kind in c_diffuse to c_specular generate
      lights : for number in 1 to 3 generate
        constant c_config : config_t := config(exact, 3, 1, 1, 1, true, true, true, true);

        signal clk    : std_logic := '0';
        signal enable : std_logic;
        signal light  : std_logic_vector(light_bits(c_config) - 1 downto 0);
        signal token  : std_logic_vector(token_bits(c_config) - 1 downto 0);
        signal terms  : std_logic_vector(3 * product_bits(exact) - 1 downto 0);
        signal above  : std_logic;
        begin
          dut : entity work.light_term
            generic map (g_config => c_config, g_kind => kind, g_light => number)
            port map (clk => clk, enable => enable, light => light, token => token, terms => terms, above => above);

          run : process is
            variable vectors : vectors_t;
            variable result  : std_logic_vector(terms'length downto 0);
          begin
            vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(kind) & to_string(number) & ".txt",
              times(c_config, kind, number).term);
            while vectors.next_clock loop
              vectors.drive(enable);
              vectors.drive(light);
              vectors.drive(token);
              settle;
              result := (others => '0');
              if above /= '0' then
                result := terms & above;
              end if;
              vectors.check("terms, above", result);
              tick(clk);
            end loop;
            finish(finished);
          end process;
      end generate;
    end generate;
  end generate;

  report_end(finished, "light_term_tb");
end architecture;
