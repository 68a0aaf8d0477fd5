-- SPDX-License-Identifier: Apache-2.0
-- Both presets, ordinary triangles and random words, also without upper lines; at full speed, with random stalls, and
-- with resets. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity line_counter_tb is
  generic (g_folder : string := "line_counter");
end entity;

architecture sim of line_counter_tb is
begin
  presets : for exact in boolean generate
    signal clk                                 : std_logic := '0';
    signal reset                               : std_logic := '1';
    signal init_valid, init_ready              : std_logic;
    signal init                                : std_logic_vector(init_channel_low(exact, 0) - 1 downto 0);
    signal advance, step, load, section_change : std_logic;
    signal valid                               : std_logic;
    signal first                               : std_logic;
    signal triangle                            : triangle_t;
    signal y                                   : pixel_y_t;
    begin
      dut : entity work.line_counter
        generic map (g_exact => exact)
        port map (
          clk            => clk,
          reset          => reset,
          init_valid     => init_valid,
          init_ready     => init_ready,
          init           => init,
          advance        => advance,
          step           => step,
          load           => load,
          section_change => section_change,
          valid          => valid,
          first          => first,
          triangle       => triangle,
          y              => y);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
        tick(clk); -- of the reset
        while vectors.next_vector loop
          vectors.drive(reset);
          vectors.drive(init_valid);
          vectors.drive(init);
          vectors.drive(advance);
          settle;
          vectors.check("init_ready", init_ready);
          vectors.check("step", step);
          vectors.check("load", load);
          vectors.check_if(valid, "section_change", section_change);
          vectors.check("valid", valid);
          vectors.check("first", first);
          vectors.check_if(valid, "triangle", triangle);
          vectors.check_if(valid, "y", y);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "line_counter_tb");
end architecture;
