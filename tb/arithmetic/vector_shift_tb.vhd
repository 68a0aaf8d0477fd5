-- SPDX-License-Identifier: Apache-2.0
-- All vectors of small widths; otherwise each shift, and random vectors. One per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity vector_shift_run is
  generic (
    g_vector_bits : positive;
    g_result_bits : positive;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of vector_shift_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal components : std_logic_vector(3 * g_vector_bits - 1 downto 0) := (others => '0');
  signal shifted    : std_logic_vector(3 * g_result_bits - 1 downto 0);
begin
  dut : entity work.vector_shift
    generic map (g_vector_bits => g_vector_bits, g_result_bits => g_result_bits)
    port map (clk => clk, enable => enable, components => components, shifted => shifted);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_vector_bits) & "_" & to_string(g_result_bits) & ".txt");
    vectors.expect_latency(c_vector_shift_latency);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(components);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "shifted", shifted);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity vector_shift_tb is
  generic (
    g_folder : string := "vector_shift"
  );
end entity;

architecture sim of vector_shift_tb is
  signal finished : boolean_vector(0 to 4);
begin
  run_0 : entity work.vector_shift_run
    generic map (g_vector_bits => 5, g_result_bits => 5, g_folder => g_folder)
    port map (finished => finished(0));

  run_1 : entity work.vector_shift_run
    generic map (g_vector_bits => 30, g_result_bits => 24, g_folder => g_folder)
    port map (finished => finished(1));

  run_2 : entity work.vector_shift_run
    generic map (g_vector_bits => 25, g_result_bits => 24, g_folder => g_folder)
    port map (finished => finished(2));

  run_3 : entity work.vector_shift_run
    generic map (g_vector_bits => 17, g_result_bits => 16, g_folder => g_folder)
    port map (finished => finished(3));

  run_4 : entity work.vector_shift_run
    generic map (g_vector_bits => 16, g_result_bits => 24, g_folder => g_folder)
    port map (finished => finished(4));

  done : process is
  begin
    wait until and finished;
    report "vector_shift_tb: passed" severity note;
    wait;
  end process;
end architecture;
