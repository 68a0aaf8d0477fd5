-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One term of the illumination model, unrolled: I_out = I_in + k I (N.A)**x with one unit per step. It takes
--             one token per clock. The results equal those of shading_processor bit for bit.
--
--               in_token --+-- light_state      commands, the light, shadow volumes
--                          |
--                          +-- ambient_term     k_a I_a, unit vectors N and V  | or
--                          +-- light_term       k I (N.A)**x of one light      | (drawings of the steps there)
--                          |                                          |
--                          +-- delay_line       the token             v
--                                                 +------------- radiance_sum -- out_token
--
--             A token is taken in clock 0. After n clocks it is in stage n. Its term is valid in stage c_at.term, its
--             sum in stage c_at.leave = c_at.term + 1.
-- Contract    as shading_processor, except for latency and throughput. All stages stall together while out_token waits.
--             A token that defines, changes or deletes the light is taken only when the stages are empty. fault stays
--             '1', at the latest from the clock after the counting token has left.
-- Formats     processors_pkg, formats_pkg; fields of tokens: token_pkg; words between the steps: terms_pkg
-- Latency     times of terms_pkg: leave (published, exact): ambient 2, 2; with N normalized or the view vector 6, 9;
--             directional diffuse 4, 4, specular 5, 18; positional diffuse 10, 14, specular 11, 28; spot diffuse 14, 18,
--             specular 14, 29
-- Throughput  1 token per clock; a token that changes the light waits until the stages are empty
-- Source      processors paper, figures 1 and 2, unrolled; ours
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;

entity unrolled_shading_processor is
  generic (
    g_exact       : boolean                                      := true;
    g_channels    : natural range 1 to 3                         := 3;
    g_directional : natural                                      := 0; -- lights of each kind
    g_positional  : natural                                      := 0;
    g_spots       : natural                                      := 0;
    g_diffuse     : boolean                                      := true;
    g_specular    : boolean                                      := true;
    g_normalize   : boolean                                      := true;
    g_shadows     : boolean                                      := false;
    g_kind        : natural range c_ambient to c_specular        := c_ambient;
    g_light       : natural                                      := 0 -- 0: the ambient one
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_token  : in  std_logic_vector(token_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows)) - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_token : out std_logic_vector(token_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots,
      g_diffuse, g_specular, g_normalize, g_shadows)) - 1 downto 0);
    busy      : out std_logic; -- holds a token
    fault     : out std_logic
  );
end entity;

architecture rtl of unrolled_shading_processor is

  constant c_config : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_at     : times_t  := times(c_config, g_kind, g_light);

  subtype token_t is std_logic_vector(in_token'range);
  subtype radiance_t is std_logic_vector(g_channels * formats(g_exact).radiance.bits - 1 downto 0);
  subtype directions_t is std_logic_vector(c_axes * formats(g_exact).direction.bits - 1 downto 0);

  type reg_t is record
    filled : std_logic_vector(c_at.leave downto 1); -- stages that hold a token
  end record;

  signal r, r_next : reg_t;

  signal enable  : std_logic; -- of all stages
  signal free    : std_logic;
  signal take    : std_logic;
  signal ready   : std_logic; -- of the light's state
  signal changes : std_logic; -- the token offered changes the light
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0);
  signal defined : std_logic; -- the light
  signal lit     : std_logic; -- the token in stage 1

  -- Of the token in stage c_at.term.
  signal term_token : token_t;
  signal object     : std_logic;
  signal terms      : std_logic_vector(g_channels * product_bits(g_exact) - 1 downto 0);
  signal reached    : std_logic; -- by the light
  signal ready_token : token_t;  -- output token without its new colour

  signal leaving  : token_t;
  signal radiance : radiance_t;

begin

  enable <= out_ready or not r.filled(c_at.leave);
  free   <= enable and ready and not (in_valid and changes and (or r.filled));
  take   <= in_valid and free;

  in_ready  <= free;
  out_valid <= r.filled(c_at.leave);
  out_token <= with_radiance(c_config, leaving, radiance);
  busy      <= or r.filled;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if enable = '1' then
      v.filled := r.filled(c_at.leave - 1 downto 1) & take;
    end if;
    if reset = '1' then
      v.filled := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  light_state : entity work.light_state
    generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
    port map (
      clk     => clk,
      reset   => reset,
      take    => take,
      token   => in_token,
      ready   => ready,
      object  => open,
      changes => changes,
      defined => defined,
      light   => light,
      lit     => lit,
      fault   => fault
      );

  align_token : entity work.delay_line
    generic map (
      g_bits  => in_token'length,
      g_depth => c_at.term
      )
    port map (
      clk     => clk,
      enable  => enable,
      word    => in_token,
      delayed => term_token
      );

  object <= is_object(command_of(g_exact, term_token));

  kind : if g_kind = c_ambient generate

    signal normal : directions_t;
    signal view   : directions_t;

  begin

    ambient_term : entity work.ambient_term
      generic map (
        g_config => c_config
        )
      port map (
        clk     => clk,
        enable  => enable,
        light   => light,
        token   => in_token,
        delayed => term_token,
        terms   => terms,
        normal  => normal,
        view    => view
        );

    reached <= '1';

    renew : process (all)
      variable v : token_t;
    begin
      v := term_token;
      if object = '1' then
        v := with_direction(c_config, v, normal);
        if has_view(c_config) then
          v := with_view(c_config, v, view);
        end if;
      end if;
      ready_token <= v;
    end process;

  else generate

    signal lit_term : std_logic;
    signal above    : std_logic;

  begin

    light_term : entity work.light_term
      generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
      port map (
        clk    => clk,
        enable => enable,
        light  => light,
        token  => in_token,
        terms  => terms,
        above  => above
        );

    align_lit : entity work.delay_line
      generic map (
        g_bits  => 1,
        g_depth => c_at.term - 1
        )
      port map (
        clk        => clk,
        enable     => enable,
        word(0)    => lit,
        delayed(0) => lit_term
        );

    reached     <= lit_term and above;
    ready_token <= term_token;

  end generate;

  radiance_sum : entity work.radiance_sum
    generic map (
      g_exact    => g_exact,
      g_channels => g_channels
      )
    port map (
      clk      => clk,
      enable   => enable,
      add      => object and defined and reached,
      radiance => radiance_of(c_config, term_token),
      terms    => terms,
      result   => radiance
      );

  leave : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        leaving <= ready_token;
      end if;
    end if;
  end process;

end architecture;
