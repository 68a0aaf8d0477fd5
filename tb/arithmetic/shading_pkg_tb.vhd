-- SPDX-License-Identifier: Apache-2.0
-- Cosines of random and extreme dot products against the golden model. Rounding and clamping against numeric_std.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity shading_pkg_run is
  generic (
    g_exact  : boolean;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of shading_pkg_run is
begin
  run : process is
    variable vectors : vectors_t;
    variable dot     : std_logic_vector(2 * formats(g_exact).direction.bits downto 0);
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt");
    while vectors.next_vector loop
      vectors.read_word(dot);
      vectors.check_word("cosine", std_logic_vector(cosine(g_exact, signed(dot))));
      vectors.check_flag("positive", is_positive(signed(dot)));
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity shading_pkg_tb is
  generic (
    g_folder : string := "shading_pkg"
  );
end entity;

architecture sim of shading_pkg_tb is
  signal finished    : boolean_vector(0 to 1);
  signal calculated  : boolean := false;

begin
  exact : entity work.shading_pkg_run
    generic map (g_exact => true, g_folder => g_folder)
    port map (finished => finished(0));

  published : entity work.shading_pkg_run
    generic map (g_exact => false, g_folder => g_folder)
    port map (finished => finished(1));

  calculate : process is
    variable random : unsigned(31 downto 0) := x"2545F491";

    procedure check (name : in string; got, expected : in std_logic_vector) is
    begin
      if got /= expected then
        report "shading_pkg: " & name & " is " & to_hstring(got) & ", expected " & to_hstring(expected)
          severity failure;
      end if;
    end procedure;

    procedure check_rounding (word_bits, bits : in positive) is
      variable word    : unsigned(word_bits - 1 downto 0);
      variable half    : unsigned(word_bits downto 0);
      variable high    : unsigned(word_bits downto 0);
      variable whole   : signed(word_bits downto 0);
      variable largest : unsigned(bits - 1 downto 0) := (others => '1');
    begin
      draw_word(random, word);
      half           := (others => '0');
      half(bits - 1) := '1';
      high           := ('0' & word) + half;
      check("round_half_up of unsigned", std_logic_vector(round_half_up(word, bits)),
        std_logic_vector(high(word_bits downto bits)));
      whole := resize(signed(word), word_bits + 1) + signed(half);
      check("round_half_up of signed", std_logic_vector(round_half_up(signed(word), bits)),
        std_logic_vector(whole(word_bits downto bits)));
      check("round_half_up to no bit", std_logic_vector(round_half_up(signed(word), 0)),
        std_logic_vector(resize(signed(word), word_bits + 1)));
      check("round_half_up to no bit", std_logic_vector(round_half_up(word, 0)), std_logic_vector('0' & word));
      if word < largest then
        largest := word(bits - 1 downto 0);
      end if;
      check("clamped", std_logic_vector(clamped(word, bits)), std_logic_vector(largest));
    end procedure;
  begin
    for word_bits in 2 to 34 loop
      for bits in 1 to word_bits - 1 loop
        for i in 1 to 8 loop
          check_rounding(word_bits, bits);
        end loop;
      end loop;
    end loop;
    calculated <= true;
    wait;
  end process;

  done : process is
  begin
    wait until (and finished) and calculated;
    report "shading_pkg_tb: passed" severity note;
    wait;
  end process;
end architecture;
