-- SPDX-License-Identifier: Apache-2.0
--
-- A shader and what its vectors depend on, as one value.

use work.axi_pkg.all;

package shader_pkg is

  type shader_t is (quadratic, spherical, processors);

  -- The generics of the shaders of these names. Each shader has some of them.
  type vector_generics_t is record
    shader                         : shader_t;
    exact                          : boolean;
    channels                       : positive;
    diffuse, specular              : boolean;
    degree                         : positive;
    lights                         : natural;
    highlight_channels             : positive;
    directional, positional, spots : natural;
    normalize, shadows             : boolean;
    objects                        : natural;
  end record;

  type vector_sizes_t is record
    bits    : positive;         -- of init_data
    lengths : packet_lengths_t; -- of packets
  end record;

  function vector_sizes (g : vector_generics_t) return vector_sizes_t;

  -- Bits of the limit of axi_control: sufficient for a triangle of 4096 by 4096 pixels. The processors take up to 54
  -- clocks per fragment.
  function default_limit_bits (shader : shader_t) return positive;

end package;

package body shader_pkg is

  function quadratic_sizes (g : vector_generics_t) return vector_sizes_t is
    constant c_bits : positive := work.quadratic_pkg.init_bits(g.exact, g.degree, g.channels);
  begin
    return (bits => c_bits, lengths => (c_triangle_packet => words_of(c_bits), others => 0));
  end function;

  function spherical_sizes (g : vector_generics_t) return vector_sizes_t is
    constant c_header : positive := work.formats_pkg.init_bits(g.exact, 0)
      + work.formats_pkg.ambient_bits(g.exact, g.channels);
    constant c_record : natural := work.spherical_pkg.record_bits(g.exact, g.channels, g.lights, g.diffuse, g.specular,
      g.highlight_channels);
  begin
    return (
      bits => work.spherical_pkg.init_bits(g.exact, g.channels, g.lights, g.diffuse, g.specular, g.highlight_channels),
      lengths => (c_triangle_packet => words_of(c_header), c_record_packet => words_of(c_record), others => 0)
      );
  end function;

  function processors_sizes (g : vector_generics_t) return vector_sizes_t is
    use work.processors_pkg.all;
    constant c_config : config_t := config(g.exact, g.channels, g.directional, g.positional, g.spots, g.diffuse,
      g.specular, g.normalize, g.shadows);
    variable sizes : vector_sizes_t;
  begin
    sizes := (
      bits => init_bits(c_config),
      lengths => (
      c_triangle_packet => words_of(init_material_low(c_config) + material_bits(c_config)),
      c_load_packet => words_of(load_bits(c_config)),
      others => 0
      )
      );
    if g.objects > 0 then
      sizes.lengths(c_walk_packet) := words_of(plane_low(c_config, 0));
    end if;
    return sizes;
  end function;

  function vector_sizes (g : vector_generics_t) return vector_sizes_t is
  begin
    case g.shader is
      when quadratic =>
        return quadratic_sizes(g);
      when spherical =>
        return spherical_sizes(g);
      when processors =>
        return processors_sizes(g);
    end case;
  end function;

  function default_limit_bits (shader : shader_t) return positive is
  begin
    if shader = processors then
      return 31;
    end if;
    return 26;
  end function;

end package body;
