-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The token of the folded processor, and the fields that it changes. The ambient processor replaces N and the
--             view vector when their unit vectors are valid, and starts the colour. Every processor replaces the colour,
--             in clock `add` of schedule_pkg.
-- Contract    At a rising edge with take the register loads in_token. In the ambient processor, an N that is not to be
--             normalized is converted to a direction at that edge.
-- Formats     tokens: token_pkg; unit: direction; products: shared_multiplier, in add k I or k I times the weight
-- Latency     1 clock
-- Throughput  that of schedule_pkg
-- Error       that of radiance_sum
-- Source      processors paper, figures 1 and 2: the registers, and the vector addition of the colours
-- Golden twin model/golden/radiance_sum.hpp, model/golden/ambient_term.hpp (ready_vectors)

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;

entity token_register is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk      : in  std_logic;
    take     : in  std_logic;
    object   : in  std_logic; -- in_token is one
    in_token : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    cycle    : in  natural range 0 to schedule(g_config, g_kind, g_light).leave;
    defined  : in  std_logic; -- the light
    unit     : in  std_logic_vector(c_axes * formats(g_config.exact).direction.bits - 1 downto 0);
    products : in  std_logic_vector(c_axes * shared_product_bits(g_config, g_kind, g_light) - 1 downto 0);
    token    : out std_logic_vector(token_bits(g_config) - 1 downto 0)
  );
end entity;

architecture rtl of token_register is

  constant c_exact   : boolean        := g_config.exact;
  constant c_shape   : shape_t        := shape(g_config, g_kind, g_light);
  constant c_at      : schedule_t     := schedule(g_config, g_kind, g_light);
  constant c_header  : pixel_header_t := pixel_header(c_exact);
  constant c_product : positive       := shared_product_bits(g_config, g_kind, g_light);

  signal terms : std_logic_vector(g_config.channels * product_bits(c_exact) - 1 downto 0);

begin

  assert g_kind /= c_ambient or ((not c_shape.first or c_at.add /= c_at.round_1)
    and (not c_shape.second or c_at.add /= c_at.round_2))
    report "token_register: the term is added in clock " & integer'image(c_at.add) & ", N is taken in clock "
    & integer'image(c_at.round_1) & ", the view vector in clock " & integer'image(c_at.round_2)
    severity failure;

  choose_terms : process (all)
    constant c_k_i  : positive := formats(c_exact).coefficient.bits + formats(c_exact).light_intensity.bits;
    constant c_term : positive := product_bits(c_exact);
  begin
    for channel in 0 to g_config.channels - 1 loop
      if g_kind = c_ambient then
        terms((channel + 1) * c_term - 1 downto channel * c_term) <= unweighted(c_exact,
          reflected(c_exact, unsigned(products(channel * c_product + c_k_i - 1 downto channel * c_product))));
      else
        terms((channel + 1) * c_term - 1 downto channel * c_term) <=
          products(channel * c_product + c_term - 1 downto channel * c_product);
      end if;
    end loop;
  end process;

  registers : process (clk)
    variable v : std_logic_vector(in_token'range);
  begin
    if rising_edge(clk) then
      if take = '1' then
        v := in_token;
        if g_kind = c_ambient and object = '1' then
          -- Start the colour
          v := with_radiance(g_config, v, first_radiance(g_config));
          -- Take an N that is not to be normalized as a direction
          if not (c_shape.first and in_token(c_header.normalize.low) = '1') then
            v := with_direction(g_config, v, plain_directions(c_exact, normal_of(g_config, in_token)));
          end if;
        end if;
        token <= v;
      end if;
      -- Take the unit vector N
      if g_kind = c_ambient and c_shape.first and cycle = c_at.round_1 and token(c_header.normalize.low) = '1' then
        token <= with_direction(g_config, token, unit);
      end if;
      -- Take the view vector
      if g_kind = c_ambient and c_shape.second and cycle = c_at.round_2 then
        token <= with_view(g_config, token, unit);
      end if;
      -- Add the term
      if cycle = c_at.add and defined = '1' then
        token <= with_radiance(g_config, token, brightened(c_exact, radiance_of(g_config, token), terms,
          g_config.channels));
      end if;
    end if;
  end process;

end architecture;
