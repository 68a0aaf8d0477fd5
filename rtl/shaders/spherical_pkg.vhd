-- SPDX-License-Identifier: Apache-2.0
--
-- Positions of a light's parts in a line record of the spherical shader, and its terms of the sum of colours. A line
-- record holds for every light its diffuse part, then its specular part.
-- Golden twin model/words/spherical_layout.hpp

use work.formats_pkg.all;

package spherical_pkg is

  -- The light's diffuse angle is needed for its cosine, or as the horizon of its highlight.
  function has_diffuse_part (exact, diffuse, specular : boolean) return boolean;

  -- Number of colours for which a light's diffuse part has a factor.
  function diffuse_channels (channels : positive; diffuse : boolean) return natural;

  -- Bits of one light's part; 0 if it does not exist.
  function diffuse_part_bits (exact : boolean; channels : positive; diffuse, specular : boolean) return natural;

  function specular_part_bits (exact, specular : boolean; highlight_channels : positive) return natural;

  -- Bits of one light: its diffuse part, then its specular part.
  function light_part_bits (exact : boolean; channels : positive; diffuse, specular : boolean;
    highlight_channels : positive) return natural;

  -- Terms of one light in the sum of a channel.
  function light_terms (diffuse, specular : boolean) return natural;

  -- Bits of a term: a factor times a sample of data_bits.
  function term_bits (exact : boolean; data_bits : positive) return positive;

  -- 0: no line records follow a triangle's header.
  function record_bits (exact : boolean; channels : positive; lights : natural; diffuse, specular : boolean;
    highlight_channels : positive) return natural;

  -- Bits of a vector: a triangle's header, or a line record.
  function init_bits (exact : boolean; channels : positive; lights : natural; diffuse, specular : boolean;
    highlight_channels : positive) return positive;

end package;

package body spherical_pkg is

  function has_diffuse_part (exact, diffuse, specular : boolean) return boolean is
  begin
    return diffuse or (specular and exact);
  end function;

  function diffuse_channels (channels : positive; diffuse : boolean) return natural is
  begin
    if diffuse then
      return channels;
    end if;
    return 0;
  end function;

  function diffuse_part_bits (exact : boolean; channels : positive; diffuse, specular : boolean) return natural is
  begin
    if has_diffuse_part(exact, diffuse, specular) then
      return diffuse_bits(exact, diffuse_channels(channels, diffuse));
    end if;
    return 0;
  end function;

  function specular_part_bits (exact, specular : boolean; highlight_channels : positive) return natural is
  begin
    if specular then
      return specular_bits(exact, highlight_channels);
    end if;
    return 0;
  end function;

  function light_part_bits (exact : boolean; channels : positive; diffuse, specular : boolean;
    highlight_channels : positive) return natural is
  begin
    return diffuse_part_bits(exact, channels, diffuse, specular)
      + specular_part_bits(exact, specular, highlight_channels);
  end function;

  function light_terms (diffuse, specular : boolean) return natural is
  begin
    return boolean'pos(diffuse) + boolean'pos(specular);
  end function;

  function term_bits (exact : boolean; data_bits : positive) return positive is
  begin
    return formats(exact).factor.bits + data_bits;
  end function;

  function record_bits (exact : boolean; channels : positive; lights : natural; diffuse, specular : boolean;
    highlight_channels : positive) return natural is
  begin
    return lights * light_part_bits(exact, channels, diffuse, specular, highlight_channels);
  end function;

  function init_bits (exact : boolean; channels : positive; lights : natural; diffuse, specular : boolean;
    highlight_channels : positive) return positive is
    constant c_header : positive := init_bits(exact, 0) + ambient_bits(exact, channels);
    constant c_record : natural  := record_bits(exact, channels, lights, diffuse, specular, highlight_channels);
  begin
    if c_record > c_header then
      return c_record;
    end if;
    return c_header;
  end function;

end package body;
