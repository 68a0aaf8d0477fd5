-- SPDX-License-Identifier: Apache-2.0
-- Random edges, also with wrap-around, with random steps and waits. Every clock is compared with the golden model: x
-- and, if the walker outputs it, the complement of x.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity slope_walker_tb is
  generic (
    g_folder : string := "slope_walker"
  );
end entity;

architecture sim of slope_walker_tb is
  subtype edge_x_t is std_logic_vector(c_published_formats.edge_x.bits - 1 downto 0);

  signal clk        : std_logic := '0';
  signal load       : std_logic := '0';
  signal load_x     : edge_x_t := (others => '0');
  signal load_slope : edge_x_t := (others => '0');
  signal step       : std_logic := '0';
  signal x, not_x   : std_logic_vector(c_published_formats.span_x.bits - 1 downto 0);
  signal finished   : boolean := false;
begin
  dut : entity work.slope_walker
    port map (
      clk        => clk,
      load       => load,
      load_x     => load_x,
      load_slope => load_slope,
      step       => step,
      x          => x);

  complement : entity work.slope_walker
    generic map (g_complement => true)
    port map (
      clk        => clk,
      load       => load,
      load_x     => load_x,
      load_slope => load_slope,
      step       => step,
      x          => not_x);

  clk <= not clk after c_half_period when not finished;

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
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "x", x);
      if checked = '1' then
        assert not_x = not x
          report "slope_walker_tb: the complement of " & to_string(x) & " is given as " & to_string(not_x)
          severity failure;
      end if;
    end loop;
    finished <= true;
    report "slope_walker_tb: passed" severity note;
    wait;
  end process;
end architecture;
