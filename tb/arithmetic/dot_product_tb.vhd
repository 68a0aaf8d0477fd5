-- SPDX-License-Identifier: Apache-2.0
-- Random and extreme vectors and squares of vectors, in several widths: one sum per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity dot_product_run is
  generic (
    g_bits        : positive;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of dot_product_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal a          : std_logic_vector(3 * g_bits - 1 downto 0) := (others => '0');
  signal b          : std_logic_vector(3 * g_bits - 1 downto 0) := (others => '0');
  signal sum        : std_logic_vector((2 * g_bits + 1) - 1 downto 0);
begin
  dut : entity work.dot_product
    generic map (g_bits => g_bits)
    port map (clk => clk, enable => enable, a => a, b => b, sum => sum);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & ".txt");
    vectors.expect_latency(c_dot_product_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(a);
      vectors.drive(b);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "sum", sum);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity dot_product_tb is
  generic (
    g_folder : string := "dot_product"
  );
end entity;

architecture sim of dot_product_tb is
  signal finished : boolean_vector(0 to 3);
begin
  run_0 : entity work.dot_product_run
    generic map (g_bits => 4, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.dot_product_run
    generic map (g_bits => 16, g_folder => g_folder)
    port map (finished => finished(1));

  run_2 : entity work.dot_product_run
    generic map (g_bits => 24, g_folder => g_folder)
    port map (finished => finished(2));

  run_3 : entity work.dot_product_run
    generic map (g_bits => 30, g_folder => g_folder)
    port map (finished => finished(3));

  done : process is
  begin
    wait until and finished;
    report "dot_product_tb: passed" severity note;
    wait;
  end process;
end architecture;
