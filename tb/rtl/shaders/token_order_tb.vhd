-- SPDX-License-Identifier: Apache-2.0
-- Loads, objects and shadow polygons of scenes: at full speed, and with stalls of the pipeline.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity token_order_tb is
  generic (g_folder : string := "token_order");
end entity;

architecture sim of token_order_tb is
  constant c_pace : positive := 60; -- number of words between changes of the pace
begin
  shaders : for i in c_shaders'range generate
    constant c_config : config_t := c_shaders(i);

    signal ended        : boolean := false;
    signal clk          : std_logic := '0';
    signal reset        : std_logic := '1';
    signal load_valid   : std_logic := '0';
    signal load_ready   : std_logic;
    signal object_valid : std_logic := '0';
    signal object_ready : std_logic;
    signal word         : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
    signal token_valid  : std_logic;
    signal token_ready  : std_logic := '0';
    signal token        : std_logic_vector(word'range);
    signal frame_start  : std_logic;
  begin
    dut : entity work.token_order
      generic map (g_config => c_config)
      port map (
        clk          => clk,
        reset        => reset,
        load_valid   => load_valid,
        load_ready   => load_ready,
        load         => word(load_bits(c_config) - 1 downto 0),
        object_valid => object_valid,
        object_ready => object_ready,
        object       => word,
        token_valid  => token_valid,
        token_ready  => token_ready,
        token        => token,
        frame_start  => frame_start);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable vectors : vectors_t;
      variable is_load : std_logic;
      variable random  : unsigned(31 downto 0) := to_unsigned(token_bits(c_config), 32);
      variable count   : natural := 0;
    begin
      vectors.open_file(g_folder & "/" & config_name(c_config) & ".txt");
      wait until rising_edge(clk);
      reset <= '0';
      while vectors.next_vector loop
        vectors.read_flag(is_load);
        vectors.drive(word);
        load_valid   <= is_load;
        object_valid <= not is_load;
        token_ready  <= '0';
        if (count / c_pace) mod 2 = 1 then
          loop
            random := next_random(random);
            exit when chance(random(31 downto 24), 1);
            wait until rising_edge(clk);
            if token_valid /= '1' or load_ready /= '0' or object_ready /= '0' or frame_start /= '0' then
              vectors.fail("a token is not offered, or taken, while the pipeline is not ready");
            end if;
          end loop;
        end if;
        token_ready <= '1';
        wait until rising_edge(clk);
        if token_valid /= '1' or load_ready /= '1' or object_ready /= '1' then
          vectors.fail("a token is not offered, or not taken");
        end if;
        vectors.check("token", token);
        vectors.check("frame_start", frame_start);
        count := count + 1;
      end loop;
      load_valid   <= '0';
      object_valid <= '0';
      wait_clocks(clk, 2);
      if token_valid /= '0' then
        vectors.fail("a token more than there are");
      end if;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "token_order_tb");
end architecture;
