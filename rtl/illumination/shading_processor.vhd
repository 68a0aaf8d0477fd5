-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One term of the illumination model, folded: I_out = I_in + k I (N.A)**x, on one dot product, one vector
--             product, an adder, and where they are called for the block shift, 1/sqrt, the power, a spot's cone and a
--             counter of shadow volumes. The ambient processor makes N ready for all others, and the view vector.
-- Contract    A token moves where valid and ready are both '1' at a rising edge; out_token does not change while it
--             waits. Every token comes out, in order. define, redefine and delete of g_light act on the tokens behind
--             them; after reset the light is not valid. Objects come out with N, view vector and I renewed, or with I
--             as it was: where the light is not valid, or shadow volumes are around the point. in_ready is '0' for a
--             while after reset and after new_frame where shadows are counted (shadow_counter). fault stays '1' from
--             the clock after the token that left in it: a count of shadow volumes that left its format.
-- Formats     processors_pkg, formats_pkg; words between the units: terms_pkg
-- Latency     a clock less than the throughput's
-- Throughput  A token in so many clocks, the one that takes it and the one that hands it on included (published, exact):
--             load, delete, shadow polygon, object that is not lit 2, 2; ambient 4, 4; with N normalized 6, 9; with the
--             view vector too -, 15 (without N 10); directional diffuse 6, 6, specular 7, 20; positional diffuse 12, 16, specular 13,
--             30; spot diffuse 18, 22, specular 24, 32. None of them waits but for a unit: the paper's counts leave no
--             slack.
-- Source      processors paper, figures 1 and 2 and table 4, whose clocks those of preset published are. Ours: spots,
--             perspective, the view vector.
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

entity shading_processor is
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

architecture rtl of shading_processor is

  constant c_config  : config_t        := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_formats : formats_t       := formats(g_exact);
  constant c_header  : pixel_header_t  := pixel_header(g_exact);
  constant c_shape   : shape_t         := shape(c_config, g_kind, g_light);

  constant c_direction : positive := c_formats.direction.bits;
  constant c_vector    : positive := c_formats.vector.bits;
  constant c_place     : positive := c_formats.light_place.bits;
  constant c_k         : positive := c_formats.coefficient.bits;
  constant c_intensity : positive := c_formats.light_intensity.bits;
  constant c_reflected : positive := c_formats.reflected.bits;
  constant c_weight    : positive := c_formats.weight.bits;
  constant c_radiance  : positive := c_formats.radiance.bits;
  constant c_root      : positive := c_formats.root.bits + 1;
  constant c_sum       : positive := normalized_bits(c_config, g_kind, g_light);

  -- Of the one vector product, whose operands are signed.
  function a_bits return positive is
    variable bits : positive := c_k + 1;
  begin
    if g_kind /= c_ambient then
      bits := larger(bits, larger(c_reflected, c_weight) + 1);
    end if;
    if c_shape.first or c_shape.second then
      bits := larger(bits, c_direction);
    end if;
    if c_shape.far then
      bits := larger(bits, c_place);
    end if;
    return bits;
  end function;

  function b_bits return positive is
    variable bits : positive := c_intensity + 1;
  begin
    if g_kind /= c_ambient then
      bits := larger(bits, c_weight + 1);
    end if;
    if c_shape.first or c_shape.second then
      bits := larger(bits, c_root + 1);
    end if;
    if c_shape.far then
      bits := larger(bits, c_vector);
    end if;
    return bits;
  end function;

  constant c_a       : positive := a_bits;
  constant c_b       : positive := b_bits;
  constant c_product : positive := c_a + c_b;

  -- The clock after the one that takes a token is 1. Where two lists have a step, the first vector is N or L, the second
  -- the view vector or H.
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
    horizon  : natural; -- N.L of a highlight is there
    cosine   : natural; -- the dot product takes N and A
    angle    : natural; -- (N.A) is there
    weigh_in : natural; -- (N.A)**x is there; of a spot's light it takes the cone's factor before it
    axis     : natural; -- the dot product takes L and the cone's axis
    cone     : natural;
    factor   : natural;
    narrow   : natural; -- the vector product takes weight and factor
    narrowed : natural;
    weigh    : natural; -- the vector product takes k I and weight
    add      : natural;
    leave    : natural; -- the token waits for who takes it
  end record;

  constant c_shift_clocks : positive := c_vector_shift_latency;
  constant c_dot_clocks   : positive := c_dot_product_latency;
  constant c_mul_clocks   : positive := c_vector_multiply_latency;
  constant c_root_clocks  : positive := reciprocal_root_latency(g_exact);
  constant c_power_clocks : positive := power_latency(g_exact);
  constant c_cone_clocks  : positive := c_spot_cone_latency;

  function schedule return schedule_t is
    variable s : schedule_t := (others => 0);
    variable t : natural    := 1; -- when the next step has what it takes
  begin
    if c_shape.first then
      if g_kind /= c_ambient then
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
      if g_kind = c_ambient then
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
    if g_kind = c_ambient then
      s.add := 1 + c_mul_clocks;
      if c_shape.second then
        s.add := s.square_2 + c_mul_clocks;
      end if;
      s.leave := larger(t, s.add + 1);
      return s;
    end if;
    s.cosine := t;
    s.angle  := t + c_dot_clocks;
    if g_kind = c_diffuse then
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
    s.add   := s.weigh + c_mul_clocks;
    s.leave := s.add + 1;
    return s;
  end function;

  constant c_at : schedule_t := schedule;

  subtype cycle_t is natural range 0 to c_at.leave;

  type reg_t is record
    cycle : cycle_t;   -- 0: no token
    taken : std_logic; -- in the clock before
    valid : std_logic; -- the light
  end record;

  signal r, r_next : reg_t;

  signal command : natural range 0 to c_shadow; -- of the token that comes
  signal mine    : std_logic;                   -- it is for this light
  signal comes   : std_logic;                   -- it is an object
  signal free    : std_logic;
  signal take    : std_logic;
  signal defines : std_logic;
  signal token   : std_logic_vector(in_token'range);
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0);

  signal ready : std_logic; -- the counter
  signal lit   : std_logic;

  subtype directions_t is std_logic_vector(c_axes * c_direction - 1 downto 0);

  -- What the processor's kind feeds the shared units.
  signal dot_a     : directions_t;
  signal dot_b     : directions_t;
  signal dot       : std_logic_vector(2 * c_direction downto 0);
  signal mul_a     : std_logic_vector(c_axes * c_a - 1 downto 0);
  signal mul_b     : std_logic_vector(c_axes * c_b - 1 downto 0);
  signal products  : std_logic_vector(c_axes * c_product - 1 downto 0);
  signal to_shift  : std_logic_vector(c_axes * c_sum - 1 downto 0);
  signal shifted   : directions_t;
  signal root      : std_logic_vector(c_root - 1 downto 0);
  signal unit      : directions_t; -- the product rounded
  signal positive_dot : std_logic;

  signal at_place  : std_logic; -- the light is positional
  signal spotted   : std_logic; -- a spot
  signal normalize : std_logic; -- N of this object
  signal narrowing : std_logic; -- the vector product takes weight and factor
  signal weight    : std_logic_vector(c_weight - 1 downto 0);
  signal factor    : std_logic_vector(c_weight - 1 downto 0);

  -- From clock `first` on for `clocks` clocks.
  function during (cycle, first, clocks : natural) return boolean is
  begin
    return cycle >= first and cycle < first + clocks;
  end function;

  -- Component `axis` of a word of the light.
  function of_light (word : std_logic_vector; field : slice_t; axis : natural) return std_logic_vector is
    constant c_low : natural := light_axes_channel_low(g_exact, axis);
  begin
    return word(c_low + field.high downto c_low + field.low);
  end function;

  function of_header (word : std_logic_vector; field : slice_t) return std_logic_vector is
  begin
    return word(field.high downto field.low);
  end function;

  constant c_light_header : light_axes_header_t  := light_axes_header(g_exact);
  constant c_light_axis   : light_axes_channel_t := light_axes_channel(g_exact);

begin

  -- What comes.

  command <= to_integer(unsigned(of_header(in_token, c_header.command)));
  mine    <= '1' when unsigned(of_header(in_token, c_header.light)) = g_light else '0';
  comes   <= '1' when command = c_new_pixel or command = c_new_object or command = c_new_scanline else '0';
  free    <= ready when r.cycle = 0 else '0';
  take    <= in_valid and free;
  defines <= '1' when mine = '1' and (command = c_define or (command = c_redefine and r.valid = '1')) else '0';

  in_ready  <= free;
  out_valid <= '1' when r.cycle = c_at.leave else '0';
  out_token <= token;
  busy      <= '0' when r.cycle = 0 else '1';

  light_register : entity work.parameter_register
    generic map (
      g_bits => light'length
      )
    port map (
      clk   => clk,
      load  => take and defines,
      start => in_token(light_axes_low(c_config) + light'high downto light_axes_low(c_config)),
      value => light
      );

  flags : if c_shape.positional generate

    at_place <= light(c_light_header.positional.low);
    spotted  <= light(c_light_header.spot.low) when c_shape.spots else '0';

  else generate

    at_place <= '0';
    spotted  <= '0';

  end generate;

  normalize <= token(c_header.normalize.low);

  combinational : process (all)
    variable v     : reg_t;
    variable start : cycle_t; -- of an object that is to be shaded
  begin
    v       := r;
    v.taken := '0';

    start := 1;
    if g_kind = c_ambient then
      if c_shape.first and c_shape.second and in_token(c_header.normalize.low) = '0' then
        start := c_at.shift_2;
      end if;
    elsif at_place = '0' then
      start := c_at.cosine;
      if g_exact and c_shape.second then
        start := c_at.sum_2;
      end if;
    elsif c_shape.first and c_shape.second and not g_exact and spotted = '0' then
      start := c_at.sum_2;
    end if;

    if r.cycle = 0 then
      if take = '1' then
        v.taken := comes;
        v.cycle := c_at.leave;
        if comes = '1' and (g_kind = c_ambient or r.valid = '1') then
          v.cycle := start;
        end if;
        if defines = '1' then
          v.valid := '1';
        elsif mine = '1' and command = c_delete then
          v.valid := '0';
        end if;
      end if;
    elsif r.cycle = c_at.leave then
      if out_ready = '1' then
        v.cycle := 0;
      end if;
    else
      v.cycle := r.cycle + 1;
      if c_shape.spots and r.cycle = c_at.weigh_in - 1 and spotted = '0' then
        v.cycle := c_at.weigh;
      end if;
      if g_kind = c_ambient and not c_shape.second and r.cycle = c_at.add and normalize = '0' then
        v.cycle := c_at.leave;
      end if;
      if g_kind = c_specular and g_exact and r.cycle = c_at.horizon and positive_dot = '0' then
        v.cycle := c_at.leave;
      end if;
      if r.taken = '1' and lit = '0' then
        v.cycle := c_at.leave;
      end if;
    end if;

    if reset = '1' then
      v.cycle := 0;
      v.taken := '0';
      v.valid := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- The token, with what is renewed of it.
  payload : process (clk)
    variable low     : natural;
    variable product : unsigned(c_reflected + c_weight - 1 downto 0);
  begin
    if rising_edge(clk) then
      if take = '1' then
        token <= in_token;
        if g_kind = c_ambient and comes = '1' and
          not (c_shape.first and in_token(c_header.normalize.low) = '1') then
          for axis in 0 to c_axes - 1 loop
            low := normal_low(c_config, axis);
            token(low + c_vector - 1 downto low) <=
              extended(plain_direction(g_exact, signed(in_token(low + c_vector - 1 downto low))), c_vector);
          end loop;
        end if;
      end if;
      if g_kind = c_ambient then
        if c_shape.first and r.cycle = c_at.round_1 and normalize = '1' then
          for axis in 0 to c_axes - 1 loop
            low := normal_low(c_config, axis);
            token(low + c_vector - 1 downto low) <=
              extended(std_logic_vector(axis_of(unit, axis)), c_vector);
          end loop;
        end if;
        if c_shape.second and r.cycle = c_at.round_2 then
          low := view_low(c_config, 0);
          token(low + unit'high downto low) <= unit;
        end if;
      end if;
      if r.cycle = c_at.add and r.valid = '1' then
        for channel in 0 to g_channels - 1 loop
          low := radiance_low(c_config, channel);
          if g_kind = c_ambient then
            product := unsigned('0' & reflected(g_exact, unsigned(
              products(channel * c_product + c_k + c_intensity - 1 downto channel * c_product)))) &
              (c_weight - 2 downto 0 => '0');
          else
            product := unsigned(
              products(channel * c_product + product'high downto channel * c_product));
          end if;
          token(low + c_radiance - 1 downto low) <=
            brightened(g_exact, token(low + c_radiance - 1 downto low), product);
        end loop;
      end if;
    end if;
  end process;

  -- Shadows.

  shadows : if g_shadows and g_kind /= c_ambient generate

    signal counts : std_logic;
    signal clear  : std_logic;

    begin

      counts <= '1' when command = c_shadow and mine = '1' else '0';
      clear  <= '1' when command = c_new_frame else '0';

      counter : entity work.shadow_counter
        port map (
          clk        => clk,
          reset      => reset,
          ready      => ready,
          step       => take,
          clear      => clear,
          counts     => counts,
          opens      => in_token(c_header.opens.low),
          takes      => comes,
          x          => of_header(in_token, c_header.x),
          around_eye => of_header(light, c_light_header.around_eye),
          lit        => lit,
          fault      => fault
          );

  else generate

    ready <= '1';
    lit   <= '1';
    fault <= '0';

  end generate;

  -- The vector product: colours, and what the steps below want of it.

  products_of : process (all)
    variable low      : natural;
    variable a        : std_logic_vector(c_axes * c_a - 1 downto 0);
    variable b        : std_logic_vector(c_axes * c_b - 1 downto 0);
    variable of_light_low : natural;
  begin
    a := (others => '0');
    b := (others => '0');
    if (c_shape.first and r.cycle = c_at.scale_1) or (c_shape.second and r.cycle = c_at.scale_2) then
      for axis in 0 to c_axes - 1 loop
        a((axis + 1) * c_a - 1 downto axis * c_a) := extended(std_logic_vector(axis_of(shifted, axis)), c_a);
        b(axis * c_b + root'high downto axis * c_b) := root;
      end loop;
    elsif c_shape.far and r.cycle < c_at.sum_1 then
      for axis in 0 to c_axes - 1 loop
        a((axis + 1) * c_a - 1 downto axis * c_a) := extended(of_light(light, c_light_axis.place, axis), c_a);
        low                                       := distance_low(c_config);
        b((axis + 1) * c_b - 1 downto axis * c_b) := extended(token(low + c_vector - 1 downto low), c_b);
      end loop;
    elsif narrowing = '1' then
      a(c_weight - 1 downto 0) := weight;
      b(c_weight - 1 downto 0) := factor;
    else
      for channel in 0 to g_channels - 1 loop
        if g_kind /= c_ambient and r.cycle = c_at.weigh then
          a(channel * c_a + c_reflected - 1 downto channel * c_a) := reflected(g_exact,
            unsigned(products(channel * c_product + c_k + c_intensity - 1 downto channel * c_product)));
          b(channel * c_b + c_weight - 1 downto channel * c_b) := weight;
        else
          low := coefficient_low(c_config, g_kind, channel);
          a(channel * c_a + c_k - 1 downto channel * c_a) := token(low + c_k - 1 downto low);
          of_light_low := light_axes_bits(g_exact, c_axes) + light_colour_channel_low(g_exact, channel);
          b(channel * c_b + c_intensity - 1 downto channel * c_b) :=
            light(of_light_low + c_intensity - 1 downto of_light_low);
        end if;
      end loop;
    end if;
    mul_a <= a;
    mul_b <= b;
  end process;

  multiplier : entity work.vector_multiply
    generic map (
      g_a_bits => c_a,
      g_b_bits => c_b
      )
    port map (
      clk      => clk,
      enable   => '1',
      a        => mul_a,
      b        => mul_b,
      products => products
      );

    -- The dot product.

  dot_product_of : if g_kind /= c_ambient or c_shape.first or c_shape.second generate

    dot_product : entity work.dot_product
      generic map (
        g_bits => c_direction
        )
      port map (
        clk    => clk,
        enable => '1',
        a      => dot_a,
        b      => dot_b,
        sum    => dot
        );

    positive_dot <= is_positive(signed(dot));

  end generate;

  -- Unit vectors.

  normalization : if c_shape.first or c_shape.second generate

    constant c_square_low : natural := 2 * (c_direction - 1) - c_formats.square.fraction;

    signal square : std_logic_vector(c_formats.square.bits - 1 downto 0);
    signal shifts : std_logic;

    begin

      shifts <= '1' when (c_shape.first and during(r.cycle, c_at.shift_1, c_shift_clocks)) or
        (c_shape.second and during(r.cycle, c_at.shift_2, c_shift_clocks)) else '0';

      block_shift : entity work.vector_shift
        generic map (
          g_vector_bits => c_sum,
          g_result_bits => c_direction
          )
        port map (
          clk    => clk,
          enable => shifts,
          components => to_shift,
          shifted => shifted
          );

      square <= dot(c_square_low + square'high downto c_square_low);

      reciprocal_root : entity work.reciprocal_root
        generic map (
          g_exact => g_exact
          )
        port map (
          clk        => clk,
          enable     => '1',
          square     => square,
          reciprocal => root
          );

      axes : for axis in 0 to c_axes - 1 generate

        unit((axis + 1) * c_direction - 1 downto axis * c_direction) <= unit_direction(g_exact,
          signed(products(axis * c_product + c_direction + c_root downto axis * c_product)));

      end generate;

  end generate;

  ambient : if g_kind = c_ambient generate

    dot_a <= shifted;
    dot_b <= shifted;

    weight    <= (others => '0');
    factor    <= (others => '0');
    narrowing <= '0';

    -- N while it is taken, then the way to the eye.
    axes : for axis in 0 to c_axes - 1 generate

      constant c_normal : natural := normal_low(c_config, axis);
      constant c_ray    : natural := place_low(c_config, axis);

      begin

        both : if c_shape.second generate

          to_shift((axis + 1) * c_sum - 1 downto axis * c_sum) <= in_token(c_normal + c_vector - 1 downto c_normal)
            when r.cycle = 0 else std_logic_vector(-signed(token(c_ray + c_vector - 1 downto c_ray)));

        else generate

          to_shift((axis + 1) * c_sum - 1 downto axis * c_sum) <= in_token(c_normal + c_vector - 1 downto c_normal);

        end generate;

    end generate;

  else generate

    signal normal        : directions_t;
    signal to_light      : directions_t;
    signal half          : directions_t;
    signal unit_1        : directions_t; -- L, where it was normalized
    signal unit_2        : directions_t; -- H
    signal cone_axis     : directions_t;
    signal cosine_now    : unsigned(c_formats.direction.fraction downto 0);
    signal sums          : std_logic_vector(c_axes * c_sum - 1 downto 0);
    signal weight_now    : std_logic_vector(c_weight - 1 downto 0); -- without the cone
    signal weight_before : std_logic_vector(c_weight - 1 downto 0);

    begin

      axes : for axis in 0 to c_axes - 1 generate

        constant c_low  : natural := axis * c_direction;
        constant c_high : natural := c_low + c_direction - 1;

        begin

          normal(c_high downto c_low) <=
            token(normal_low(c_config, axis) + c_direction - 1 downto normal_low(c_config, axis));
          cone_axis(c_high downto c_low) <= of_light(light, c_light_axis.axis, axis);

          placed : if c_shape.first generate

            to_light(c_high downto c_low) <= unit_1(c_high downto c_low) when at_place = '1' else
              light_direction(g_exact, of_light(light, c_light_axis.place, axis));

          else generate

            to_light(c_high downto c_low) <= light_direction(g_exact, of_light(light, c_light_axis.place, axis));

          end generate;

          halfway : if g_exact generate

            half(c_high downto c_low) <= unit_2(c_high downto c_low);

          elsif c_shape.second generate

            half(c_high downto c_low) <= unit_2(c_high downto c_low) when at_place = '1' else
              of_light(light, c_light_axis.half, axis);

          else generate

            half(c_high downto c_low) <= of_light(light, c_light_axis.half, axis);

          end generate;

      end generate;

      dots : process (all)
      begin
        dot_a <= normal;
        dot_b <= to_light;
        if g_kind = c_specular and not (g_exact and r.cycle = c_at.sum_2) then
          dot_b <= half;
        end if;
        if c_shape.spots and r.cycle = c_at.axis then
          dot_a <= to_light;
          dot_b <= cone_axis;
        end if;
        if (c_shape.first and r.cycle = c_at.square_1) or (c_shape.second and r.cycle = c_at.square_2) then
          dot_a <= shifted;
          dot_b <= shifted;
        end if;
      end process;

      to_shift <= sums;

      -- Vectors between the steps.
      vectors : if c_shape.first or c_shape.second generate

        held : process (clk)
          variable sum : signed(c_sum - 1 downto 0);
          variable low : natural;
        begin
          if rising_edge(clk) then
            if c_shape.first and r.cycle = c_at.round_1 then
              unit_1 <= unit;
            end if;
            if c_shape.second and r.cycle = c_at.round_2 then
              unit_2 <= unit;
            end if;
            for axis in 0 to c_axes - 1 loop
              sum := (others => '0');
              if c_shape.positional and (not g_exact or r.cycle = c_at.sum_1) then
                low := place_low(c_config, axis);
                if g_exact then
                  sum := signed(offset(g_exact, signed(
                    products(axis * c_product + c_place + c_vector - 1 downto axis * c_product)),
                    signed(token(low + c_vector - 1 downto low)),
                    of_header(light, c_light_header.shift)));
                else
                  sum := signed(offset(g_exact, signed(of_light(light, c_light_axis.place, axis)),
                    signed(token(low + c_vector - 1 downto low)), "0"));
                end if;
              elsif g_kind = c_specular and g_exact then
                low := view_low(c_config, axis);
                sum := resize(axis_of(to_light, axis), c_sum) +
                  signed(token(low + c_direction - 1 downto low));
              end if;
              if g_kind = c_specular and not g_exact and r.cycle = c_at.sum_2 then
                sum := sum + signed(of_light(light, c_light_axis.half, axis));
              end if;
              if (c_shape.first and r.cycle = c_at.sum_1) or (c_shape.second and r.cycle = c_at.sum_2) then
                sums((axis + 1) * c_sum - 1 downto axis * c_sum) <= std_logic_vector(sum);
              end if;
            end loop;
          end if;
        end process;

      end generate;

      -- The weight.

      cosine_now <= cosine(g_exact, signed(dot));

      diffuse : if g_kind = c_diffuse generate

        weight_now <= weight_before;

      else generate

        power : entity work.power
          generic map (
            g_exact => g_exact
            )
          port map (
            clk      => clk,
            enable   => '1',
            base     => std_logic_vector(cosine_now),
            exponent => token(material_low(c_config) + exponent_low(c_config) + c_formats.exponent.bits - 1
            downto material_low(c_config) + exponent_low(c_config)),
            result   => weight_now
            );

      end generate;

      weights : process (clk)
      begin
        if rising_edge(clk) then
          if g_kind = c_diffuse and r.cycle = c_at.angle then
            weight_before <= cosine_weight(g_exact, cosine_now);
          end if;
          if c_shape.spots and g_kind = c_specular and r.cycle = c_at.weigh_in then
            weight_before <= weight_now;
          end if;
          if c_shape.spots and r.cycle = c_at.narrowed then
            weight_before <= coned_weight(g_exact, unsigned(products(2 * c_weight - 1 downto 0)));
          end if;
        end if;
      end process;

      cones : if c_shape.spots generate

        signal factor_now    : std_logic_vector(c_weight - 1 downto 0);
        signal factor_before : std_logic_vector(c_weight - 1 downto 0);

        begin

          spot_cone : entity work.spot_cone
            generic map (
              g_exact => g_exact
              )
            port map (
              clk      => clk,
              enable   => '1',
              axis_sum => dot,
              outer    => of_header(light, c_light_header.outer),
              slope    => of_header(light, c_light_header.slope),
              factor   => factor_now
              );

          factors : process (clk)
          begin
            if rising_edge(clk) then
              if r.cycle = c_at.factor then
                factor_before <= factor_now;
              end if;
            end if;
          end process;

          narrowing <= '1' when r.cycle = c_at.narrow else '0';
          factor    <= factor_now when c_at.narrow = c_at.factor else factor_before;
          weight    <= weight_now when spotted = '0' or (c_at.narrow = c_at.weigh_in and narrowing = '1') else
            weight_before;

      else generate

        factor    <= (others => '0');
        narrowing <= '0';
        weight    <= weight_now;

      end generate;

  end generate;

end architecture;
