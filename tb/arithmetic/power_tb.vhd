-- SPDX-License-Identifier: Apache-2.0
-- All bases of small widths. For other widths bases around each power of two, and random bases; for powers that are 0
-- or 1 almost everywhere, random bases between. One per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity power_tb is
  generic (g_folder : string := "power");
end entity;

architecture sim of power_tb is
begin
  presets : for exact in boolean generate
    signal clk      : std_logic := '0';
    signal enable   : std_logic;
    signal base     : std_logic_vector(formats(exact).direction.fraction downto 0);
    signal exponent : std_logic_vector(formats(exact).exponent.bits - 1 downto 0);
    signal result   : std_logic_vector(formats(exact).weight.bits - 1 downto 0);
    begin
      dut : entity work.power
        generic map (g_exact => exact)
        port map (clk => clk, enable => enable, base => base, exponent => exponent, result => result);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt", power_latency(exact));
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(base);
          vectors.drive(exponent);
          settle;
          vectors.check("result", result);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "power_tb");
end architecture;
