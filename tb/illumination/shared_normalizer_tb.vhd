-- SPDX-License-Identifier: Apache-2.0
-- Vectors, their squares and their products with 1/sqrt, each of another vector, one per clock. Half of the vectors are
-- shifted; the shifted vector does not change in the other clocks.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;
use work.tb_processors_pkg.all;

entity shared_normalizer_run is
  generic (
    g_processor : processor_t;
    g_folder    : string
  );
  port (
    finished : buffer boolean := false
  );
end entity;

architecture sim of shared_normalizer_run is
  constant c_config : config_t   := g_processor.config;
  constant c_kind   : natural    := g_processor.kind;
  constant c_light  : natural    := g_processor.light;
  constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);

  -- Clocks of the file's steps: none, the shifts.
  constant c_cycles : integer_vector := (c_at.leave, c_at.shift_1, c_at.shift_2);

  signal clk      : std_logic := '0';
  signal cycle    : natural range 0 to c_at.leave := 0;
  signal vector   : std_logic_vector(c_axes * normalized_bits(c_config, c_kind, c_light) - 1 downto 0) := (others => '0');
  signal dot      : std_logic_vector(2 * formats(c_config.exact).direction.bits downto 0) := (others => '0');
  signal products : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
  signal shifted  : std_logic_vector(c_axes * formats(c_config.exact).direction.bits - 1 downto 0);
  signal root     : std_logic_vector(formats(c_config.exact).root.bits downto 0);
  signal unit     : std_logic_vector(shifted'range);
begin
  dut : entity work.shared_normalizer
    generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
    port map (
      clk      => clk,
      cycle    => cycle,
      vector   => vector,
      dot      => dot,
      products => products,
      shifted  => shifted,
      root     => root,
      unit     => unit);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable scaled  : std_logic_vector(shifted'length + c_axes * (root'length + 1) - 1 downto 0);
    variable known   : std_logic;
  begin
    vectors.open_file(g_folder & "/" & processor_name(g_processor) & ".txt");
    while vectors.next_vector loop
      cycle <= c_cycles(vectors.read_number);
      vectors.drive(vector);
      vectors.drive(dot);
      vectors.read_word(scaled);
      products <= spaced(scaled, products'length / c_axes);
      wait until rising_edge(clk);
      vectors.read_flag(known);
      vectors.check_if(known, "shifted", shifted);
      vectors.read_flag(known);
      vectors.check_if(known, "root", root);
      vectors.check("unit", unit);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;

entity shared_normalizer_tb is
  generic (
    g_folder : string := "shared_normalizer"
  );
end entity;

architecture sim of shared_normalizer_tb is
  signal finished : boolean_vector(c_processors'range);
begin
  processors : for i in c_processors'range generate
    constant c_processor : processor_t := c_processors(i);
    constant c_shape : shape_t := shape(c_processor.config, c_processor.kind, c_processor.light);
    begin
      unit : if c_shape.first or c_shape.second generate
        checker : entity work.shared_normalizer_run
          generic map (c_processor, g_folder)
          port map (finished(i));
      else generate
        finished(i) <= true;
      end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shared_normalizer_tb: passed" severity note;
    wait;
  end process;
end architecture;
