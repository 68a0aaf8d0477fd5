-- SPDX-License-Identifier: Apache-2.0
--
-- Functions that connect the units of both forms of a shading processor, and the clocks of the unrolled form.
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.vector_pkg.all;

package terms_pkg is

  -- The units of a processor, derived from its kind and its light.
  type shape_t is record
    positional : boolean; -- the light can be positional
    spots      : boolean; -- the light can be a spot
    far        : boolean; -- the light's position is multiplied by the point's distance
    first      : boolean; -- normalizes N, or L
    second     : boolean; -- normalizes the view vector, or H
  end record;

  function shape (c : config_t; kind, light : natural) return shape_t;

  function larger (a, b : natural) return natural;

  -- Bits of the vector that half_vector adds to the direction to the eye, and of the sum.
  function half_light_bits (exact : boolean) return positive;

  function half_sum_bits (exact : boolean) return positive;

  -- Bits of k I times a weight.
  function product_bits (exact : boolean) return positive;

  -- Clocks of the steps of a term.
  function unit_vector_latency (exact : boolean) return positive;

  function light_vector_latency (exact, positional : boolean) return natural;

  function half_vector_latency (exact, normalize : boolean) return natural;

  function cosine_power_latency (exact, highlight : boolean) return positive;

  function light_weight_latency (exact, spot : boolean; lead : natural) return natural;

  -- From k to k I, rounded; from a weight to its term.
  function reflection_latency (exact : boolean) return positive;

  -- Unrolled form: clocks from the clock in which the token is taken to the clock in which a result is valid.
  type times_t is record
    to_light : natural; -- L
    cosine   : natural; -- A, and all other inputs of cosine_power
    raised   : natural; -- (N.A)**x
    weight   : natural; -- the factor of k I
    term     : natural; -- k I (N.A)**x
    leave    : natural; -- the token with the sum
  end record;

  function times (c : config_t; kind, light : natural) return times_t;

  -- A component of N that is not to be normalized, as a direction.
  function plain_direction (exact : boolean; word : signed) return std_logic_vector;

  -- A component of a unit vector: the result of vector_shift times the result of reciprocal_root.
  function unit_direction (exact : boolean; word : signed) return std_logic_vector;

  -- A component of a directional light's direction, which is in its field `place`.
  function light_direction (exact : boolean; place : std_logic_vector) return std_logic_vector;

  -- A component of the vector from a surface point to a light; exact: `place` is already times the point's distance.
  function offset (exact : boolean; place, point : signed; shift : std_logic_vector) return std_logic_vector;

  -- The weight of a diffuse term: its cosine, rounded.
  function cosine_weight (exact : boolean; cosine : unsigned) return std_logic_vector;

  -- A weight times a spot's factor.
  function coned_weight (exact : boolean; product : unsigned) return std_logic_vector;

  -- k times I: rounded, and limited to the largest value.
  function reflected (exact : boolean; product : unsigned) return std_logic_vector;

  -- The sum of the colour so far and a term.
  function brightened (exact : boolean; radiance : std_logic_vector; product : unsigned) return std_logic_vector;

  -- The same of all components of a vector, x lowest, or of all channels.
  function plain_directions (exact : boolean; vector : std_logic_vector) return std_logic_vector;

  function light_directions (exact : boolean; places : std_logic_vector) return std_logic_vector;

  function offsets (exact : boolean; places, points, shift : std_logic_vector) return std_logic_vector;

  function brightened (exact : boolean; radiances, terms : std_logic_vector; channels : positive)
    return std_logic_vector;

  -- The reflected light times a weight of 1.
  function unweighted (exact : boolean; word : std_logic_vector) return std_logic_vector;

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

  function larger (a, b : natural) return natural is
  begin
    if a > b then
      return a;
    end if;
    return b;
  end function;

  function half_light_bits (exact : boolean) return positive is
  begin
    if exact then
      return formats(exact).direction.bits;
    end if;
    return formats(exact).offset.bits;
  end function;

  function half_sum_bits (exact : boolean) return positive is
  begin
    if exact then
      return formats(exact).direction.bits + 1;
    end if;
    return formats(exact).offset.bits;
  end function;

  function product_bits (exact : boolean) return positive is
  begin
    return formats(exact).reflected.bits + formats(exact).weight.bits;
  end function;

  function unit_vector_latency (exact : boolean) return positive is
  begin
    return vector_shift_latency(true) + dot_product_latency(exact, true) + reciprocal_root_latency(exact)
      + vector_multiply_latency(exact) + 1;
  end function;

  function light_vector_latency (exact, positional : boolean) return natural is
  begin
    if not positional then
      return 0;
    elsif exact then
      return vector_multiply_latency(exact) + 1 + unit_vector_latency(exact);
    end if;
    return 1 + unit_vector_latency(exact);
  end function;

  function half_vector_latency (exact, normalize : boolean) return natural is
  begin
    if not normalize then
      return 0;
    end if;
    return 1 + unit_vector_latency(exact);
  end function;

  function cosine_power_latency (exact, highlight : boolean) return positive is
  begin
    if highlight then
      return dot_product_latency(exact, true) + power_latency(exact, true);
    end if;
    return dot_product_latency(exact, true) + 1;
  end function;

  function reflection_latency (exact : boolean) return positive is
  begin
    return vector_multiply_latency(exact) + 1;
  end function;

  function light_weight_latency (exact, spot : boolean; lead : natural) return natural is
  begin
    if not spot then
      return 0;
    end if;
    return larger(dot_product_latency(exact, true) + c_spot_cone_latency, lead) - lead + 1;
  end function;

  function times (c : config_t; kind, light : natural) return times_t is
    constant c_shape : shape_t := shape(c, kind, light);

    variable t : times_t := (others => 0);
  begin
    if kind = c_ambient then
      t.weight := reflection_latency(c.exact);
      if c_shape.first or c_shape.second then
        t.weight := larger(unit_vector_latency(c.exact), t.weight);
      end if;
      t.term := t.weight;
    else
      t.to_light := light_vector_latency(c.exact, c_shape.first);
      t.cosine   := t.to_light;
      if kind = c_specular and c.exact then
        t.cosine := t.to_light + half_vector_latency(c.exact, c_shape.second);
      elsif kind = c_specular then
        -- In the printed formula H does not depend on L.
        t.cosine := half_vector_latency(c.exact, c_shape.second);
      end if;
      t.raised := t.cosine + cosine_power_latency(c.exact, kind = c_specular);
      t.weight := t.raised + light_weight_latency(c.exact, c_shape.spots, t.raised - t.to_light);
      t.term   := t.weight + vector_multiply_latency(c.exact);
    end if;
    t.leave := t.term + 3; -- two clocks in the queues, one in the sum
    return t;
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
    return std_logic_vector(clamped(round_half_up(product, c_drop), formats(exact).reflected.bits));
  end function;

  function brightened (exact : boolean; radiance : std_logic_vector; product : unsigned) return std_logic_vector is
    constant c_drop : natural := formats(exact).reflected.fraction + formats(exact).weight.fraction
      - formats(exact).radiance.fraction;
    alias word      : unsigned(product'length - 1 downto 0) is product;

    variable sum : unsigned(product'length - c_drop downto 0);
  begin
    sum := resize(word(word'high downto c_drop), sum'length) + unsigned(radiance);
    return std_logic_vector(clamped(sum, radiance'length));
  end function;

  function plain_directions (exact : boolean; vector : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(exact).direction.bits;

    variable result : std_logic_vector(c_axes * c_bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * c_bits - 1 downto axis * c_bits) := plain_direction(exact, axis_of(vector, axis));
    end loop;
    return result;
  end function;

  function light_directions (exact : boolean; places : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(exact).direction.bits;

    variable result : std_logic_vector(c_axes * c_bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * c_bits - 1 downto axis * c_bits) :=
        light_direction(exact, std_logic_vector(axis_of(places, axis)));
    end loop;
    return result;
  end function;

  function offsets (exact : boolean; places, points, shift : std_logic_vector) return std_logic_vector is
    constant c_bits : positive := formats(exact).offset.bits;

    variable result : std_logic_vector(c_axes * c_bits - 1 downto 0);
  begin
    for axis in 0 to c_axes - 1 loop
      result((axis + 1) * c_bits - 1 downto axis * c_bits) :=
        offset(exact, axis_of(places, axis), axis_of(points, axis), shift);
    end loop;
    return result;
  end function;

  function brightened (exact : boolean; radiances, terms : std_logic_vector; channels : positive)
    return std_logic_vector is
    constant c_bits    : positive := formats(exact).radiance.bits;
    constant c_product : positive := product_bits(exact);
    alias radiance     : std_logic_vector(channels * c_bits - 1 downto 0) is radiances;
    alias term         : std_logic_vector(channels * c_product - 1 downto 0) is terms;

    variable result : std_logic_vector(channels * c_bits - 1 downto 0);
  begin
    for channel in 0 to channels - 1 loop
      result((channel + 1) * c_bits - 1 downto channel * c_bits) :=
        brightened(exact, radiance((channel + 1) * c_bits - 1 downto channel * c_bits),
        unsigned(term((channel + 1) * c_product - 1 downto channel * c_product)));
    end loop;
    return result;
  end function;

  function unweighted (exact : boolean; word : std_logic_vector) return std_logic_vector is
    constant c_zeros : std_logic_vector(formats(exact).weight.bits - 2 downto 0) := (others => '0');
  begin
    return '0' & word & c_zeros;
  end function;

end package body;
