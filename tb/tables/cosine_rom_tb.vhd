-- SPDX-License-Identifier: Apache-2.0
-- Reads every entry of every table: in order, one per clock, then at random with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity cosine_rom_run is
  generic (
    g_exact        : boolean;
    g_power        : positive;
    g_address_bits : positive;
    g_data_bits    : positive;
    g_folder       : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of cosine_rom_run is
  signal clk     : std_logic := '0';
  signal enable  : std_logic := '0';
  signal address : std_logic_vector(g_address_bits - 1 downto 0) := (others => '0');
  signal sample  : std_logic_vector(g_data_bits - 1 downto 0);
begin
  dut : entity work.cosine_rom
    generic map (
      g_exact        => g_exact,
      g_power        => g_power,
      g_address_bits => g_address_bits,
      g_data_bits    => g_data_bits)
    port map (clk => clk, enable => enable, address => address, sample => sample);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_power) & "_"
      & to_string(g_address_bits) & "_" & to_string(g_data_bits) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(enable);
      vectors.drive(address);
      wait until rising_edge(clk);
      vectors.check_word_if(checked, "sample", sample);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity cosine_rom_tb is
  generic (
    g_folder : string := "cosine_rom"
  );
end entity;

architecture sim of cosine_rom_tb is
  signal finished : boolean_vector(0 to 8);
begin
  exact : for i in 0 to 4 generate
    one : entity work.cosine_rom_run
      generic map (g_exact => true, g_power => 2 ** i, g_address_bits => 9, g_data_bits => 8, g_folder => g_folder)
      port map (finished => finished(i));
  end generate;

  published : for i in 0 to 1 generate
    one : entity work.cosine_rom_run
      generic map (g_exact => false, g_power => 2 ** i, g_address_bits => 6, g_data_bits => 6, g_folder => g_folder)
      port map (finished => finished(5 + i));

    small : entity work.cosine_rom_run
      generic map (g_exact => false, g_power => 2 ** i, g_address_bits => 4, g_data_bits => 4, g_folder => g_folder)
      port map (finished => finished(7 + i));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "cosine_rom_tb: passed" severity note;
    wait;
  end process;
end architecture;
