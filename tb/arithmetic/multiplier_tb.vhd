-- SPDX-License-Identifier: Apache-2.0
-- All operands of small widths; random and extreme operands of others. One product per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity multiplier_run is
  generic (
    g_a_bits : positive;
    g_b_bits : positive;
    g_gated  : boolean;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of multiplier_run is
  signal clk     : std_logic := '0';
  signal enable  : std_logic := '0';
  signal a       : std_logic_vector(g_a_bits - 1 downto 0) := (others => '0');
  signal b       : std_logic_vector(g_b_bits - 1 downto 0) := (others => '0');
  signal product : std_logic_vector(g_a_bits + g_b_bits - 1 downto 0);
begin
  dut : entity work.multiplier
    generic map (g_a_bits => g_a_bits, g_b_bits => g_b_bits, g_gated => g_gated)
    port map (clk => clk, enable => enable, a => a, b => b, product => product);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_a_bits) & "_" & to_string(g_b_bits) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(a);
      vectors.drive(b);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "product", product);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity multiplier_tb is
  generic (
    g_folder : string := "multiplier"
  );
end entity;

architecture sim of multiplier_tb is
  type sizes_t is array (natural range <>, natural range <>) of positive;

  constant c_sizes : sizes_t := ((1, 1), (8, 8), (4, 9), (8, 18), (18, 12), (8, 24), (12, 24), (32, 32));

  signal finished, chosen : boolean_vector(c_sizes'range(1)); -- of each form
begin
  all_sizes : for i in c_sizes'range(1) generate
    one : entity work.multiplier_run
      generic map (g_a_bits => c_sizes(i, 0), g_b_bits => c_sizes(i, 1), g_gated => true, g_folder => g_folder)
      port map (finished => finished(i));

    other : entity work.multiplier_run
      generic map (g_a_bits => c_sizes(i, 0), g_b_bits => c_sizes(i, 1), g_gated => false, g_folder => g_folder)
      port map (finished => chosen(i));
  end generate;

  done : process is
  begin
    wait until (and finished) and (and chosen);
    report "multiplier_tb: passed" severity note;
    wait;
  end process;
end architecture;
