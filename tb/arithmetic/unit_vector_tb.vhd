-- SPDX-License-Identifier: Apache-2.0
-- Each axis and shift, zero, opposite and random vectors: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity unit_vector_run is
  generic (
    g_exact       : boolean;
    g_vector_bits : positive;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of unit_vector_run is
  signal clk        : std_logic := '0';
  signal enable     : std_logic := '0';
  signal components : std_logic_vector(3 * g_vector_bits - 1 downto 0) := (others => '0');
  signal unit       : std_logic_vector(3 * formats(g_exact).direction.bits - 1 downto 0);
begin
  dut : entity work.unit_vector
    generic map (g_exact => g_exact, g_vector_bits => g_vector_bits)
    port map (clk => clk, enable => enable, components => components, unit => unit);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_vector_bits) & ".txt");
    vectors.expect_latency(unit_vector_latency(g_exact));
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(components);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "unit", unit);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity unit_vector_tb is
  generic (
    g_folder : string := "unit_vector"
  );
end entity;

architecture sim of unit_vector_tb is
  signal finished : boolean_vector(0 to 4);
begin
  -- Preset exact: N and the view ray, then L and H. Preset published: N and L.
  exact_vector : entity work.unit_vector_run
    generic map (g_exact => true, g_vector_bits => 30, g_folder => g_folder)
    port map (finished => finished(0));

  exact_offset : entity work.unit_vector_run
    generic map (g_exact => true, g_vector_bits => 31, g_folder => g_folder)
    port map (finished => finished(1));

  exact_half : entity work.unit_vector_run
    generic map (g_exact => true, g_vector_bits => 25, g_folder => g_folder)
    port map (finished => finished(2));

  published_vector : entity work.unit_vector_run
    generic map (g_exact => false, g_vector_bits => 16, g_folder => g_folder)
    port map (finished => finished(3));

  published_offset : entity work.unit_vector_run
    generic map (g_exact => false, g_vector_bits => 17, g_folder => g_folder)
    port map (finished => finished(4));

  done : process is
  begin
    wait until and finished;
    report "unit_vector_tb: passed" severity note;
    wait;
  end process;
end architecture;
