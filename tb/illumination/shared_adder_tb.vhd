-- SPDX-License-Identifier: Apache-2.0
-- Sums and unit vectors in random order, one per clock, with another token and another light in each clock.
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

entity shared_adder_run is
  generic (
    g_processor : processor_t;
    g_folder    : string
  );
  port (
    finished : buffer boolean := false
  );
end entity;

architecture sim of shared_adder_run is
  constant c_config : config_t   := g_processor.config;
  constant c_kind   : natural    := g_processor.kind;
  constant c_light  : natural    := g_processor.light;
  constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);
  constant c_shape  : shape_t    := shape(c_config, c_kind, c_light);
  constant c_place  : positive   := formats(c_config.exact).light_place.bits + formats(c_config.exact).vector.bits;

  -- Clocks of the file's steps: none, the sums, the unit vectors.
  constant c_cycles : integer_vector := (c_at.leave, c_at.sum_1, c_at.sum_2, c_at.round_1, c_at.round_2);

  signal clk        : std_logic := '0';
  signal cycle      : natural range 0 to c_at.leave := 0;
  signal positional : std_logic := '0';
  signal token      : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal light      : std_logic_vector(light_bits(c_config) - 1 downto 0) := (others => '0');
  signal products   : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
  signal unit       : std_logic_vector(c_axes * formats(c_config.exact).direction.bits - 1 downto 0) := (others => '0');
  signal sum        : std_logic_vector(c_axes * normalized_bits(c_config, c_kind, c_light) - 1 downto 0);
  signal to_light   : std_logic_vector(unit'range);
  signal half       : std_logic_vector(unit'range);
begin
  dut : entity work.shared_adder
    generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
    port map (
      clk        => clk,
      cycle      => cycle,
      positional => positional,
      token      => token,
      light      => light,
      products   => products,
      unit       => unit,
      sum        => sum,
      to_light   => to_light,
      half       => half);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable places  : std_logic_vector(c_axes * c_place - 1 downto 0);
    variable known   : std_logic;
  begin
    vectors.open_file(g_folder & "/" & processor_name(g_processor) & ".txt");
    while vectors.next_vector loop
      cycle <= c_cycles(vectors.read_number);
      vectors.drive(positional);
      vectors.drive(token);
      vectors.drive(light);
      vectors.read_word(places);
      products <= (others => 'X');
      if c_shape.far then
        products <= spaced(places, products'length / c_axes);
      end if;
      vectors.drive(unit);
      wait until rising_edge(clk);
      vectors.read_flag(known);
      vectors.check_if(known, "sum", sum);
      vectors.read_flag(known);
      vectors.check_if(known, "to_light", to_light);
      vectors.read_flag(known);
      vectors.check_if(known, "half", half);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.processors_pkg.all;
use work.tb_processors_pkg.all;

entity shared_adder_tb is
  generic (
    g_folder : string := "shared_adder"
  );
end entity;

architecture sim of shared_adder_tb is
  signal finished : boolean_vector(c_processors'range);
begin
  processors : for i in c_processors'range generate
    constant c_processor : processor_t := c_processors(i);
    begin
      unit : if c_processor.kind /= c_ambient generate
        checker : entity work.shared_adder_run
          generic map (c_processor, g_folder)
          port map (finished(i));
      else generate
        finished(i) <= true;
      end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shared_adder_tb: passed" severity note;
    wait;
  end process;
end architecture;
