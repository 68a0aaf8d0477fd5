-- SPDX-License-Identifier: Apache-2.0
-- All squares of small widths; otherwise squares around both ends of each cell, and random ones. One per clock, then
-- with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity reciprocal_root_tb is
  generic (g_folder : string := "reciprocal_root");
end entity;

architecture sim of reciprocal_root_tb is
begin
  presets : for exact in boolean generate
    signal clk        : std_logic := '0';
    signal enable     : std_logic;
    signal square     : std_logic_vector(formats(exact).square.bits - 1 downto 0);
    signal reciprocal : std_logic_vector(formats(exact).root.bits downto 0);
    begin
      dut : entity work.reciprocal_root
        generic map (g_exact => exact)
        port map (clk => clk, enable => enable, square => square, reciprocal => reciprocal);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt", reciprocal_root_latency(exact));
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(square);
          settle;
          vectors.check("reciprocal", reciprocal);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "reciprocal_root_tb");
end architecture;
