-- SPDX-License-Identifier: Apache-2.0
--
-- What the two forms of a shading processor make of their units' results on the way from one to the next.
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;

package terms_pkg is

  -- What a processor has of units; follows from what it is for.
  type shape_t is record
    positional : boolean; -- its light can be one
    spots      : boolean; -- or a spot
    far        : boolean; -- places are multiplied with the point's distance
    first      : boolean; -- N, or L, can be normalized
    second     : boolean; -- so can the view vector, or H
  end record;

  function shape (c : config_t; kind, light : natural) return shape_t;

  -- Bits of a component of what is normalized.
  function normalized_bits (c : config_t; kind, light : natural) return positive;

  -- The part of a token that loads which its light keeps.
  function light_bits (c : config_t) return positive;

  -- Lowest bit of a token's k of a kind of processor.
  function coefficient_low (c : config_t; kind, channel : natural) return natural;

  function larger (a, b : natural) return natural;

  -- A signed word in more bits.
  function extended (word : std_logic_vector; bits : positive) return std_logic_vector;

  function unit_vector_latency (exact : boolean) return positive;

  -- Of the unrolled form: how many clocks behind the token's coming something is there.
  type times_t is record
    summed   : natural; -- the way to the light, added up
    to_light : natural; -- L
    halved   : natural; -- what H is made of
    half     : natural; -- H
    cosine   : natural; -- all that the dot product with N takes
    angle    : natural; -- (N.A)
    raised   : natural; -- (N.A)**x
    factor   : natural; -- of a spot's cone
    weight   : natural; -- what k I is multiplied with
    term     : natural; -- what is added
    leave    : natural; -- the token
  end record;

  function times (c : config_t; kind, light : natural) return times_t;

  -- A component of N that is not to be normalized, as a direction.
  function plain_direction (exact : boolean; word : signed) return std_logic_vector;

  -- A component of a unit vector: what vector_shift gave times what reciprocal_root gave.
  function unit_direction (exact : boolean; word : signed) return std_logic_vector;

  -- A component of a light's place that says its direction.
  function light_direction (exact : boolean; place : std_logic_vector) return std_logic_vector;

  -- A component from a surface's point to a light; exact: of place the product with the point's distance.
  function offset (exact : boolean; place, point : signed; shift : std_logic_vector) return std_logic_vector;

  -- Of a diffuse term.
  function cosine_weight (exact : boolean; cosine : unsigned) return std_logic_vector;

  -- A weight times a spot's factor.
  function coned_weight (exact : boolean; product : unsigned) return std_logic_vector;

  -- k times I.
  function reflected (exact : boolean; product : unsigned) return std_logic_vector;

  -- I so far and a term: what is reflected times its weight.
  function brightened (exact : boolean; radiance : std_logic_vector; product : unsigned) return std_logic_vector;

end package;

package body terms_pkg is

  function shape (c : config_t; kind, light : natural) return shape_t is
    variable s : shape_t;
  begin
    s.positional := kind /= c_ambient and light > c.directional;
    s.spots      := kind /= c_ambient and light > c.directional + c.positional;
    s.far        := s.positional and c.exact;
    if kind = c_ambient then
      s.first  := c.normalize;
      s.second := has_view(c);
    elsif kind = c_diffuse then
      s.first  := s.positional;
      s.second := false;
    elsif c.exact then
      s.first  := s.positional;
      s.second := true;
    else
      s.first  := s.spots;
      s.second := s.positional;
    end if;
    return s;
  end function;

  function normalized_bits (c : config_t; kind, light : natural) return positive is
  begin
    if kind = c_ambient then
      return formats(c.exact).vector.bits;
    elsif c.exact and not shape(c, kind, light).positional then
      return formats(c.exact).direction.bits + 1;
    end if;
    return formats(c.exact).offset.bits;
  end function;

  function light_bits (c : config_t) return positive is
  begin
    return light_axes_bits(c.exact, c_axes) + light_colour_bits(c.exact, c.channels);
  end function;

  function coefficient_low (c : config_t; kind, channel : natural) return natural is
  begin
    if kind = c_ambient then
      return material_low(c) + ambient_low(c, channel);
    elsif kind = c_diffuse then
      return material_low(c) + diffuse_low(c, channel);
    end if;
    return material_low(c) + specular_low(c, channel);
  end function;

  function extended (word : std_logic_vector; bits : positive) return std_logic_vector is
  begin
    return std_logic_vector(resize(signed(word), bits));
  end function;

  function larger (a, b : natural) return natural is
  begin
    if a > b then
      return a;
    end if;
    return b;
  end function;

  function unit_vector_latency (exact : boolean) return positive is
  begin
    return c_vector_shift_latency + c_dot_product_latency + reciprocal_root_latency(exact) + c_vector_multiply_latency
      + 1;
  end function;

  function times (c : config_t; kind, light : natural) return times_t is
    constant c_shape : shape_t := shape(c, kind, light);
    constant c_unit  : positive := unit_vector_latency(c.exact);

    variable t : times_t := (others => 0);
  begin
    if kind = c_ambient then
      t.weight := c_vector_multiply_latency;
      if c_shape.first or c_shape.second then
        t.weight := larger(c_unit, t.weight);
      end if;
      t.term  := t.weight;
      t.leave := t.term + 1;
      return t;
    end if;
    if c_shape.first then
      t.summed := 1;
      if c_shape.far then
        t.summed := c_vector_multiply_latency + 1;
      end if;
      t.to_light := t.summed + c_unit;
    end if;
    if c_shape.second then
      t.halved := 1;
      if c.exact then
        t.halved := t.to_light + 1;
      end if;
      t.half := t.halved + c_unit;
    end if;
    t.cosine := larger(t.to_light, t.half);
    t.angle  := t.cosine + c_dot_product_latency;
    t.raised := t.angle + 1;
    if kind = c_specular then
      t.raised := t.angle + power_latency(c.exact);
    end if;
    t.weight := t.raised;
    if c_shape.spots then
      t.factor := t.to_light + c_dot_product_latency + c_spot_cone_latency;
      t.weight := larger(t.raised, t.factor) + 1;
    end if;
    t.term  := t.weight + c_vector_multiply_latency;
    t.leave := t.term + 1;
    return t;
  end function;

  function low_bits (value : signed; bits : positive) return std_logic_vector is
    alias word : signed(value'length - 1 downto 0) is value;
  begin
    return std_logic_vector(word(bits - 1 downto 0));
  end function;

  function plain_direction (exact : boolean; word : signed) return std_logic_vector is
    constant c_drop : natural := formats(exact).vector.fraction - formats(exact).direction.fraction;
  begin
    return low_bits(round_half_up(word, c_drop), formats(exact).direction.bits);
  end function;

  function unit_direction (exact : boolean; word : signed) return std_logic_vector is
    constant c_drop : natural := formats(exact).direction.bits - 1 + formats(exact).root.fraction
      - formats(exact).direction.fraction;
  begin
    return low_bits(round_half_up(word, c_drop), formats(exact).direction.bits);
  end function;

  function light_direction (exact : boolean; place : std_logic_vector) return std_logic_vector is
    constant c_drop : natural := formats(exact).light_place.fraction - formats(exact).direction.fraction;
    alias word      : std_logic_vector(place'length - 1 downto 0) is place;
  begin
    return word(c_drop + formats(exact).direction.bits - 1 downto c_drop);
  end function;

  -- numeric_std's shift becomes a logical one in the netlist.
  function arithmetic_shift (value : signed; shift : std_logic_vector) return signed is
    alias by : std_logic_vector(shift'length - 1 downto 0) is shift;

    variable word : signed(value'length - 1 downto 0);
  begin
    word := value;
    for stage in by'range loop
      if by(stage) = '1' then
        word := resize(word(word'high downto 2 ** stage), word'length);
      end if;
    end loop;
    return word;
  end function;

  function offset (exact : boolean; place, point : signed; shift : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(exact).offset.bits;
    constant c_drop : natural  := formats(true).light_place.fraction + formats(true).vector.fraction
      - formats(true).offset.fraction;

    variable from_eye : signed(c_bits - 1 downto 0);
    variable near     : signed(c_bits - 1 downto 0);
  begin
    near := resize(point, c_bits);
    if exact then
      from_eye := signed(low_bits(round_half_up(place, c_drop), c_bits));
      near     := arithmetic_shift(near, shift);
    else
      from_eye := resize(place, c_bits);
    end if;
    return std_logic_vector(from_eye - near);
  end function;

  function cosine_weight (exact : boolean; cosine : unsigned) return std_logic_vector is
    constant c_drop : natural := formats(exact).direction.fraction - formats(exact).weight.fraction;

    variable rounded : unsigned(cosine'length - c_drop downto 0);
  begin
    rounded := round_half_up(cosine, c_drop);
    return std_logic_vector(rounded(formats(exact).weight.bits - 1 downto 0));
  end function;

  function coned_weight (exact : boolean; product : unsigned) return std_logic_vector is
    constant c_drop : natural := formats(exact).weight.fraction;
    alias word      : unsigned(product'length - 1 downto 0) is product;
  begin
    return std_logic_vector(word(c_drop + formats(exact).weight.bits - 1 downto c_drop));
  end function;

  function reflected (exact : boolean; product : unsigned) return std_logic_vector is
    constant c_drop : natural := formats(exact).coefficient.fraction + formats(exact).light_intensity.fraction
      - formats(exact).reflected.fraction;
  begin
    return std_logic_vector(held(round_half_up(product, c_drop), formats(exact).reflected.bits));
  end function;

  function brightened (exact : boolean; radiance : std_logic_vector; product : unsigned) return std_logic_vector is
    constant c_drop : natural := formats(exact).reflected.fraction + formats(exact).weight.fraction
      - formats(exact).radiance.fraction;
    alias word      : unsigned(product'length - 1 downto 0) is product;

    variable sum : unsigned(product'length - c_drop downto 0);
  begin
    sum := resize(word(word'high downto c_drop), sum'length) + unsigned(radiance);
    return std_logic_vector(held(sum, radiance'length));
  end function;

end package body;
