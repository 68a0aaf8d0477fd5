-- SPDX-License-Identifier: Apache-2.0
-- Random cones; points in the rim, at its edges and at random: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity spot_cone_tb is
  generic (g_folder : string := "spot_cone");
end entity;

architecture sim of spot_cone_tb is
begin
  presets : for exact in boolean generate
    signal clk      : std_logic := '0';
    signal enable   : std_logic;
    signal axis_sum : std_logic_vector(2 * formats(exact).direction.bits downto 0);
    signal outer    : std_logic_vector(formats(exact).direction.bits - 1 downto 0);
    signal slope    : std_logic_vector(formats(exact).spot_slope.bits - 1 downto 0);
    signal factor   : std_logic_vector(formats(exact).weight.bits - 1 downto 0);
    begin
      dut : entity work.spot_cone
        generic map (g_exact => exact)
        port map (clk => clk, enable => enable, axis_sum => axis_sum, outer => outer, slope => slope, factor => factor);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt", c_spot_cone_latency);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(axis_sum);
          vectors.drive(outer);
          vectors.drive(slope);
          settle;
          vectors.check("factor", factor);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "spot_cone_tb");
end architecture;
