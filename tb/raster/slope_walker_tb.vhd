-- SPDX-License-Identifier: Apache-2.0
-- Random edges, also with wrap-around, with random steps and waits. Every clock is compared with the golden model: x
-- and, if the walker outputs it, the complement of x.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity slope_walker_tb is
  generic (g_folder : string := "slope_walker");
end entity;

architecture sim of slope_walker_tb is
  subtype edge_x_t is std_logic_vector(c_published_formats.edge_x.bits - 1 downto 0);

  signal clk                : std_logic := '0';
  signal load               : std_logic;
  signal load_x, load_slope : edge_x_t;
  signal step               : std_logic;
  signal x, not_x           : std_logic_vector(c_published_formats.span_x.bits - 1 downto 0);
begin
  dut : entity work.slope_walker
    port map (clk => clk, load => load, load_x => load_x, load_slope => load_slope, step => step, x => x);

  complement : entity work.slope_walker
    generic map (g_complement => true)
    port map (clk => clk, load => load, load_x => load_x, load_slope => load_slope, step => step, x => not_x);

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/edges.txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(load);
      vectors.drive(load_x);
      vectors.drive(load_slope);
      vectors.drive(step);
      settle;
      vectors.check_if(checked, "x", x);
      if checked = '1' and not_x /= not x then
        vectors.fail("the complement of " & to_string(x) & " is given as " & to_string(not_x));
      end if;
      tick(clk);
    end loop;
    finish(finished);
  end process;

  report_end(finished, "slope_walker_tb");
end architecture;
