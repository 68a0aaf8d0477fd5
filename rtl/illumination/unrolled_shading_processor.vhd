-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One term of the illumination model, unrolled: I_out = I_in + k I (N.A)**x with one unit per step. It takes
--             one token per clock. The results equal those of shading_processor bit for bit.
--
--               in_token --+-- light_state      commands, the light, shadow volumes
--                          |
--                          +-- ambient_term     k_a I_a, unit vectors N and V  | or
--                          +-- light_term       k I (N.A)**x of one light      | (drawings of the steps there)
--                          |                                          | stream_queue: the term
--                          |                                          v
--                          +-- stream_queue     the token ------ radiance_sum -- out_token
--
--             A token is taken in clock 0. After n clocks it is in stage n. Its term is valid in stage c_at.term. The
--             stages never stall: a token is taken only if the queues have a place for it. It waits at the head of its
--             queue until its term comes.
-- Contract    as shading_processor, except for latency and throughput. in_ready does not depend on out_ready in the same
--             clock. A token that defines, changes or deletes the light is taken only when the stages, the queues and
--             the output are empty.
-- Formats     processors_pkg, formats_pkg; fields of tokens: token_pkg; words between the steps: terms_pkg
-- Latency     times of terms_pkg: leave (published, exact): ambient 5, 6; with N normalized or the view vector 10, 18;
--             directional diffuse 7, 9, specular 13, 35; positional diffuse 15, 27, specular 21, 53; spot diffuse 23, 35,
--             specular 23, 54
-- Throughput  1 token per clock; a token that changes the light waits until all of these are empty
-- Source      processors paper, figures 1 and 2, unrolled; ours
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
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
    busy      : out std_logic -- holds a token
  );
end entity;

architecture rtl of unrolled_shading_processor is

  constant c_config : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_at     : times_t  := times(c_config, g_kind, g_light);

  -- At full throughput c_at.leave - 1 places are claimed. One more keeps `room` at '1', and one is never claimed.
  constant c_index_bits : positive := index_bits(c_at.leave + 1);

  constant c_terms : positive := g_channels * product_bits(g_exact);
  -- Only the ambient processor has unit vectors.
  constant c_vector : natural := boolean'pos(g_kind = c_ambient) * c_axes * formats(g_exact).direction.bits;

  subtype token_t is std_logic_vector(in_token'range);
  subtype radiance_t is std_logic_vector(g_channels * formats(g_exact).radiance.bits - 1 downto 0);
  subtype directions_t is std_logic_vector(c_vector - 1 downto 0);
  subtype terms_t is std_logic_vector(c_terms - 1 downto 0);

  -- What the steps compute for a token, the first lowest.
  subtype result_t is std_logic_vector(1 + c_terms + 2 * c_vector - 1 downto 0);

  type reg_t is record
    filled : std_logic_vector(c_at.term downto 1); -- bit i: stage i computes for a token
    full   : std_logic; -- a token is at the output
  end record;

  signal r, r_next : reg_t;

  signal free    : std_logic;
  signal take    : std_logic;
  signal room    : std_logic; -- in the queues
  signal pending : std_logic; -- a token is in the stages or in the queues
  signal changes : std_logic; -- the token offered changes the light
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0);
  signal defined : std_logic; -- the light
  signal lit     : std_logic; -- the token in stage 1

  -- Of the token in stage c_at.term.
  signal terms   : terms_t;
  signal reached : std_logic;    -- by the light
  signal normal  : directions_t; -- unit vectors, of the ambient processor
  signal view    : directions_t;

  -- Of the first token in the queues.
  signal complete : std_logic; -- its steps are done
  signal advance  : std_logic; -- it becomes the token at the output
  signal waiting  : token_t;
  signal result   : result_t;
  signal renewed  : token_t;   -- the token without its new colour
  signal object   : std_logic;

  signal leaving  : token_t;
  signal radiance : radiance_t;

begin

  free <= room and not (in_valid and changes and (pending or r.full));
  take <= in_valid and free;

  in_ready  <= free;
  out_valid <= r.full;
  out_token <= with_radiance(c_config, leaving, radiance);
  busy      <= pending or r.full;

  combinational : process (all)
    variable v : reg_t;
  begin
    v.filled := r.filled(c_at.term - 1 downto 1) & take;
    v.full   := complete or (r.full and not out_ready);
    if reset = '1' then
      v := (filled => (others => '0'), full => '0');
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
      object  => open,
      changes => changes,
      defined => defined,
      light   => light,
      lit     => lit
      );

  kind : if g_kind = c_ambient generate

    ambient_term : entity work.ambient_term
      generic map (
        g_config => c_config
        )
      port map (
        clk    => clk,
        light  => light,
        token  => in_token,
        terms  => terms,
        normal => normal,
        view   => view
        );

    reached <= '1';

  else generate

    signal lit_term : std_logic;
    signal above    : std_logic;

  begin

    light_term : entity work.light_term
      generic map (g_config => c_config, g_kind => g_kind, g_light => g_light)
      port map (
        clk    => clk,
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
        enable     => '1',
        word(0)    => lit,
        delayed(0) => lit_term
        );

    reached <= lit_term and above;
    normal  <= (others => '0');
    view    <= (others => '0');

  end generate;

  tokens : entity work.stream_queue
    generic map (
      g_bits       => token_t'length,
      g_index_bits => c_index_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => take,
      room      => room,
      pending   => pending,
      in_valid  => take,
      in_data   => in_token,
      out_valid => open,
      out_ready => advance,
      out_data  => waiting
      );

  results : entity work.stream_queue
    generic map (
      g_bits       => result_t'length,
      g_index_bits => c_index_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => take,
      room      => open,
      pending   => open,
      in_valid  => r.filled(c_at.term),
      in_data   => view & normal & terms & reached,
      out_valid => complete,
      out_ready => advance,
      out_data  => result
      );

  advance <= complete and (out_ready or not r.full);
  object <= is_object(command_of(g_exact, waiting));

  -- The ambient processor renews the vectors of an object, and starts its colour
  renew : process (all)
    variable v : token_t;
  begin
    v := waiting;
    if g_kind = c_ambient and object = '1' then
      v := with_direction(c_config, v, plain_directions(g_exact, normal_of(c_config, waiting)));
      if g_normalize and waiting(pixel_header(g_exact).normalize.low) = '1' then
        v := with_direction(c_config, v, result(c_terms + c_vector downto c_terms + 1));
      end if;
      if has_view(c_config) then
        v := with_view(c_config, v, result(result'high downto c_terms + c_vector + 1));
      end if;
      v := with_radiance(c_config, v, first_radiance(c_config));
    end if;
    renewed <= v;
  end process;

  radiance_sum : entity work.radiance_sum
    generic map (
      g_exact    => g_exact,
      g_channels => g_channels
      )
    port map (
      clk      => clk,
      enable   => advance,
      add      => object and defined and result(0),
      radiance => radiance_of(c_config, renewed),
      terms    => result(c_terms downto 1),
      result   => radiance
      );

  leave_register : process (clk)
  begin
    if rising_edge(clk) then
      if advance = '1' then
        leaving <= renewed;
      end if;
    end if;
  end process;

end architecture;
