-- SPDX-License-Identifier: Apache-2.0
-- Both presets, one and three channels, with all tables, some tables and one table. Every clock is compared with the
-- golden model, each stage stalling at random. Spans of one pixel and long spans, angles beyond the ends of the bell,
-- random words, powers with and without a table.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity specular_slice_run is
  generic (
    g_exact        : boolean;
    g_channels     : positive;
    g_powers       : natural;
    g_address_bits : positive;
    g_data_bits    : positive;
    g_folder       : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of specular_slice_run is
  constant c_product_bits : positive := formats(g_exact).factor.bits + g_data_bits;

  signal clk         : std_logic := '0';
  signal part        : std_logic_vector(specular_bits(g_exact, g_channels) - 1 downto 0) := (others => '0');
  signal span_load   : std_logic := '0';
  signal span_step   : std_logic := '0';
  signal sample_step : std_logic := '0';
  signal lit         : std_logic := '0';
  signal products    : std_logic_vector(g_channels * c_product_bits - 1 downto 0);
begin
  dut : entity work.specular_slice
    generic map (
      g_exact        => g_exact,
      g_channels     => g_channels,
      g_powers       => g_powers,
      g_address_bits => g_address_bits,
      g_data_bits    => g_data_bits)
    port map (
      clk         => clk,
      part        => part,
      span_load   => span_load,
      span_step   => span_step,
      sample_step => sample_step,
      lit         => lit,
      products    => products);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels) & "_" & to_string(g_powers)
      & "_" & to_string(g_address_bits) & "_" & to_string(g_data_bits) & ".txt");
    while vectors.next_clock loop
      vectors.drive(part);
      vectors.drive(span_load);
      vectors.drive(span_step);
      vectors.drive(sample_step);
      vectors.drive(lit);
      wait until rising_edge(clk);
      vectors.check_words("product of channel", c_product_bits, products);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity specular_slice_tb is
  generic (
    g_folder : string := "specular_slice"
  );
end entity;

architecture sim of specular_slice_tb is
  signal finished : boolean_vector(0 to 4);
begin
  all_powers : entity work.specular_slice_run
    generic map (g_exact => true, g_channels => 3, g_powers => 31, g_address_bits => 9, g_data_bits => 8,
      g_folder => g_folder)
    port map (finished => finished(0));

  two_powers : entity work.specular_slice_run
    generic map (g_exact => true, g_channels => 3, g_powers => 18, g_address_bits => 9, g_data_bits => 8,
      g_folder => g_folder)
    port map (finished => finished(1));

  white : entity work.specular_slice_run
    generic map (g_exact => true, g_channels => 1, g_powers => 8, g_address_bits => 9, g_data_bits => 8,
      g_folder => g_folder)
    port map (finished => finished(2));

  published : entity work.specular_slice_run
    generic map (g_exact => false, g_channels => 3, g_powers => 2, g_address_bits => 6, g_data_bits => 6,
      g_folder => g_folder)
    port map (finished => finished(3));

  small : entity work.specular_slice_run
    generic map (g_exact => false, g_channels => 1, g_powers => 2, g_address_bits => 4, g_data_bits => 4,
      g_folder => g_folder)
    port map (finished => finished(4));

  done : process is
  begin
    wait until and finished;
    report "specular_slice_tb: passed" severity note;
    wait;
  end process;
end architecture;
