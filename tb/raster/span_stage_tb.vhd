-- SPDX-License-Identifier: Apache-2.0
-- Random spans in both directions; at full speed, with random stalls, and with resets. Every clock is compared with the
-- contract in the entity's header (tb/vectors/raster.cpp).
library ieee;
use ieee.std_logic_1164.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity span_stage_tb is
  generic (g_folder : string := "span_stage");
end entity;

architecture sim of span_stage_tb is
  signal clk              : std_logic := '0';
  signal reset            : std_logic := '1';
  signal enable, load     : std_logic;
  signal line             : line_t;
  signal last_next, valid : std_logic;
  signal triangle         : triangle_t;
  signal y                : pixel_y_t;
  signal x                : span_x_t;
begin
  dut : entity work.span_stage
    port map (
      clk       => clk,
      reset     => reset,
      enable    => enable,
      load      => load,
      line      => line,
      last_next => last_next,
      valid     => valid,
      triangle  => triangle,
      y         => y,
      x         => x);

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/spans.txt");
    tick(clk); -- of the reset
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(enable);
      vectors.drive(load);
      vectors.drive(line);
      settle;
      vectors.check("last_next", last_next);
      vectors.check("valid", valid);
      vectors.check_if(valid, "triangle", triangle);
      vectors.check_if(valid, "y", y);
      vectors.check_if(valid, "x", x);
      tick(clk);
    end loop;
    finish(finished);
  end process;

  report_end(finished, "span_stage_tb");
end architecture;
