-- SPDX-License-Identifier: Apache-2.0
-- Products of all operands in random order, one per clock, with another token and another light in each clock.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity shared_multiplier_tb is
  generic (g_folder : string := "shared_multiplier");
end entity;

architecture sim of shared_multiplier_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
    constant c_bits    : positive   := shared_product_bits(c_config, c_kind, c_light);

    -- Clocks of the file's products: k I, the scaled vectors, the light's place, weight and factor, k I times weight.
    constant c_cycles : integer_vector := (c_at.leave, c_at.scale_1, c_at.scale_2, c_at.sum_1 - 1, c_at.narrow, c_at.weigh);

    signal clk            : std_logic := '0';
    signal cycle          : natural range 0 to c_at.leave := 0;
    signal token          : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal light          : std_logic_vector(light_bits(c_config) - 1 downto 0);
    signal shifted        : std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0);
    signal root           : std_logic_vector(c_formats.root.bits downto 0);
    signal weight, factor : std_logic_vector(c_formats.weight.bits - 1 downto 0);
    signal products       : std_logic_vector(c_axes * c_bits - 1 downto 0);
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

      run : process is
        variable vectors : vectors_t;
        variable known   : natural range 0 to c_axes;
      begin
        vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
        while vectors.next_vector loop
          cycle <= c_cycles(vectors.read_number);
          vectors.drive(token);
          vectors.drive(light);
          vectors.drive(shifted);
          vectors.drive(root);
          vectors.drive(weight);
          vectors.drive(factor);
          settle;
          known := vectors.read_number;
          for axis in 0 to c_axes - 1 loop
            vectors.check_if(to_flag(axis < known), "product " & to_string(axis),
              resize(signed(products((axis + 1) * c_bits - 1 downto axis * c_bits)), 64));
          end loop;
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "shared_multiplier_tb");
end architecture;
