-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The chain of the shading processors of all lights: the ambient one, then the diffuse and the specular one
--             of light 1, of light 2 and so on, in either form. After the last processor only objects are output.
-- Contract    A token is transferred if valid and ready are both '1' at a rising edge; out_token does not change while
--             it waits. Tokens stay in order. All but objects are dropped after the last processor. busy: a processor
--             holds a token. fault stays '1' after a token for a light that does not exist.
--             In either form in_ready does not depend on out_ready in the same clock.
-- Formats     processors_pkg
-- Latency     the sum of the processors' latencies
-- Throughput  that of the slowest processor; in the unrolled form 1 token per clock
-- Source      processors paper, section 3.2: 2 (P + R) + 1 processors
-- Golden twin model/golden/shading_pipeline.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

entity shading_pipeline is
  generic (
    g_exact       : boolean              := true;
    g_channels    : natural range 1 to 3 := 3;
    g_directional : natural              := 0; -- lights of each kind
    g_positional  : natural              := 0;
    g_spots       : natural              := 0;
    g_diffuse     : boolean              := true;
    g_specular    : boolean              := true;
    g_normalize   : boolean              := true;
    g_shadows     : boolean              := false;
    g_unrolled    : boolean              := true
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
    busy      : out std_logic;
    fault     : out std_logic
  );
end entity;

architecture rtl of shading_pipeline is

  constant c_config     : config_t       := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_processors : positive       := processors(c_config);
  -- Processors per light; 1 if there is none.
  constant c_terms : positive := boolean'pos(g_diffuse and g_specular) + 1;

  type tokens_t is array (0 to c_processors) of std_logic_vector(in_token'range);

  -- Before each processor, and after the last.
  signal valid  : std_logic_vector(0 to c_processors);
  signal ready  : std_logic_vector(0 to c_processors);
  signal tokens : tokens_t;
  signal works  : std_logic_vector(0 to c_processors - 1);
  signal object : std_logic; -- the last processor outputs an object

  type reg_t is record
    fault : std_logic;
  end record;

  signal r, r_next : reg_t;

  function light_of (processor : natural) return natural is
  begin
    if processor = 0 then
      return 0;
    end if;
    return (processor - 1) / c_terms + 1; -- evaluated at elaboration
  end function;

  function kind_of (processor : natural) return natural is
  begin
    if processor = 0 then
      return c_ambient;
    elsif not g_specular or (g_diffuse and (processor - 1) mod c_terms = 0) then -- evaluated at elaboration
      return c_diffuse;
    end if;
    return c_specular;
  end function;

begin

  valid(0)  <= in_valid;
  tokens(0) <= in_token;
  in_ready  <= ready(0);

  chain : for index in 0 to c_processors - 1 generate

    form : if g_unrolled generate

      unrolled : entity work.unrolled_shading_processor
        generic map (
          g_exact       => g_exact,
          g_channels    => g_channels,
          g_directional => g_directional,
          g_positional  => g_positional,
          g_spots       => g_spots,
          g_diffuse     => g_diffuse,
          g_specular    => g_specular,
          g_normalize   => g_normalize,
          g_shadows     => g_shadows,
          g_kind        => kind_of(index),
          g_light       => light_of(index)
          )
        port map (
          clk       => clk,
          reset     => reset,
          in_valid  => valid(index),
          in_ready  => ready(index),
          in_token  => tokens(index),
          out_valid => valid(index + 1),
          out_ready => ready(index + 1),
          out_token => tokens(index + 1),
          busy      => works(index)
          );

    else generate

      folded : entity work.shading_processor
        generic map (
          g_exact       => g_exact,
          g_channels    => g_channels,
          g_directional => g_directional,
          g_positional  => g_positional,
          g_spots       => g_spots,
          g_diffuse     => g_diffuse,
          g_specular    => g_specular,
          g_normalize   => g_normalize,
          g_shadows     => g_shadows,
          g_kind        => kind_of(index),
          g_light       => light_of(index)
          )
        port map (
          clk       => clk,
          reset     => reset,
          in_valid  => valid(index),
          in_ready  => ready(index),
          in_token  => tokens(index),
          out_valid => valid(index + 1),
          out_ready => ready(index + 1),
          out_token => tokens(index + 1),
          busy      => works(index)
          );

    end generate;

  end generate;

  object <= is_object(command_of(g_exact, tokens(c_processors)));

  ready(c_processors) <= out_ready or not object;
  out_valid           <= valid(c_processors) and object;
  out_token           <= tokens(c_processors);

  busy  <= or works;
  fault <= r.fault;

  combinational : process (all)
    constant c_light : slice_t := pixel_header(g_exact).light;

    variable v       : reg_t;
    variable command : command_t;
  begin
    v       := r;
    command := command_of(g_exact, in_token);
    if in_valid = '1' and unsigned(field_of(in_token, c_light)) > lights(c_config)
      and (command = c_define or command = c_redefine or command = c_delete or command = c_shadow) then
      v.fault := '1';
    end if;
    if reset = '1' then
      v.fault := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

end architecture;
