-- SPDX-License-Identifier: Apache-2.0
-- Every command, for this light and for others, objects and shadow polygons, and more shadow volumes than the counter
-- can count. One token per clock, then with pauses. After a reset the light is undefined.
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
    signal offered                         : std_logic := '0';
    signal take                            : std_logic;
    signal token                           : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
    signal ready, object, changes, defined : std_logic;
    signal light                           : std_logic_vector(light_bits(c_config) - 1 downto 0);
    signal lit, fault                      : std_logic;
  begin
    dut : entity work.light_state
      generic map (g_config => c_config, g_kind => c_diffuse, g_light => 2)
      port map (
        clk     => clk,
        reset   => reset,
        take    => take,
        token   => token,
        ready   => ready,
        object  => object,
        changes => changes,
        defined => defined,
        light   => light,
        lit     => lit,
        fault   => fault);

    take <= offered and ready;

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable vectors   : vectors_t;
      variable token_now : std_logic_vector(token'range);
      variable is_object : std_logic;
      variable random    : unsigned(31 downto 0) := to_unsigned(77, 32);
      variable count     : natural               := 0;
      variable faulty    : std_logic             := '0'; -- expected fault after the previous token
      variable earlier   : std_logic             := '0'; -- expected fault after the token before that
    begin
      vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
      wait_clocks(clk, 1);
      reset <= '0';
      while vectors.next_vector loop
        vectors.read_word(token_now);
        if (count / c_pace) mod 2 = 1 then
          pause(clk, random, 2);
        end if;
        token   <= token_now;
        offered <= '1';
        wait until rising_edge(clk) and ready = '1';
        is_object := object;
        vectors.check("object", object);
        vectors.check("changes", changes);
        -- fault is set two clocks after its token.
        if (fault = '1' and faulty = '0') or (fault /= '1' and earlier = '1') then
          vectors.fail("fault is " & to_string(fault) & ", after the last two tokens " & to_string(earlier)
            & to_string(faulty));
        end if;
        earlier := faulty;
        offered <= '0';
        token   <= (others => 'X');
        wait for c_half_period;
        vectors.check("defined", defined);
        vectors.check_if(defined, "light", light);
        vectors.check_if(is_object and defined, "lit", lit);
        vectors.read_flag(faulty);
        count := count + 1;
      end loop;
      wait_clocks(clk, 2);
      if faulty /= '1' or fault /= '1' then
        vectors.fail("fault is " & to_string(fault) & " in the end");
      end if;
      reset <= '1';
      wait_clocks(clk, 2);
      if defined /= '0' or fault /= '0' then
        vectors.fail("defined is " & to_string(defined) & ", fault " & to_string(fault) & " after a reset");
      end if;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "light_state_tb");
end architecture;
