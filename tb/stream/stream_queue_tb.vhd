-- SPDX-License-Identifier: Apache-2.0
-- Every clock is compared with the golden model: at full speed, with stalls at the input, at the output and at both,
-- and with resets. A second check does not use the golden model: every word comes out once, in order, and is stable
-- while it waits.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity stream_queue_run is
  generic (
    g_bits       : positive;
    g_index_bits : positive;
    g_folder     : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of stream_queue_run is
  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal claim     : std_logic := '0';
  signal room      : std_logic;
  signal pending   : std_logic;
  signal in_valid  : std_logic := '0';
  signal in_data   : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal out_valid : std_logic;
  signal out_ready : std_logic := '0';
  signal out_data  : std_logic_vector(g_bits - 1 downto 0);
begin
  dut : entity work.stream_queue
    generic map (g_bits => g_bits, g_index_bits => g_index_bits)
    port map (
      clk       => clk,
      reset     => reset,
      claim     => claim,
      room      => room,
      pending   => pending,
      in_valid  => in_valid,
      in_data   => in_data,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => out_data);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic;
  begin
    vectors.open_file(g_folder & "/" & to_string(g_bits) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(checked);
      vectors.drive(reset);
      vectors.drive(claim);
      vectors.drive(in_valid);
      vectors.drive(in_data);
      vectors.drive(out_ready);
      wait until rising_edge(clk);
      vectors.check_flag_if(checked, "room", room);
      vectors.check_flag_if(checked, "pending", pending);
      vectors.check_flag_if(checked, "out_valid", out_valid);
      vectors.check_word_if(checked and out_valid, "out_data", out_data);
    end loop;
    finished <= true;
    wait;
  end process;

  contract : process (clk) is
    type words_t is array (0 to 2 ** g_index_bits - 1) of std_logic_vector(out_data'range);

    variable words   : words_t;
    variable count   : natural := 0;
    variable waiting : boolean := false;
    variable held    : std_logic_vector(out_data'range);
  begin
    if rising_edge(clk) then
      assert not waiting or (out_valid = '1' and out_data = held)
        report "stream_queue: a word that waits changes" severity failure;
      if reset = '1' then
        count   := 0;
        waiting := false;
      else
        if out_valid = '1' then
          assert count > 0 and out_data = words(0)
            report "stream_queue: out_data is " & to_hstring(out_data) & ", not the oldest word" severity failure;
        end if;
        waiting := out_valid = '1' and out_ready = '0';
        held    := out_data;
        if out_valid = '1' and out_ready = '1' then
          words(0 to words'high - 1) := words(1 to words'high);
          count := count - 1;
        end if;
        if in_valid = '1' then
          words(count) := in_data;
          count := count + 1;
        end if;
      end if;
    end if;
  end process;
end architecture;

entity stream_queue_tb is
  generic (
    g_folder : string := "stream_queue"
  );
end entity;

architecture sim of stream_queue_tb is
  signal finished : boolean_vector(0 to 3);
begin
  one_bit : entity work.stream_queue_run
    generic map (g_bits => 1, g_index_bits => 2, g_folder => g_folder)
    port map (finished => finished(0));

  one_word : entity work.stream_queue_run
    generic map (g_bits => 32, g_index_bits => 3, g_folder => g_folder)
    port map (finished => finished(1));

  fragment : entity work.stream_queue_run
    generic map (g_bits => 97, g_index_bits => 3, g_folder => g_folder)
    port map (finished => finished(2));

  longer : entity work.stream_queue_run
    generic map (g_bits => 98, g_index_bits => 4, g_folder => g_folder)
    port map (finished => finished(3));

  done : process is
  begin
    wait until and finished;
    report "stream_queue_tb: passed" severity note;
    wait;
  end process;
end architecture;
