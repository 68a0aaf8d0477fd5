-- SPDX-License-Identifier: Apache-2.0
-- Every clock is compared with the golden model: at full speed, with stalls at the input, at the output and at both,
-- and with resets. A second check does not use the golden model: every word comes out once, in order, one clock later,
-- and is stable while it waits.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity stream_register_run is
  generic (
    g_bits   : positive;
    g_eager  : boolean := false;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of stream_register_run is
  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal in_valid  : std_logic := '0';
  signal in_ready  : std_logic;
  signal in_data   : std_logic_vector(g_bits - 1 downto 0) := (others => '0');
  signal out_valid : std_logic;
  signal out_ready : std_logic := '0';
  signal out_data  : std_logic_vector(g_bits - 1 downto 0);
begin
  dut : entity work.stream_register
    generic map (g_bits => g_bits, g_eager => g_eager)
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => in_valid,
      in_ready  => in_ready,
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
      vectors.drive(in_valid);
      vectors.drive(in_data);
      vectors.drive(out_ready);
      wait until rising_edge(clk);
      vectors.check_flag_if(checked, "in_ready", in_ready);
      vectors.check_flag_if(checked, "out_valid", out_valid);
      vectors.check_word_if(checked and out_valid, "out_data", out_data);
    end loop;
    finished <= true;
    wait;
  end process;

  contract : process (clk) is
    variable full : boolean := false;
    variable held : std_logic_vector(out_data'range);
  begin
    if rising_edge(clk) and reset = '0' then
      assert (out_valid = '1') = full
        report "stream_register: out_valid is " & to_string(out_valid) & ", words held: " & boolean'image(full)
        severity failure;
      assert not full or out_data = held
        report "stream_register: out_data is " & to_hstring(out_data) & ", expected " & to_hstring(held)
        severity failure;
    end if;
    if rising_edge(clk) then
      if reset = '1' then
        full := false;
      elsif in_valid = '1' and in_ready = '1' then
        assert not full or out_ready = '1'
          report "stream_register: loads a word before the last one is taken" severity failure;
        full := true;
        held := in_data;
      elsif out_ready = '1' then
        full := false;
      end if;
    end if;
  end process;
end architecture;

entity stream_register_tb is
  generic (
    g_folder : string := "stream_register"
  );
end entity;

architecture sim of stream_register_tb is
  signal finished : boolean_vector(0 to 3);
begin
  one_bit : entity work.stream_register_run
    generic map (g_bits => 1, g_folder => g_folder)
    port map (finished => finished(0));

  triangle : entity work.stream_register_run
    generic map (g_bits => 32, g_folder => g_folder)
    port map (finished => finished(1));

  init_vector : entity work.stream_register_run
    generic map (g_bits => 497, g_folder => g_folder)
    port map (finished => finished(2));

  eager : entity work.stream_register_run
    generic map (g_bits => 32, g_eager => true, g_folder => g_folder)
    port map (finished => finished(3));

  done : process is
  begin
    wait until and finished;
    report "stream_register_tb: passed" severity note;
    wait;
  end process;
end architecture;
