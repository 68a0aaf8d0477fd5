-- SPDX-License-Identifier: Apache-2.0
-- Cosines of random and extreme dot products by the golden twin; products through integers against numeric_std's, of
-- every width up to 34 bits; rounding and holding against sums of numeric_std.
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

    -- One in four runs of like bits: extreme words.
    procedure draw (word : out unsigned) is
      variable bits : unsigned(word'length - 1 downto 0);
    begin
      for i in bits'range loop
        random  := next_random(random);
        bits(i) := random(7);
        if i < bits'high and random(31 downto 29) /= "000" and random(28 downto 27) = "00" then
          bits(i) := bits(i + 1);
        end if;
      end loop;
      random := next_random(random);
      case to_integer(random(3 downto 0)) is
        when 0      => bits := (others => '0');
        when 1      => bits := (others => '1');
        when 2      => bits := (others => '0'); bits(bits'high) := '1';
        when 3      => bits := (others => '1'); bits(bits'high) := '0';
        when others => null;
      end case;
      word := bits;
    end procedure;

    procedure check (name : in string; got, expected : in std_logic_vector) is
    begin
      if got /= expected then
        report "shading_pkg: " & name & " is " & to_hstring(got) & ", expected " & to_hstring(expected)
          severity failure;
      end if;
    end procedure;

    procedure check_products (a_bits, b_bits : in positive) is
      variable a, c : unsigned(a_bits - 1 downto 0);
      variable b, d : unsigned(b_bits - 1 downto 0);
      variable sum  : signed(a_bits + b_bits downto 0);
    begin
      draw(a);
      draw(b);
      draw(c);
      draw(d);
      check("product of signed", std_logic_vector(product(signed(a), signed(b))),
        std_logic_vector(signed(a) * signed(b)));
      check("product of unsigned", std_logic_vector(product(a, b)), std_logic_vector(a * b));
      sum := resize(signed(a) * signed(b), sum'length) + signed(c) * signed(d) + signed(c) * signed(b);
      check("sum of products", std_logic_vector(sum_of_products(std_logic_vector(c & c & a),
        std_logic_vector(b & d & b))), std_logic_vector(sum));
    end procedure;

    procedure check_rounding (word_bits, bits : in positive) is
      variable word    : unsigned(word_bits - 1 downto 0);
      variable half    : unsigned(word_bits downto 0);
      variable high    : unsigned(word_bits downto 0);
      variable whole   : signed(word_bits downto 0);
      variable largest : unsigned(bits - 1 downto 0) := (others => '1');
    begin
      draw(word);
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
      check("held", std_logic_vector(held(word, bits)), std_logic_vector(largest));
    end procedure;
  begin
    for a_bits in 2 to 34 loop
      for b_bits in 2 to 34 loop
        for i in 1 to 8 loop
          check_products(a_bits, b_bits);
        end loop;
      end loop;
      for bits in 1 to a_bits - 1 loop
        for i in 1 to 8 loop
          check_rounding(a_bits, bits);
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
