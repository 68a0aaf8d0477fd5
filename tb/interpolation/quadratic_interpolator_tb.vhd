-- SPDX-License-Identifier: Apache-2.0
-- Both presets. Every combination of the walker's strobes at random, every clock compared with the golden model. In
-- several parts: the same values, later by one clock per additional part.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity quadratic_interpolator_run is
  generic (
    g_exact   : boolean;
    g_file    : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of quadratic_interpolator_run is
  constant c_init_bits : positive := init_channel_low(g_exact, 1) - init_channel_low(g_exact, 0);

  constant c_most_parts : positive := 3;

  type values_t is array (natural range <>) of std_logic_vector(formats(g_exact).intensity.bits - 1 downto 0);

  signal clk        : std_logic := '0';
  signal init       : std_logic_vector(c_init_bits - 1 downto 0) := (others => '0');
  signal line_load  : std_logic := '0';
  signal line_step  : std_logic := '0';
  signal line_carry : std_logic := '0';
  signal span_load  : std_logic := '0';
  signal span_step  : std_logic := '0';

  signal values : values_t(1 to c_most_parts); -- element n: of the interpolator in n parts
begin
  forms : for parts in values'range generate
    dut : entity work.quadratic_interpolator
      generic map (g_exact => g_exact, g_parts => parts)
      port map (
        clk        => clk,
        init       => init,
        line_load  => line_load,
        line_step  => line_step,
        line_carry => line_carry,
        span_load  => span_load,
        span_step  => span_step,
        value      => values(parts));
  end generate;

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors  : vectors_t;
    variable strobe   : std_logic_vector(1 to 5);
    variable checked  : std_logic_vector(0 to c_most_parts - 1) := (others => '0'); -- now, one clock ago, ...
    variable before   : values_t(0 to c_most_parts - 1);
    variable words    : std_logic_vector(init'range);
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      checked(1 to checked'high) := checked(0 to checked'high - 1);
      vectors.read_flag(checked(0));
      vectors.read_word(words);
      for i in strobe'range loop
        vectors.read_flag(strobe(i));
      end loop;
      init <= words;
      (line_load, line_step, line_carry, span_load, span_step) <= strobe;
      wait until rising_edge(clk);
      vectors.check_word_if(checked(0), "value", values(1));
      before := values(1) & before(0 to before'high - 1);
      for parts in 2 to c_most_parts loop
        if checked(parts - 1) = '1' and values(parts) /= before(parts - 1) then
          vectors.fail("value in " & to_string(parts) & " parts is " & to_hstring(values(parts)) & ", expected "
            & to_hstring(before(parts - 1)) & ", that of " & to_string(parts - 1) & " clocks before");
        end if;
      end loop;
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity quadratic_interpolator_tb is
  generic (
    g_folder : string := "quadratic_interpolator"
  );
end entity;

architecture sim of quadratic_interpolator_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact : entity work.quadratic_interpolator_run
    generic map (g_exact => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.quadratic_interpolator_run
    generic map (g_exact => false, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "quadratic_interpolator_tb: passed" severity note;
    wait;
  end process;
end architecture;
