-- SPDX-License-Identifier: Apache-2.0
-- Random lines, some of them empty; at full speed, with random stalls, and with resets. Every clock is compared with
-- the contract in the entity's header (tb/vectors/raster.cpp).
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity line_stage_tb is
  generic (
    g_folder : string := "line_stage"
  );
end entity;

architecture sim of line_stage_tb is
  signal clk            : std_logic := '0';
  signal reset          : std_logic := '1';
  signal enable         : std_logic := '0';
  signal in_valid       : std_logic := '0';
  signal in_line        : line_t;
  signal line_ready     : std_logic := '0';
  signal span_last_next : std_logic := '0';
  signal advance        : std_logic;
  signal step           : std_logic;
  signal span_load      : std_logic;
  signal valid          : std_logic;
  signal line           : line_t;
  signal finished       : boolean := false;
begin
  dut : entity work.line_stage
    port map (
      clk            => clk,
      reset          => reset,
      enable         => enable,
      in_valid       => in_valid,
      in_line        => in_line,
      line_ready     => line_ready,
      span_last_next => span_last_next,
      advance        => advance,
      step           => step,
      span_load      => span_load,
      valid          => valid,
      line           => line);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/lines.txt");
    wait until rising_edge(clk);
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(enable);
      vectors.drive(in_valid);
      vectors.drive(in_line);
      vectors.drive(line_ready);
      vectors.drive(span_last_next);
      wait until rising_edge(clk);
      vectors.check_flag("advance", advance);
      vectors.check_flag("step", step);
      vectors.check_flag("span_load", span_load);
      vectors.check_flag("valid", valid);
      vectors.check_word_if(valid, "line.triangle", line.triangle);
      vectors.check_word_if(valid, "line.y", std_logic_vector(line.y));
      vectors.check_word_if(valid, "line.start", std_logic_vector(line.start));
      vectors.check_word_if(valid, "line.stop", std_logic_vector(line.stop));
      vectors.check_word_if(valid, "line.remaining", std_logic_vector(line.remaining));
      vectors.check_flag("line.empty", line.empty);
      vectors.check_flag_if(valid, "line.backward", line.backward);
      vectors.check_flag_if(valid, "line.carry", line.carry);
    end loop;
    finished <= true;
    report "line_stage_tb: passed" severity note;
    wait;
  end process;
end architecture;
