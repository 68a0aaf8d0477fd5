-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The state of a processor: its light, whether the light is defined, and the shadow volumes around each
--             column. Both forms of a processor contain one light_state. A token changes the state by its command:
--               define            the light's registers load the token's words; the light is defined
--               redefine          the same, if the light is defined
--               delete            the light is no longer defined
--               shadow            the volumes of the token's column: one more, or one less (shadow_counter)
--               new_frame         no volumes around any column
--             The first four apply only if the token has the number of this light. Only new_frame clears the volumes: a
--             light that is deleted and defined again within a frame keeps them.
-- Contract    At a rising edge with take the token is taken; take must be '0' while ready is '0'. object and changes
--             belong to the token that is offered. lit belongs to the last token taken, until the next one is taken; it
--             has a meaning only for an object. It is '1' without g_config.shadows and in the ambient processor. After reset the light is not defined.
--             fault: shadow_counter.
-- Formats     token, light: token_pkg
-- Latency     1 clock from take to light, defined and lit
-- Throughput  1 token per clock
-- Source      processors paper, section 3.2 (the registers of the loading mode), section 3.3 and figure 2 (the counter)
-- Golden twin model/golden/light_state.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
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
    ready   : out std_logic;
    object  : out std_logic; -- the token is an object to shade
    changes : out std_logic; -- the token changes the light
    defined : out std_logic;
    light   : out std_logic_vector(light_bits(g_config) - 1 downto 0);
    lit     : out std_logic;
    fault   : out std_logic
  );
end entity;

architecture rtl of light_state is

  constant c_header : pixel_header_t := pixel_header(g_config.exact);

  type reg_t is record
    defined : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal command : command_t;
  signal own     : std_logic; -- the token has this light's number
  signal load    : std_logic; -- its words become the light

begin

  command <= command_of(g_config.exact, token);
  own     <= '1' when unsigned(field_of(token, c_header.light)) = g_light else '0';
  object  <= is_object(command);
  changes <= '1' when own = '1' and (command = c_define or command = c_redefine or command = c_delete) else '0';
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
    if reset = '1' then
      v.defined := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  shadows : if g_config.shadows and g_kind /= c_ambient generate

    signal counts : std_logic;
    signal clear  : std_logic;

  begin

    counts <= '1' when command = c_shadow and own = '1' else '0';
    clear  <= '1' when command = c_new_frame else '0';

    counter : entity work.shadow_counter
      port map (
        clk        => clk,
        reset      => reset,
        ready      => ready,
        step       => take,
        clear      => clear,
        counts     => counts,
        opens      => token(c_header.opens.low),
        object     => object,
        x          => field_of(token, c_header.x),
        around_eye => field_of(light, light_axes_header(g_config.exact).around_eye),
        lit        => lit,
        fault      => fault
        );

  else generate

    ready <= '1';
    lit   <= '1';
    fault <= '0';

  end generate;

end architecture;
