-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The state of a processor: its light, whether the light is defined, and the number of its shadow volumes that
--             the pixel's list has opened and not closed. Both forms of a processor contain one light_state. A token
--             changes the state by its command:
--               define                              the light's registers load the token's words; it is defined; count 0
--               redefine                            the same, if the light is defined
--               delete                              the light is no longer defined; count 0
--               shadow                              count + 1 if the polygon opens a volume, - 1 if it closes one
--               new_pixel, new_scanline, new_frame  count 0
--             The first four apply only if the token has the number of this light.
-- Contract    At a rising edge with take the token is taken. object and changes belong to the token that is offered. lit
--             is '1' if no volume contains the objects that follow: the volumes around the eye and the count are 0 or
--             less. A volume that is thinner than the rounding of its depths may be closed before it is opened. lit is
--             '1' without g_config.shadows and in the ambient processor. After reset the light is not defined. A pixel
--             must not have more shadow polygons of a light than the count can hold.
-- Formats     token, light: token_pkg; the count: shadow_count, the same in both presets
-- Latency     1 clock from take to light, defined and lit
-- Throughput  1 token per clock
-- Source      processors paper, section 3.2 (the registers of the loading mode), section 3.3 and figure 2 (the counter)
-- Golden twin model/golden/light_state.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

entity light_state is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk     : in  std_logic;
    reset   : in  std_logic;
    take    : in  std_logic;
    token   : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    object  : out std_logic; -- the token is an object to shade
    changes : out std_logic; -- the token changes the light
    defined : out std_logic;
    light   : out std_logic_vector(light_bits(g_config) - 1 downto 0);
    lit     : out std_logic
  );
end entity;

architecture rtl of light_state is

  constant c_header  : pixel_header_t := pixel_header(g_config.exact);
  constant c_shadows : boolean        := g_config.shadows and g_kind /= c_ambient;

  subtype count_t is signed(formats(g_config.exact).shadow_count.bits - 1 downto 0);

  type reg_t is record
    defined : std_logic;
    count   : count_t; -- shadow volumes opened minus those closed
  end record;

  signal r, r_next : reg_t;

  signal command : command_t;
  signal own     : std_logic; -- the token has this light's number
  signal load    : std_logic; -- its words become the light

begin

  command <= command_of(g_config.exact, token);
  own     <= '1' when unsigned(field_of(token, c_header.light)) = g_light else '0';
  object  <= is_object(command);
  changes <= own and is_load(command) and flag(command /= c_new_frame);
  load    <= '1' when own = '1' and (command = c_define or (command = c_redefine and r.defined = '1')) else '0';
  defined <= r.defined;

  light_register : entity work.parameter_register
    generic map (
      g_bits => light'length
      )
    port map (
      clk   => clk,
      load  => take and load,
      start => light_of(g_config, token),
      value => light
      );

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if take = '1' then
      if load = '1' then
        v.defined := '1';
      elsif own = '1' and command = c_delete then
        v.defined := '0';
      end if;
    end if;
    if c_shadows and take = '1' then
      if own = '1' and command = c_shadow then
        v.count := r.count - 1;
        if token(c_header.opens.low) = '1' then
          v.count := r.count + 1;
        end if;
      elsif is_head(command) = '1' or command = c_new_frame or load = '1' or (own = '1' and command = c_delete) then
        v.count := (others => '0');
      end if;
    end if;
    if reset = '1' then
      v.defined := '0';
      v.count   := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  count_volumes : process (all)
    variable around : signed(count_t'length downto 0); -- volumes around an object
  begin
    around := resize(r.count, around'length)
      + signed(field_of(light, light_axes_header(g_config.exact).around_eye));
    lit <= flag(around <= 0) when c_shadows else '1';
  end process;

end architecture;
