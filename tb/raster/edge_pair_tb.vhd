-- SPDX-License-Identifier: Apache-2.0
-- Both presets, ordinary triangles and random words, random waits. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity edge_pair_tb is
  generic (g_folder : string := "edge_pair");
end entity;

architecture sim of edge_pair_tb is
begin
  presets : for exact in boolean generate
    signal clk                        : std_logic := '0';
    signal init                       : std_logic_vector(init_channel_low(exact, 0) - 1 downto 0);
    signal load, section_change, step : std_logic;
    signal start, stop                : span_x_t;
    signal remaining                  : pixels_t;
    signal empty, backward, carry     : std_logic;
    begin
      dut : entity work.edge_pair
        generic map (g_exact => exact)
        port map (
          clk            => clk,
          init           => init,
          load           => load,
          section_change => section_change,
          step           => step,
          start          => start,
          stop           => stop,
          remaining      => remaining,
          empty          => empty,
          backward       => backward,
          carry          => carry);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
        while vectors.next_clock loop
          vectors.drive(load);
          vectors.drive(init);
          vectors.drive(section_change);
          vectors.drive(step);
          settle;
          vectors.check("empty", empty);
          vectors.check("start", start);
          vectors.check("stop", stop);
          vectors.check_if(not empty, "remaining", remaining);
          vectors.check("backward", backward);
          vectors.check("carry", carry);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "edge_pair_tb");
end architecture;
