-- SPDX-License-Identifier: Apache-2.0
-- Edges of random triangles and random words, with random steps and waits. Every clock is compared with the golden
-- model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity edge_walker_tb is
  generic (g_folder : string := "edge_walker");
end entity;

architecture sim of edge_walker_tb is
  subtype span_x_t is std_logic_vector(c_exact_formats.span_x.bits - 1 downto 0);
  subtype error_t  is std_logic_vector(c_exact_formats.edge_error.bits - 1 downto 0);

  signal clk                          : std_logic := '0';
  signal load                         : std_logic;
  signal load_x, load_quotient        : span_x_t;
  signal load_remainder, load_divisor : error_t;
  signal load_error                   : error_t;
  signal load_carry, step             : std_logic;
  signal x                            : span_x_t;
  signal carry                        : std_logic;
begin
  dut : entity work.edge_walker
    port map (
      clk            => clk,
      load           => load,
      load_x         => load_x,
      load_quotient  => load_quotient,
      load_remainder => load_remainder,
      load_divisor   => load_divisor,
      load_error     => load_error,
      load_carry     => load_carry,
      step           => step,
      x              => x,
      carry          => carry);

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/edges.txt");
    while vectors.next_clock loop
      vectors.drive(load);
      vectors.drive(load_x);
      vectors.drive(load_quotient);
      vectors.drive(load_remainder);
      vectors.drive(load_divisor);
      vectors.drive(load_error);
      vectors.drive(load_carry);
      vectors.drive(step);
      settle;
      vectors.check("x", x);
      vectors.check("carry", carry);
      tick(clk);
    end loop;
    finish(finished);
  end process;

  report_end(finished, "edge_walker_tb");
end architecture;
