-- SPDX-License-Identifier: Apache-2.0
-- Reads a file of stimuli, one hexadecimal vector per cycle, and writes the response just before each rising edge.
library ieee;
use ieee.std_logic_1164.all;
use std.textio.all;

entity netlist_known_bad_tb is
  generic (
    g_construct : natural := 0;
    g_stimuli   : string  := "stimuli.txt";
    g_responses : string  := "responses.txt"
  );
end entity;

architecture sim of netlist_known_bad_tb is
  signal clk      : std_logic := '0';
  signal reset    : std_logic := '1';
  signal stimulus : std_logic_vector(159 downto 0) := (others => '0');
  signal response : std_logic_vector(95 downto 0);
begin
  dut : entity work.netlist_known_bad
    generic map (g_construct => g_construct)
    port map (clk => clk, reset => reset, stimulus => stimulus, response => response);

  run : process is
    file stimuli       : text;
    file responses     : text;
    variable text_in   : line;
    variable text_out  : line;
    variable value     : std_logic_vector(159 downto 0);

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
