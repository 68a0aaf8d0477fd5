-- SPDX-License-Identifier: Apache-2.0
-- Products of all operands in random order, one per clock.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity shared_dot_product_tb is
  generic (g_folder : string := "shared_dot_product");
end entity;

architecture sim of shared_dot_product_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
    constant c_shape   : shape_t    := shape(c_config, c_kind, c_light);

    -- Clocks of the file's operands: N and A, the shifted vectors, L and the axis, N and L.
    constant c_cycles : integer_vector := (c_at.cosine, c_at.square_1, c_at.square_2, c_at.axis, c_at.sum_2);
    begin
      needed : if c_kind /= c_ambient or c_shape.first or c_shape.second generate
        signal clk                             : std_logic := '0';
        signal cycle                           : natural range 0 to c_at.leave := 0;
        signal shifted, normal, to_light, half : std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);
        signal axis                            : std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);
        signal dot                             : std_logic_vector(2 * c_formats.direction.bits downto 0);
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

          run : process is
            variable vectors : vectors_t;
          begin
            vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
            while vectors.next_vector loop
              cycle <= c_cycles(vectors.read_number);
              vectors.drive(shifted);
              vectors.drive(normal);
              vectors.drive(to_light);
              vectors.drive(half);
              vectors.drive(axis);
              settle;
              vectors.check_known("dot", dot);
              tick(clk);
            end loop;
            finish(finished);
          end process;
      end generate;
  end generate;

  report_end(finished, "shared_dot_product_tb");
end architecture;
