-- SPDX-License-Identifier: Apache-2.0
-- Sums and unit vectors in random order, one per clock, with another token and another light in each clock.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity shared_adder_tb is
  generic (g_folder : string := "shared_adder");
end entity;

architecture sim of shared_adder_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
    constant c_shape   : shape_t    := shape(c_config, c_kind, c_light);

    -- Clocks of the file's steps: none, the sums, the unit vectors.
    constant c_cycles : integer_vector := (c_at.leave, c_at.sum_1, c_at.sum_2, c_at.round_1, c_at.round_2);
    begin
      needed : if c_kind /= c_ambient generate
        subtype direction_t is std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);

        signal clk            : std_logic := '0';
        signal cycle          : natural range 0 to c_at.leave := 0;
        signal positional     : std_logic;
        signal token          : std_logic_vector(token_bits(c_config) - 1 downto 0);
        signal light          : std_logic_vector(light_bits(c_config) - 1 downto 0);
        signal products       : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
        signal unit           : direction_t;
        signal sum            : std_logic_vector(c_axes * normalized_bits(c_config, c_kind, c_light) - 1 downto 0);
        signal to_light, half : direction_t;
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

          run : process is
            variable vectors : vectors_t;
            variable places  : std_logic_vector(c_axes * (c_formats.light_place.bits + c_formats.vector.bits) - 1 downto 0);
          begin
            vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
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
              settle;
              vectors.check_known("sum", sum);
              vectors.check_known("to_light", to_light);
              vectors.check_known("half", half);
              tick(clk);
            end loop;
            finish(finished);
          end process;
      end generate;
  end generate;

  report_end(finished, "shared_adder_tb");
end architecture;
