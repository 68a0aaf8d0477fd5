-- SPDX-License-Identifier: Apache-2.0
-- Products of all operands in random order, one per clock.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;
use work.tb_processors_pkg.all;

entity shared_dot_product_run is
  generic (
    g_processor : processor_t;
    g_folder    : string
  );
  port (
    finished : buffer boolean := false
  );
end entity;

architecture sim of shared_dot_product_run is
  constant c_config : config_t   := g_processor.config;
  constant c_kind   : natural    := g_processor.kind;
  constant c_light  : natural    := g_processor.light;
  constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);

  -- Clocks of the file's operands: N and A, the shifted vectors, L and the axis, N and L.
  constant c_cycles : integer_vector := (c_at.cosine, c_at.square_1, c_at.square_2, c_at.axis, c_at.sum_2);

  signal clk      : std_logic := '0';
  signal cycle    : natural range 0 to c_at.leave := 0;
  signal shifted  : std_logic_vector(c_axes * formats(c_config.exact).direction.bits - 1 downto 0) := (others => '0');
  signal normal   : std_logic_vector(shifted'range) := (others => '0');
  signal to_light : std_logic_vector(shifted'range) := (others => '0');
  signal half     : std_logic_vector(shifted'range) := (others => '0');
  signal axis     : std_logic_vector(shifted'range) := (others => '0');
  signal dot      : std_logic_vector(2 * formats(c_config.exact).direction.bits downto 0);
begin
  dut : entity work.shared_dot_product
    generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
    port map (
      clk      => clk,
      cycle    => cycle,
      shifted  => shifted,
      normal   => normal,
      to_light => to_light,
      half     => half,
      axis     => axis,
      dot      => dot);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors : vectors_t;
    variable known   : std_logic;
  begin
    vectors.open_file(g_folder & "/" & processor_name(g_processor) & ".txt");
    while vectors.next_vector loop
      cycle <= c_cycles(vectors.read_number);
      vectors.drive(shifted);
      vectors.drive(normal);
      vectors.drive(to_light);
      vectors.drive(half);
      vectors.drive(axis);
      wait until rising_edge(clk);
      vectors.read_flag(known);
      vectors.check_if(known, "dot", dot);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;

entity shared_dot_product_tb is
  generic (
    g_folder : string := "shared_dot_product"
  );
end entity;

architecture sim of shared_dot_product_tb is
  signal finished : boolean_vector(c_processors'range);
begin
  processors : for i in c_processors'range generate
    constant c_processor : processor_t := c_processors(i);
    constant c_shape : shape_t := shape(c_processor.config, c_processor.kind, c_processor.light);
    begin
      unit : if c_processor.kind /= c_ambient or c_shape.first or c_shape.second generate
        checker : entity work.shared_dot_product_run
          generic map (c_processor, g_folder)
          port map (finished(i));
      else generate
        finished(i) <= true;
      end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shared_dot_product_tb: passed" severity note;
    wait;
  end process;
end architecture;
