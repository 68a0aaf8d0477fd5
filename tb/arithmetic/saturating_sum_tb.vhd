-- SPDX-License-Identifier: Apache-2.0
-- One term and several. All values of small widths; otherwise all terms at their maximum, sums around the largest
-- result, and random and extreme words.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity saturating_sum_run is
  generic (
    g_terms         : positive;
    g_term_bits     : positive;
    g_fraction_bits : natural;
    g_result_bits   : positive;
    g_folder        : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of saturating_sum_run is
  signal clk    : std_logic := '0';
  signal enable : std_logic := '0';
  signal terms  : std_logic_vector(g_terms * g_term_bits - 1 downto 0) := (others => '0');
  signal result : std_logic_vector(g_result_bits - 1 downto 0);
begin
  dut : entity work.saturating_sum
    generic map (
      g_terms         => g_terms,
      g_term_bits     => g_term_bits,
      g_fraction_bits => g_fraction_bits,
      g_result_bits   => g_result_bits)
    port map (clk => clk, enable => enable, terms => terms, result => result);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_terms) & "_" & to_string(g_term_bits) & "_"
      & to_string(g_fraction_bits) & "_" & to_string(g_result_bits) & ".txt");
    vectors.expect_latency(1);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(terms);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "result", result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity saturating_sum_tb is
  generic (
    g_folder : string := "saturating_sum"
  );
end entity;

architecture sim of saturating_sum_tb is
  type sizes_t is array (natural range <>, natural range <>) of natural;

  -- terms, term, fraction and result bits
  constant c_sizes : sizes_t := ((1, 16, 4, 8), (2, 8, 2, 6), (2, 6, 0, 6), (3, 5, 1, 4), (5, 3, 0, 4), (3, 24, 14, 8),
    (33, 26, 16, 8), (33, 32, 16, 8), (3, 36, 20, 8));

  signal finished : boolean_vector(c_sizes'range(1));
begin
  all_sizes : for i in c_sizes'range(1) generate
    one : entity work.saturating_sum_run
      generic map (
        g_terms         => c_sizes(i, 0),
        g_term_bits     => c_sizes(i, 1),
        g_fraction_bits => c_sizes(i, 2),
        g_result_bits   => c_sizes(i, 3),
        g_folder        => g_folder)
      port map (finished => finished(i));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "saturating_sum_tb: passed" severity note;
    wait;
  end process;
end architecture;
