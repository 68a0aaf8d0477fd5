-- SPDX-License-Identifier: Apache-2.0
-- Reads every entry of every table: in order, one per clock, then at random with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.function_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity function_rom_tb is
  generic (g_folder : string := "function_rom");
end entity;

architecture sim of function_rom_tb is
begin
  presets : for exact in boolean generate
    functions : for which in c_reciprocal_root to c_decay generate
      signal clk     : std_logic := '0';
      signal enable  : std_logic;
      signal address : std_logic_vector(function_format(exact, which).address_bits - 1 downto 0);
      signal sample  : std_logic_vector(sample_bits(exact, which) - 1 downto 0);
      begin
        dut : entity work.function_rom
          generic map (g_exact => exact, g_which => which)
          port map (clk => clk, enable => enable, address => address, sample => sample);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(which) & ".txt", 1);
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
  end generate;

  report_end(finished, "function_rom_tb");
end architecture;
