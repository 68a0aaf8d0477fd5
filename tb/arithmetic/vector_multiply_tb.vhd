-- SPDX-License-Identifier: Apache-2.0
-- Random and extreme vectors in several widths: one product per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity vector_multiply_run is
  generic (
    g_a_bits      : positive;
    g_b_bits      : positive;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of vector_multiply_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal a          : std_logic_vector(3 * g_a_bits - 1 downto 0) := (others => '0');
  signal b          : std_logic_vector(3 * g_b_bits - 1 downto 0) := (others => '0');
  signal products   : std_logic_vector(3 * (g_a_bits + g_b_bits) - 1 downto 0);
begin
  dut : entity work.vector_multiply
    generic map (g_a_bits => g_a_bits, g_b_bits => g_b_bits)
    port map (clk => clk, enable => enable, a => a, b => b, products => products);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_a_bits) & "_" & to_string(g_b_bits) & ".txt");
    vectors.expect_latency(c_vector_multiply_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(a);
      vectors.drive(b);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "products", products);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity vector_multiply_tb is
  generic (
    g_folder : string := "vector_multiply"
  );
end entity;

architecture sim of vector_multiply_tb is
  signal finished : boolean_vector(0 to 4);
begin
  run_0 : entity work.vector_multiply_run
    generic map (g_a_bits => 2, g_b_bits => 5, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.vector_multiply_run
    generic map (g_a_bits => 16, g_b_bits => 11, g_folder => g_folder)
    port map (finished => finished(1));

  run_2 : entity work.vector_multiply_run
    generic map (g_a_bits => 24, g_b_bits => 26, g_folder => g_folder)
    port map (finished => finished(2));

  run_3 : entity work.vector_multiply_run
    generic map (g_a_bits => 28, g_b_bits => 30, g_folder => g_folder)
    port map (finished => finished(3));

  run_4 : entity work.vector_multiply_run
    generic map (g_a_bits => 13, g_b_bits => 26, g_folder => g_folder)
    port map (finished => finished(4));

  done : process is
  begin
    wait until and finished;
    report "vector_multiply_tb: passed" severity note;
    wait;
  end process;
end architecture;
