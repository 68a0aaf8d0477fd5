-- SPDX-License-Identifier: Apache-2.0
-- Lights at any place and distance. One point per clock, then with pauses. A light is constant for 100 points.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_vector_tb is
  generic (g_folder : string := "light_vector");
end entity;

architecture sim of light_vector_tb is
begin
  presets : for exact in boolean generate
    kinds : for with_places in boolean generate
      signal clk                : std_logic := '0';
      signal enable, positional : std_logic;
      signal place              : std_logic_vector(3 * formats(exact).light_place.bits - 1 downto 0);
      signal shift              : std_logic_vector(shift_bits(exact) - 1 downto 0);
      signal point              : std_logic_vector(3 * formats(exact).vector.bits - 1 downto 0);
      signal distance           : std_logic_vector(formats(exact).vector.bits - 1 downto 0);
      signal to_light           : std_logic_vector(3 * formats(exact).direction.bits - 1 downto 0);
      begin
        dut : entity work.light_vector
          generic map (g_exact => exact, g_positional => with_places)
          port map (
            clk        => clk,
            enable     => enable,
            positional => positional,
            place      => place,
            shift      => shift,
            point      => point,
            distance   => distance,
            to_light   => to_light);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(to_flag(with_places)) & ".txt",
            light_vector_latency(exact, with_places));
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(positional);
            vectors.drive(place);
            vectors.drive(shift);
            vectors.drive(point);
            vectors.drive(distance);
            settle;
            vectors.check("to_light", to_light);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "light_vector_tb");
end architecture;
