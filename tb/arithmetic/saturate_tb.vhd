-- SPDX-License-Identifier: Apache-2.0
-- All values of three small formats; corner cases and random values of the intensity of both presets.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity saturate_run is
  generic (
    g_value_bits    : positive;
    g_fraction_bits : natural;
    g_result_bits   : positive;
    g_folder        : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of saturate_run is
  signal value  : std_logic_vector(g_value_bits - 1 downto 0) := (others => '0');
  signal result : std_logic_vector(g_result_bits - 1 downto 0);
begin
  dut : entity work.saturate
    generic map (g_value_bits => g_value_bits, g_fraction_bits => g_fraction_bits, g_result_bits => g_result_bits)
    port map (value => value, result => result);

  run : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(value'range);
  begin
    vectors.open_file(g_folder & "/" & to_string(g_value_bits) & "_" & to_string(g_fraction_bits) & "_"
      & to_string(g_result_bits) & ".txt");
    while vectors.next_vector loop
      vectors.drive(value);
      wait for 1 ns;
      vectors.check_word("result of " & to_hstring(word), result);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;

entity saturate_tb is
  generic (
    g_folder : string := "saturate"
  );
end entity;

architecture sim of saturate_tb is
  signal finished : boolean_vector(0 to 4);
begin
  spare : entity work.saturate_run
    generic map (g_value_bits => 16, g_fraction_bits => 4, g_result_bits => 8, g_folder => g_folder)
    port map (finished => finished(0));

  tight : entity work.saturate_run
    generic map (g_value_bits => 12, g_fraction_bits => 2, g_result_bits => 8, g_folder => g_folder)
    port map (finished => finished(1));

  whole : entity work.saturate_run
    generic map (g_value_bits => 11, g_fraction_bits => 0, g_result_bits => 8, g_folder => g_folder)
    port map (finished => finished(2));

  presets : for exact in boolean generate
    one : entity work.saturate_run
      generic map (
        g_value_bits    => formats(exact).intensity.bits,
        g_fraction_bits => formats(exact).intensity.fraction,
        g_result_bits   => formats(exact).colour.bits,
        g_folder        => g_folder)
      port map (finished => finished(3 + boolean'pos(exact)));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "saturate_tb: passed" severity note;
    wait;
  end process;
end architecture;
