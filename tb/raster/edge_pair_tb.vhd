-- SPDX-License-Identifier: Apache-2.0
-- Both presets, ordinary triangles and random words, random waits. Every clock is compared with the golden model.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.tb_pkg.all;

entity edge_pair_run is
  generic (
    g_exact : boolean;
    g_file  : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of edge_pair_run is
  signal clk            : std_logic := '0';
  signal init           : std_logic_vector(init_channel_low(g_exact, 0) - 1 downto 0) := (others => '0');
  signal load           : std_logic := '0';
  signal section_change : std_logic := '0';
  signal step           : std_logic := '0';
  signal start          : span_x_t;
  signal stop           : span_x_t;
  signal remaining      : pixels_t;
  signal empty          : std_logic;
  signal backward       : std_logic;
  signal carry          : std_logic;
begin
  dut : entity work.edge_pair
    generic map (g_exact => g_exact)
    port map (
      clk            => clk,
      init           => init,
      load           => load,
      section_change => section_change,
      step           => step,
      start          => start,
      stop           => stop,
      remaining      => remaining,
      empty          => empty,
      backward       => backward,
      carry          => carry);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(load);
      vectors.drive(init);
      vectors.drive(section_change);
      vectors.drive(step);
      wait until rising_edge(clk);
      vectors.check_flag_if(checked, "empty", empty);
      vectors.check_word_if(checked, "start", std_logic_vector(start));
      vectors.check_word_if(checked, "stop", std_logic_vector(stop));
      vectors.check_word_if(checked and not empty, "remaining", std_logic_vector(remaining));
      vectors.check_flag_if(checked, "backward", backward);
      vectors.check_flag_if(checked, "carry", carry);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

entity edge_pair_tb is
  generic (
    g_folder : string := "edge_pair"
  );
end entity;

architecture sim of edge_pair_tb is
  signal finished : boolean_vector(0 to 1);
begin
  exact : entity work.edge_pair_run
    generic map (g_exact => true, g_file => g_folder & "/exact.txt")
    port map (finished => finished(0));

  published : entity work.edge_pair_run
    generic map (g_exact => false, g_file => g_folder & "/published.txt")
    port map (finished => finished(1));

  done : process is
  begin
    wait until and finished;
    report "edge_pair_tb: passed" severity note;
    wait;
  end process;
end architecture;
