-- SPDX-License-Identifier: Apache-2.0
-- Both presets, ordinary triangles and random words, also without upper lines; at full speed, with random stalls, and
-- with resets. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity line_counter_run is
  generic (
    g_exact : boolean;
    g_file  : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of line_counter_run is
  signal clk            : std_logic := '0';
  signal reset          : std_logic := '1';
  signal init_valid     : std_logic := '0';
  signal init_ready     : std_logic;
  signal init           : std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0) := (others => '0');
  signal advance        : std_logic := '0';
  signal step           : std_logic;
  signal load           : std_logic;
  signal section_change : std_logic;
  signal valid          : std_logic;
  signal first          : std_logic;
  signal triangle       : triangle_t;
  signal y              : pixel_y_t;
begin
  dut : entity work.line_counter
    generic map (g_exact => g_exact)
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => init_valid,
      init_ready     => init_ready,
      init           => init,
      advance        => advance,
      step           => step,
      load           => load,
      section_change => section_change,
      valid          => valid,
      first          => first,
      triangle       => triangle,
      y              => y);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
  begin
    vectors.open_file(g_file);
    wait until rising_edge(clk);
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(init_valid);
      vectors.drive(init);
      vectors.drive(advance);
      wait until rising_edge(clk);
      vectors.check_flag("init_ready", init_ready);
      vectors.check_flag("step", step);
      vectors.check_flag("load", load);
      vectors.check_flag_if(valid, "section_change", section_change);
      vectors.check_flag("valid", valid);
      vectors.check_flag("first", first);
      vectors.check_word_if(valid, "triangle", triangle);
      vectors.check_word_if(valid, "y", std_logic_vector(y));
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity line_counter_tb is
  generic (
    g_folder : string := "line_counter"
  );
end entity;

architecture sim of line_counter_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact : entity work.line_counter_run
    generic map (g_exact => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.line_counter_run
    generic map (g_exact => false, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "line_counter_tb: passed" severity note;
    wait;
  end process;
end architecture;
