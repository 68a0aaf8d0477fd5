-- SPDX-License-Identifier: Apache-2.0
-- Every command, for this light and for others, objects and shadow polygons, and more shadow volumes than the counter
-- can count. One token per clock, then with pauses. After a reset the light is undefined.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity light_state_run is
  generic (
    g_exact  : boolean;
    g_folder : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of light_state_run is
  constant c_config : config_t := config(g_exact, 3, 1, 1, 1, true, true, true, true);
  -- Number of tokens between changes of the pace.
  constant c_pace : positive := 100;

  signal clk     : std_logic := '0';
  signal reset   : std_logic := '1';
  signal offered : std_logic := '0';
  signal take    : std_logic;
  signal token   : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal ready   : std_logic;
  signal object  : std_logic;
  signal changes : std_logic;
  signal defined : std_logic;
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0);
  signal lit     : std_logic;
  signal fault   : std_logic;
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

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors   : vectors_t;
    variable token_now : std_logic_vector(token'range);
    variable is_object : std_logic;
    variable random    : unsigned(31 downto 0) := to_unsigned(77, 32);
    variable count     : natural := 0;
    variable faulty    : std_logic := '0'; -- expected fault after the previous token
    variable earlier   : std_logic := '0'; -- expected fault after the token before that
  begin
    vectors.open_file(g_folder & "/" & preset_name(g_exact) & ".txt");
    wait until rising_edge(clk);
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
    for i in 1 to 2 loop
      wait until rising_edge(clk);
    end loop;
    if faulty /= '1' or fault /= '1' then
      vectors.fail("fault is " & to_string(fault) & " in the end");
    end if;
    reset <= '1';
    for i in 1 to 2 loop
      wait until rising_edge(clk);
    end loop;
    if defined /= '0' or fault /= '0' then
      vectors.fail("defined is " & to_string(defined) & ", fault " & to_string(fault) & " after a reset");
    end if;
    finished <= true;
    wait;
  end process;
end architecture;

entity light_state_tb is
  generic (
    g_folder : string := "light_state"
  );
end entity;

architecture sim of light_state_tb is
  signal finished : boolean_vector(0 to 1);
begin
  presets : for preset in 0 to 1 generate
    checker : entity work.light_state_run
      generic map (preset = 0, g_folder)
      port map (finished(preset));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "light_state_tb: passed" severity note;
    wait;
  end process;
end architecture;
