-- SPDX-License-Identifier: Apache-2.0
-- Directions to light and eye at angles of any size, with and without normalization: one pair per clock, then with
-- pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity half_vector_tb is
  generic (g_folder : string := "half_vector");
end entity;

architecture sim of half_vector_tb is
begin
  presets : for exact in boolean generate
    kinds : for normalize in boolean generate
      signal clk                : std_logic := '0';
      signal enable, positional : std_logic;
      signal to_light           : std_logic_vector(3 * half_light_bits(exact) - 1 downto 0);
      signal to_eye, half       : std_logic_vector(3 * formats(exact).direction.bits - 1 downto 0);
      begin
        dut : entity work.half_vector
          generic map (g_exact => exact, g_normalize => normalize)
          port map (
            clk        => clk,
            enable     => enable,
            positional => positional,
            to_light   => to_light,
            to_eye     => to_eye,
            half       => half);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(to_flag(normalize)) & ".txt",
            half_vector_latency(exact, normalize));
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(positional);
            vectors.drive(to_light);
            vectors.drive(to_eye);
            settle;
            vectors.check("half", half);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "half_vector_tb");
end architecture;
