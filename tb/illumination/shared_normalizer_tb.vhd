-- SPDX-License-Identifier: Apache-2.0
-- Vectors, their squares and their products with 1/sqrt, each of another vector, one per clock. Half of the vectors are
-- shifted; the shifted vector does not change in the other clocks.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity shared_normalizer_tb is
  generic (g_folder : string := "shared_normalizer");
end entity;

architecture sim of shared_normalizer_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
    constant c_shape   : shape_t    := shape(c_config, c_kind, c_light);

    -- Clocks of the file's steps: none, the shifts.
    constant c_cycles : integer_vector := (c_at.leave, c_at.shift_1, c_at.shift_2);
    begin
      needed : if c_shape.first or c_shape.second generate
        signal clk           : std_logic := '0';
        signal cycle         : natural range 0 to c_at.leave := 0;
        signal vector        : std_logic_vector(c_axes * normalized_bits(c_config, c_kind, c_light) - 1 downto 0);
        signal dot           : std_logic_vector(2 * c_formats.direction.bits downto 0);
        signal products      : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
        signal shifted, unit : std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);
        signal root          : std_logic_vector(c_formats.root.bits downto 0);
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

          run : process is
            variable vectors : vectors_t;
            variable scaled  : std_logic_vector(shifted'length + c_axes * (root'length + 1) - 1 downto 0);
          begin
            vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
            while vectors.next_vector loop
              cycle <= c_cycles(vectors.read_number);
              vectors.drive(vector);
              vectors.drive(dot);
              vectors.read_word(scaled);
              products <= spaced(scaled, products'length / c_axes);
              settle;
              vectors.check_known("shifted", shifted);
              vectors.check_known("root", root);
              vectors.check("unit", unit);
              tick(clk);
            end loop;
            finish(finished);
          end process;
      end generate;
  end generate;

  report_end(finished, "shared_normalizer_tb");
end architecture;
