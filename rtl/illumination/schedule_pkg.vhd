-- SPDX-License-Identifier: Apache-2.0
--
-- The folded shading processor's microprogram: the clock in which each shared unit does each step. The columns are a
-- positional light's: the diffuse processor of preset published, the specular one of preset exact. The first normalized
-- vector is L, the second one is H. In the ambient processor the first one is N, the second one the view vector.
--
--                   published       exact
--   P_p / w                  -       1               shared_multiplier
--   P_p - P                  1       3               shared_adder
--   shift                    2       4               shared_normalizer
--   square                   3       5               shared_multiplier: dot product with itself
--   1/sqrt                   4       8               shared_normalizer
--   scale                    5      15               shared_multiplier
--   round                    6      17               shared_normalizer: L
--   L + V, ... H          (all again, from the sum on)
--   N.A                                              shared_multiplier
--   power                                            shared_weight
--   k I * weight                                     shared_multiplier
--   sum                                              token_register
--
-- In all other clocks the multipliers compute k I; clock `reflect` is the one whose k I is used.

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

package schedule_pkg is

  -- Clock 1 is the clock after the one in which the token is taken. Steps _1 belong to the first vector (N or L), steps
  -- _2 to the second one (view vector or H). A step that this processor does not have is 0.
  type schedule_t is record
    sum_1    : natural; -- the adder gives a vector to the block shift
    shift_1  : natural;
    square_1 : natural; -- the dot product takes the shifted vector twice
    root_1   : natural;
    scale_1  : natural; -- the vector product takes vector and 1/sqrt
    round_1  : natural; -- to a direction
    sum_2    : natural;
    shift_2  : natural;
    square_2 : natural;
    root_2   : natural;
    scale_2  : natural;
    round_2  : natural;
    horizon  : natural; -- N.L of a highlight is valid
    cosine   : natural; -- the dot product takes N and A
    angle    : natural; -- N.A is valid
    weigh_in : natural; -- (N.A)**x is valid; for a spot, after the cone's factor
    axis     : natural; -- the dot product takes L and the cone's axis
    cone     : natural;
    factor   : natural;
    narrow   : natural; -- the vector product takes weight and factor
    narrowed : natural;
    reflect  : natural; -- the vector product takes k and I
    weigh    : natural; -- the vector product takes k I and weight
    add      : natural;
    leave    : natural; -- the token is offered at the output
  end record;

  function schedule (c : config_t; kind, light : natural) return schedule_t;

  -- The processor computes dot products.
  function has_dot_product (c : config_t; kind, light : natural) return boolean;

  -- Bits of the shared multiplier's operands, which are signed, and of its products.
  function factor_a_bits (c : config_t; kind, light : natural) return positive;

  function factor_b_bits (c : config_t; kind, light : natural) return positive;

  function shared_product_bits (c : config_t; kind, light : natural) return positive;

  -- Bits of a component of the vector that is normalized.
  function normalized_bits (c : config_t; kind, light : natural) return positive;

end package;

package body schedule_pkg is

  function schedule (c : config_t; kind, light : natural) return schedule_t is
    constant c_shape        : shape_t  := shape(c, kind, light);
    constant c_shift_clocks : positive := vector_shift_latency(false);
    constant c_dot_clocks   : positive := dot_product_latency(c.exact, false);
    constant c_mul_clocks   : positive := vector_multiply_latency(c.exact);
    constant c_root_clocks  : positive := reciprocal_root_latency(c.exact);
    constant c_power_clocks : positive := power_latency(c.exact, false);
    constant c_cone_clocks  : positive := c_spot_cone_latency;

    variable s : schedule_t := (others => 0);
    variable t : natural    := 1; -- the clock in which the inputs of the next step are valid
  begin
    if c_shape.first then
      if kind /= c_ambient then
        if c_shape.far then
          t := t + c_mul_clocks;
        end if;
        s.sum_1   := t;
        s.shift_1 := t + 1;
      end if;
      -- N is shifted while it is taken.
      s.square_1 := s.shift_1 + c_shift_clocks;
      s.root_1   := s.square_1 + c_dot_clocks;
      s.scale_1  := s.root_1 + c_root_clocks;
      s.round_1  := s.scale_1 + c_mul_clocks;
      t          := s.round_1 + 1;
    end if;
    if c_shape.second then
      if kind = c_ambient then
        s.shift_2 := 1;
        if c_shape.first then
          -- Until then the first vector is needed.
          s.shift_2 := s.scale_1;
        end if;
      else
        s.sum_2   := t;
        s.shift_2 := t + 1;
        s.horizon := t + c_dot_clocks;
      end if;
      s.square_2 := s.shift_2 + c_shift_clocks;
      s.root_2   := s.square_2 + c_dot_clocks;
      s.scale_2  := s.root_2 + c_root_clocks;
      s.round_2  := s.scale_2 + c_mul_clocks;
      t          := s.round_2 + 1;
    end if;
    if kind = c_ambient then
      s.reflect := larger(s.square_1, s.square_2) + 1;
      s.add     := s.reflect + c_mul_clocks;
      s.leave   := larger(t, s.add + 1);
      return s;
    end if;
    s.cosine := t;
    s.angle  := t + c_dot_clocks;
    if kind = c_diffuse then
      s.weigh_in := s.angle + 1;
    else
      s.weigh_in := s.angle + c_power_clocks;
    end if;
    s.weigh := s.weigh_in;
    if c_shape.spots then
      s.axis     := s.cosine + 1;
      s.cone     := s.axis + c_dot_clocks;
      s.factor   := s.cone + c_cone_clocks;
      s.narrow   := larger(s.factor, s.weigh_in);
      s.narrowed := s.narrow + c_mul_clocks;
      s.weigh    := s.narrowed + 1;
    end if;
    s.reflect := s.weigh - c_mul_clocks;
    s.add     := s.weigh + c_mul_clocks;
    s.leave   := s.add + 1;
    return s;
  end function;

  function has_dot_product (c : config_t; kind, light : natural) return boolean is
    constant c_shape : shape_t := shape(c, kind, light);
  begin
    return kind /= c_ambient or c_shape.first or c_shape.second;
  end function;

  function factor_a_bits (c : config_t; kind, light : natural) return positive is
    constant c_shape   : shape_t   := shape(c, kind, light);
    constant c_formats : formats_t := formats(c.exact);

    variable bits : positive := c_formats.coefficient.bits + 1;
  begin
    if kind /= c_ambient then
      bits := larger(bits, larger(c_formats.reflected.bits, c_formats.weight.bits) + 1);
    end if;
    if has_dot_product(c, kind, light) then
      bits := larger(bits, c_formats.direction.bits);
    end if;
    if c_shape.far then
      bits := larger(bits, c_formats.light_place.bits);
    end if;
    return bits;
  end function;

  function factor_b_bits (c : config_t; kind, light : natural) return positive is
    constant c_shape   : shape_t   := shape(c, kind, light);
    constant c_formats : formats_t := formats(c.exact);

    variable bits : positive := c_formats.light_intensity.bits + 1;
  begin
    if kind /= c_ambient then
      bits := larger(bits, c_formats.weight.bits + 1);
    end if;
    if has_dot_product(c, kind, light) then
      bits := larger(bits, c_formats.direction.bits);
    end if;
    if c_shape.first or c_shape.second then
      bits := larger(bits, c_formats.root.bits + 2);
    end if;
    if c_shape.far then
      bits := larger(bits, c_formats.vector.bits);
    end if;
    return bits;
  end function;

  function shared_product_bits (c : config_t; kind, light : natural) return positive is
  begin
    return factor_a_bits(c, kind, light) + factor_b_bits(c, kind, light);
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

end package body;
