-- SPDX-License-Identifier: Apache-2.0
-- Preset published: every angle. Preset exact: both ends of every cell within three half bells of the top, every power
-- of two and its neighbours, random words.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity angle_address_run is
  generic (
    g_exact        : boolean;
    g_address_bits : positive;
    g_folder       : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of angle_address_run is
  signal angle    : std_logic_vector(formats(g_exact).angle.bits - 1 downto 0) := (others => '0');
  signal address  : std_logic_vector(g_address_bits - 1 downto 0);
  signal in_range : std_logic;
begin
  dut : entity work.angle_address
    generic map (g_exact => g_exact, g_address_bits => g_address_bits)
    port map (angle => angle, address => address, in_range => in_range);

  run : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(angle'range);
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_address_bits) & ".txt");
    while vectors.next_vector loop
      vectors.drive(angle);
      wait for 1 ns;
      vectors.check_word("address of " & to_hstring(word), address);
      vectors.check_flag("in_range of " & to_hstring(word), in_range);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity angle_address_tb is
  generic (
    g_folder : string := "angle_address"
  );
end entity;

architecture sim of angle_address_tb is
  constant c_exact_bits     : integer_vector := (3, 9, 12);
  constant c_published_bits : integer_vector := (4, 6, 12);

  signal exact_finished     : boolean_vector(c_exact_bits'range);
  signal published_finished : boolean_vector(c_published_bits'range);
begin
  exact : for i in c_exact_bits'range generate
    one : entity work.angle_address_run
      generic map (g_exact => true, g_address_bits => c_exact_bits(i), g_folder => g_folder)
      port map (finished => exact_finished(i));
  end generate;

  published : for i in c_published_bits'range generate
    one : entity work.angle_address_run
      generic map (g_exact => false, g_address_bits => c_published_bits(i), g_folder => g_folder)
      port map (finished => published_finished(i));
  end generate;

  done : process is
  begin
    wait until (and exact_finished) and (and published_finished);
    report "angle_address_tb: passed" severity note;
    wait;
  end process;
end architecture;
