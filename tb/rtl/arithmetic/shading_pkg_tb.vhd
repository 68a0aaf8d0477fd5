-- SPDX-License-Identifier: Apache-2.0
-- Cosines of random and extreme dot products against the golden model. Rounding and clamping against numeric_std.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity shading_pkg_tb is
  generic (g_folder : string := "shading_pkg");
end entity;

architecture sim of shading_pkg_tb is
begin
  presets : for exact in boolean generate
    run : process is
      variable vectors : vectors_t;
      variable dot     : std_logic_vector(2 * formats(exact).direction.bits downto 0);
    begin
      vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
      while vectors.next_vector loop
        vectors.read_word(dot);
        vectors.check("cosine", cosine(exact, signed(dot)));
        vectors.check("positive", is_positive(signed(dot)));
      end loop;
      finish(finished);
    end process;
  end generate;

  calculate : process is
    variable random : unsigned(31 downto 0) := x"2545F491";

    procedure check (name : in string; got, expected : in unsigned) is
    begin
      assert got = expected
        report "shading_pkg: " & name & " is " & to_hstring(got) & ", expected " & to_hstring(expected) severity failure;
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
      whole          := resize(signed(word), word_bits + 1) + signed(half);
      check("round_half_up of unsigned", round_half_up(word, bits), high(word_bits downto bits));
      check("round_half_up of signed", unsigned(round_half_up(signed(word), bits)), unsigned(whole(word_bits downto bits)));
      check("round_half_up to no bit", unsigned(round_half_up(signed(word), 0)), word(word_bits - 1) & word);
      check("round_half_up to no bit", round_half_up(word, 0), '0' & word);
      if word < largest then
        largest := word(bits - 1 downto 0);
      end if;
      check("clamped", clamped(word, bits), largest);
    end procedure;
  begin
    for word_bits in 2 to 34 loop
      for bits in 1 to word_bits - 1 loop
        for i in 1 to 8 loop
          check_rounding(word_bits, bits);
        end loop;
      end loop;
    end loop;
    finish(finished);
  end process;

  report_end(finished, "shading_pkg_tb");
end architecture;
