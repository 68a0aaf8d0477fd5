-- SPDX-License-Identifier: Apache-2.0
-- Directions at angles of any size, diffuse and highlight: one pair per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity cosine_power_tb is
  generic (g_folder : string := "cosine_power");
end entity;

architecture sim of cosine_power_tb is
begin
  presets : for exact in boolean generate
    kinds : for highlight in boolean generate
      signal clk               : std_logic := '0';
      signal enable            : std_logic;
      signal normal, direction : std_logic_vector(3 * formats(exact).direction.bits - 1 downto 0);
      signal exponent          : std_logic_vector(formats(exact).exponent.bits - 1 downto 0);
      signal result            : std_logic_vector(formats(exact).weight.bits - 1 downto 0);
      begin
        dut : entity work.cosine_power
          generic map (g_exact => exact, g_highlight => highlight)
          port map (
            clk       => clk,
            enable    => enable,
            normal    => normal,
            direction => direction,
            exponent  => exponent,
            result    => result);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(to_flag(highlight)) & ".txt",
            cosine_power_latency(exact, highlight));
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(normal);
            vectors.drive(direction);
            vectors.drive(exponent);
            settle;
            vectors.check("result", result);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "cosine_power_tb");
end architecture;
