-- SPDX-License-Identifier: Apache-2.0
-- Reads a file of stimuli, one hexadecimal vector per cycle, and writes the response just before each rising edge.
library ieee;
use ieee.std_logic_1164.all;
use std.textio.all;
use work.netlist_constructs_pkg.all;

entity netlist_constructs_tb is
  generic (
    g_exact     : boolean  := true;
    g_count     : positive := 3;
    g_known_bad : boolean  := false;
    g_shading   : boolean  := false;
    g_construct : natural  := 0;
    g_stimuli   : string   := "stimuli.txt";
    g_responses : string   := "responses.txt"
  );
end entity;

architecture sim of netlist_constructs_tb is
  signal clk      : std_logic := '0';
  signal reset    : std_logic := '1';
  signal stimulus : std_logic_vector(c_stimulus - 1 downto 0) := (others => '0');
  signal response : std_logic_vector(c_lanes * c_lane - 1 downto 0);
begin
  constructs : if g_shading generate
    dut : entity work.netlist_shading
      port map (clk => clk, reset => reset, stimulus => stimulus, response => response);
  elsif not g_known_bad generate
    dut : entity work.netlist_constructs
      generic map (g_exact => g_exact, g_count => g_count)
      port map (clk => clk, reset => reset, stimulus => stimulus, response => response);
  else generate
    dut : entity work.netlist_known_bad
      generic map (g_construct => g_construct)
      port map (clk => clk, reset => reset, stimulus => stimulus, response => response);
  end generate;

  run : process is
    file stimuli       : text;
    file responses     : text;
    variable text_in   : line;
    variable text_out  : line;
    variable value     : std_logic_vector(c_stimulus - 1 downto 0);

    procedure tick is
    begin
      clk <= '1';
      wait for 5 ns;
      clk <= '0';
      wait for 5 ns;
    end procedure;
  begin
    file_open(stimuli, g_stimuli, read_mode);
    file_open(responses, g_responses, write_mode);
    wait for 5 ns;
    for i in 1 to 4 loop
      tick;
    end loop;
    reset <= '0';
    while not endfile(stimuli) loop
      readline(stimuli, text_in);
      hread(text_in, value);
      stimulus <= value;
      wait for 5 ns;
      if is_x(response) then
        report "metavalue in the response" severity failure;
      end if;
      hwrite(text_out, response);
      writeline(responses, text_out);
      tick;
    end loop;
    wait;
  end process;
end architecture;
