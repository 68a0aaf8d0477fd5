-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The chain of the shading processors of all lights: the ambient one, then the diffuse and the specular one
--             of light 1, of light 2 and so on, in either form. After the last processor only objects are output.
-- Contract    A token is transferred if valid and ready are both '1' at a rising edge; out_token does not change while
--             it waits. Tokens stay in order. Loads and shadow polygons are dropped after the last processor. busy: a
--             processor holds a token. fault stays '1', as in shading_processor.
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
  constant c_header     : pixel_header_t := pixel_header(g_exact);
  constant c_processors : positive       := processors(c_config);
  -- Processors per light; 1 if there is none.
  constant c_terms : positive := boolean'pos(g_diffuse and g_specular) + 1;

  type tokens_t is array (0 to c_processors) of std_logic_vector(in_token'range);

  -- Before each processor, and after the last.
  signal valid  : std_logic_vector(0 to c_processors);
  signal ready  : std_logic_vector(0 to c_processors);
  signal tokens : tokens_t;
  signal works  : std_logic_vector(0 to c_processors - 1);
  signal faults : std_logic_vector(0 to c_processors - 1);
  signal object : std_logic; -- the last processor outputs an object

  subtype command_t is std_logic_vector(c_header.command.high downto c_header.command.low);

  function is_object (command : command_t) return std_logic is
  begin
    if unsigned(command) = c_new_pixel or unsigned(command) = c_new_object or unsigned(command) = c_new_scanline then
      return '1';
    end if;
    return '0';
  end function;

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
          busy      => works(index),
          fault     => faults(index)
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
          busy      => works(index),
          fault     => faults(index)
          );

    end generate;

  end generate;

  object <= is_object(tokens(c_processors)(command_t'range));

  ready(c_processors) <= out_ready or not object;
  out_valid           <= valid(c_processors) and object;
  out_token           <= tokens(c_processors);

  busy  <= or works;
  fault <= or faults;

end architecture;
