-- SPDX-License-Identifier: Apache-2.0
-- Random spans in both directions; at full speed, with random stalls, and with resets. Every clock is compared with the
-- contract in the entity's header (tb/vectors/raster.cpp).
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity span_stage_tb is
  generic (
    g_folder : string := "span_stage"
  );
end entity;

architecture sim of span_stage_tb is
  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal enable    : std_logic := '0';
  signal load      : std_logic := '0';
  signal line      : line_t;
  signal last_next : std_logic;
  signal valid     : std_logic;
  signal triangle  : triangle_t;
  signal y         : pixel_y_t;
  signal x         : span_x_t;
  signal finished  : boolean := false;
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

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/spans.txt");
    wait until rising_edge(clk);
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(enable);
      vectors.drive(load);
      vectors.drive(line);
      wait until rising_edge(clk);
      vectors.check_flag("last_next", last_next);
      vectors.check_flag("valid", valid);
      vectors.check_word_if(valid, "triangle", triangle);
      vectors.check_word_if(valid, "y", std_logic_vector(y));
      vectors.check_word_if(valid, "x", std_logic_vector(x));
    end loop;
    finished <= true;
    report "span_stage_tb: passed" severity note;
    wait;
  end process;
end architecture;
