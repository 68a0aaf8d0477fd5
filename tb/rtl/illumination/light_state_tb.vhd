-- SPDX-License-Identifier: Apache-2.0
-- Every command, for this light and for others, heads, objects and shadow polygons, and lists of hundreds of shadow
-- polygons. One token per clock, then with pauses. After a reset the light is undefined.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_state_tb is
  generic (g_folder : string := "light_state");
end entity;

architecture sim of light_state_tb is
  constant c_pace : positive := 100; -- number of tokens between changes of the pace
begin
  presets : for exact in boolean generate
    constant c_config : config_t := config(exact, 3, 1, 1, 1, true, true, true, true);

    signal ended                           : boolean := false;
    signal clk                             : std_logic := '0';
    signal reset                           : std_logic := '1';
    signal take                            : std_logic := '0';
    signal token                           : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
    signal object, changes, defined, lit   : std_logic;
    signal light                           : std_logic_vector(light_bits(c_config) - 1 downto 0);
  begin
    dut : entity work.light_state
      generic map (g_config => c_config, g_kind => c_diffuse, g_light => 2)
      port map (
        clk     => clk,
        reset   => reset,
        take    => take,
        token   => token,
        object  => object,
        changes => changes,
        defined => defined,
        light   => light,
        lit     => lit);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable vectors   : vectors_t;
      variable token_now : std_logic_vector(token'range);
      variable random    : unsigned(31 downto 0) := to_unsigned(77, 32);
      variable count     : natural               := 0;
    begin
      vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
      wait_clocks(clk, 1);
      reset <= '0';
      while vectors.next_vector loop
        vectors.read_word(token_now);
        if (count / c_pace) mod 2 = 1 then
          pause(clk, random, 2);
        end if;
        token <= token_now;
        take  <= '1';
        wait until rising_edge(clk);
        vectors.check("object", object);
        vectors.check("changes", changes);
        take  <= '0';
        token <= (others => 'X');
        wait for c_half_period;
        vectors.check("defined", defined);
        vectors.check_if(defined, "light", light);
        vectors.check_if(defined, "lit", lit);
        count := count + 1;
      end loop;
      reset <= '1';
      wait_clocks(clk, 2);
      if defined /= '0' then
        vectors.fail("defined is " & to_string(defined) & " after a reset");
      end if;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "light_state_tb");
end architecture;
