-- SPDX-License-Identifier: Apache-2.0
-- Random lines, some of them empty; at full speed, with random stalls, and with resets. Every clock is compared with
-- the contract in the entity's header (tb/vectors/raster.cpp).
library ieee;
use ieee.std_logic_1164.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity line_stage_tb is
  generic (g_folder : string := "line_stage");
end entity;

architecture sim of line_stage_tb is
  signal clk                                 : std_logic := '0';
  signal reset                               : std_logic := '1';
  signal enable, in_valid                    : std_logic;
  signal in_line                             : line_t;
  signal line_ready, span_last_next, advance : std_logic;
  signal step, span_load                     : std_logic;
  signal valid                               : std_logic;
  signal line                                : line_t;
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

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/lines.txt");
    tick(clk); -- of the reset
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(enable);
      vectors.drive(in_valid);
      vectors.drive(in_line);
      vectors.drive(line_ready);
      vectors.drive(span_last_next);
      settle;
      vectors.check("advance", advance);
      vectors.check("step", step);
      vectors.check("span_load", span_load);
      vectors.check("valid", valid);
      vectors.check_if(valid, "line.triangle", line.triangle);
      vectors.check_if(valid, "line.y", line.y);
      vectors.check_if(valid, "line.start", line.start);
      vectors.check_if(valid, "line.stop", line.stop);
      vectors.check_if(valid, "line.remaining", line.remaining);
      vectors.check("line.empty", line.empty);
      vectors.check_if(valid, "line.backward", line.backward);
      vectors.check_if(valid, "line.carry", line.carry);
      tick(clk);
    end loop;
    finish(finished);
  end process;

  report_end(finished, "line_stage_tb");
end architecture;
