-- SPDX-License-Identifier: Apache-2.0
-- Products of all operands in random order, one per clock, with another token and another light in each clock.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;
use work.tb_processors_pkg.all;

entity shared_multiplier_run is
  generic (
    g_processor : processor_t;
    g_folder    : string
  );
  port (
    finished : buffer boolean := false
  );
end entity;

architecture sim of shared_multiplier_run is
  constant c_config : config_t   := g_processor.config;
  constant c_kind   : natural    := g_processor.kind;
  constant c_light  : natural    := g_processor.light;
  constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);
  constant c_bits   : positive   := shared_product_bits(c_config, c_kind, c_light);

  -- Clocks of the file's products: k I, the scaled vectors, the light's place, weight and factor, k I times weight.
  constant c_cycles : integer_vector := (c_at.leave, c_at.scale_1, c_at.scale_2, c_at.sum_1 - 1, c_at.narrow, c_at.weigh);

  signal clk      : std_logic := '0';
  signal cycle    : natural range 0 to c_at.leave := 0;
  signal token    : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal light    : std_logic_vector(light_bits(c_config) - 1 downto 0) := (others => '0');
  signal shifted  : std_logic_vector(c_axes * formats(c_config.exact).direction.bits - 1 downto 0) := (others => '0');
  signal root     : std_logic_vector(formats(c_config.exact).root.bits downto 0) := (others => '0');
  signal weight   : std_logic_vector(formats(c_config.exact).weight.bits - 1 downto 0) := (others => '0');
  signal factor   : std_logic_vector(weight'range) := (others => '0');
  signal products : std_logic_vector(c_axes * c_bits - 1 downto 0);
begin
  dut : entity work.shared_multiplier
    generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
    port map (
      clk      => clk,
      cycle    => cycle,
      token    => token,
      light    => light,
      shifted  => shifted,
      root     => root,
      weight   => weight,
      factor   => factor,
      products => products);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable known   : natural range 0 to c_axes;
  begin
    vectors.open_file(g_folder & "/" & processor_name(g_processor) & ".txt");
    while vectors.next_vector loop
      cycle <= c_cycles(vectors.read_number);
      vectors.drive(token);
      vectors.drive(light);
      vectors.drive(shifted);
      vectors.drive(root);
      vectors.drive(weight);
      vectors.drive(factor);
      wait until rising_edge(clk);
      known := vectors.read_number;
      for i in 0 to c_axes - 1 loop
        vectors.check_if(to_flag(i < known), "product " & to_string(i),
          std_logic_vector(resize(signed(products((i + 1) * c_bits - 1 downto i * c_bits)), 64)));
      end loop;
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.tb_processors_pkg.all;

entity shared_multiplier_tb is
  generic (
    g_folder : string := "shared_multiplier"
  );
end entity;

architecture sim of shared_multiplier_tb is
  signal finished : boolean_vector(c_processors'range);
begin
  processors : for i in c_processors'range generate
    checker : entity work.shared_multiplier_run
      generic map (c_processors(i), g_folder)
      port map (finished(i));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shared_multiplier_tb: passed" severity note;
    wait;
  end process;
end architecture;
