-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One term of the illumination model, unrolled: I_out = I_in + k I (N.A)**x with a unit for every step, so that
--             a token comes and one leaves each clock. The same results as shading_processor, bit for bit.
-- Contract    that of shading_processor, but for the clocks: all stages stand still together while out_token waits; and
--             what changes the light, defines it or deletes it, is taken when no token is before it in the stages. fault
--             stays '1' from, at the latest, the clock after the token that left in it.
-- Formats     processors_pkg, formats_pkg; words between the units: terms_pkg
-- Latency     times of terms_pkg: leave (published, exact): ambient 2, 2; with N normalized or the view vector 6, 9;
--             directional diffuse 4, 4, specular 5, 18; positional diffuse 10, 14, specular 11, 28; spot diffuse 14, 18,
--             specular 14, 29
-- Throughput  1 token a clock
-- Source      processors paper, figures 1 and 2, unrolled; ours
-- Golden twin model/golden/shading_processor.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.shading_pkg.all;
use work.terms_pkg.all;

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

  constant c_config  : config_t       := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_formats : formats_t      := formats(g_exact);
  constant c_header  : pixel_header_t := pixel_header(g_exact);
  constant c_shape   : shape_t        := shape(c_config, g_kind, g_light);
  constant c_at      : times_t        := times(c_config, g_kind, g_light);

  constant c_light_header : light_axes_header_t  := light_axes_header(g_exact);
  constant c_light_axis   : light_axes_channel_t := light_axes_channel(g_exact);

  constant c_direction : positive := c_formats.direction.bits;
  constant c_vector    : positive := c_formats.vector.bits;
  constant c_k         : positive := c_formats.coefficient.bits;
  constant c_intensity : positive := c_formats.light_intensity.bits;
  constant c_reflected : positive := c_formats.reflected.bits;
  constant c_weight    : positive := c_formats.weight.bits;
  constant c_radiance  : positive := c_formats.radiance.bits;

  subtype token_t is std_logic_vector(in_token'range);
  subtype directions_t is std_logic_vector(c_axes * c_direction - 1 downto 0);
  subtype vectors_t is std_logic_vector(c_axes * c_vector - 1 downto 0);
  subtype weight_t is std_logic_vector(c_weight - 1 downto 0);

  type reg_t is record
    filled : std_logic_vector(c_at.leave downto 1); -- stages that hold a token
    valid  : std_logic;                             -- the light
  end record;

  signal r, r_next : reg_t;

  signal command : natural range 0 to c_shadow; -- of the token that comes
  signal mine    : std_logic;                   -- it is for this light
  signal comes   : std_logic;                   -- it is an object
  signal changes : std_logic;                   -- it changes the light
  signal defines : std_logic;
  signal flows   : std_logic;
  signal free    : std_logic;
  signal take    : std_logic;
  signal light   : std_logic_vector(light_bits(c_config) - 1 downto 0);

  signal ready : std_logic; -- the counter
  signal lit   : std_logic; -- the first stage's token

  signal colours   : std_logic_vector(c_axes * (c_k + 1) - 1 downto 0); -- k
  signal colours_i : std_logic_vector(c_axes * (c_k + 1) - 1 downto 0);
  signal intensity : std_logic_vector(c_axes * (c_intensity + 1) - 1 downto 0);
  signal k_i       : std_logic_vector(c_axes * (c_k + c_intensity + 2) - 1 downto 0);
  signal terms     : std_logic_vector(g_channels * (c_reflected + c_weight) - 1 downto 0);
  signal shaded    : std_logic; -- the token at the sum is an object that takes the term
  signal behind    : token_t;   -- at the sum
  signal renewed   : std_logic_vector(c_axes * c_direction - 1 downto 0); -- N of the ambient processor
  signal view      : directions_t;

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

begin

  -- What comes.

  command <= to_integer(unsigned(of_header(in_token, c_header.command)));
  mine    <= '1' when unsigned(of_header(in_token, c_header.light)) = g_light else '0';
  comes   <= '1' when command = c_new_pixel or command = c_new_object or command = c_new_scanline else '0';
  changes <= '1' when mine = '1' and (command = c_define or command = c_redefine or command = c_delete) else '0';
  defines <= '1' when mine = '1' and (command = c_define or (command = c_redefine and r.valid = '1')) else '0';

  flows <= out_ready or not r.filled(c_at.leave);
  free  <= flows and ready and not (in_valid and changes and (or r.filled));
  take  <= in_valid and free;

  in_ready  <= free;
  out_valid <= r.filled(c_at.leave);
  busy      <= or r.filled;

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

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if flows = '1' then
      v.filled := r.filled(c_at.leave - 1 downto 1) & take;
    end if;
    if take = '1' then
      if defines = '1' then
        v.valid := '1';
      elsif changes = '1' and command = c_delete then
        v.valid := '0';
      end if;
    end if;
    if reset = '1' then
      v.filled := (others => '0');
      v.valid  := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
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

  -- k I, as it comes to the sum or to the product with the weight.

  colour : for channel in 0 to c_axes - 1 generate

    constant c_a : natural := channel * (c_k + 1);
    constant c_b : natural := channel * (c_intensity + 1);

    begin

      there : if channel < g_channels generate

        constant c_low   : natural := coefficient_low(c_config, g_kind, channel);
        constant c_i_low : natural := light_axes_bits(g_exact, c_axes) + light_colour_channel_low(g_exact, channel);

        begin

          colours(c_a + c_k downto c_a)           <= '0' & in_token(c_low + c_k - 1 downto c_low);
          intensity(c_b + c_intensity downto c_b) <= '0' & light(c_i_low + c_intensity - 1 downto c_i_low);

      else generate

        colours(c_a + c_k downto c_a)           <= (others => '0');
        intensity(c_b + c_intensity downto c_b) <= (others => '0');

      end generate;

  end generate;

  before_k_i : entity work.delay_line
    generic map (
      g_bits  => colours'length,
      g_depth => c_at.weight - c_vector_multiply_latency
      )
    port map (
      clk     => clk,
      reset   => reset,
      enable  => flows,
      word    => colours,
      delayed => colours_i
      );

  reflection : entity work.vector_multiply
    generic map (
      g_a_bits => c_k + 1,
      g_b_bits => c_intensity + 1
      )
    port map (
      clk      => clk,
      enable   => flows,
      a        => colours_i,
      b        => intensity,
      products => k_i
      );

    -- The token, and what is renewed of it.

  beside : entity work.delay_line
    generic map (
      g_bits  => in_token'length,
      g_depth => c_at.term
      )
    port map (
      clk     => clk,
      reset   => reset,
      enable  => flows,
      word    => in_token,
      delayed => behind
      );

  payload : process (clk)
    variable low : natural;
    variable now : natural range 0 to c_shadow;
  begin
    if rising_edge(clk) then
      if flows = '1' then
        out_token <= behind;
        now := to_integer(unsigned(of_header(behind, c_header.command)));
        if g_kind = c_ambient and (now = c_new_pixel or now = c_new_object or now = c_new_scanline) then
          for axis in 0 to c_axes - 1 loop
            low := normal_low(c_config, axis);
            out_token(low + c_vector - 1 downto low) <= extended(std_logic_vector(axis_of(renewed, axis)), c_vector);
          end loop;
          if c_shape.second then
            low := view_low(c_config, 0);
            out_token(low + view'high downto low) <= view;
          end if;
        end if;
        if shaded = '1' and (now = c_new_pixel or now = c_new_object or now = c_new_scanline) then
          for channel in 0 to g_channels - 1 loop
            low := radiance_low(c_config, channel);
            out_token(low + c_radiance - 1 downto low) <= brightened(g_exact, behind(low + c_radiance - 1 downto low),
              unsigned(terms((channel + 1) * (c_reflected + c_weight) - 1 downto channel * (c_reflected + c_weight))));
          end loop;
        end if;
      end if;
    end if;
  end process;

  ambient : if g_kind = c_ambient generate

    shaded <= r.valid;

    sums : for channel in 0 to g_channels - 1 generate

      constant c_low : natural := channel * (c_reflected + c_weight);

      begin

        terms(c_low + c_reflected + c_weight - 1 downto c_low) <= '0' & reflected(g_exact,
          unsigned(k_i(channel * (c_k + c_intensity + 2) + c_k + c_intensity - 1 downto
          channel * (c_k + c_intensity + 2)))) & (c_weight - 2 downto 0 => '0');

    end generate;

    normals : if c_shape.first generate

      signal unit : directions_t;

      begin

        unit_normal : entity work.unit_vector
          generic map (
            g_exact       => g_exact,
            g_vector_bits => c_vector
            )
          port map (
            clk        => clk,
            reset      => reset,
            enable     => flows,
            components => in_token(normal_low(c_config, c_axes) - 1 downto normal_low(c_config, 0)),
            unit       => unit
            );

        axes : for axis in 0 to c_axes - 1 generate

          constant c_low : natural := axis * c_direction;

          begin

            renewed(c_low + c_direction - 1 downto c_low) <= unit(c_low + c_direction - 1 downto c_low)
              when behind(c_header.normalize.low) = '1' else plain_direction(g_exact,
              signed(behind(normal_low(c_config, axis) + c_vector - 1 downto normal_low(c_config, axis))));

        end generate;

    else generate

      axes : for axis in 0 to c_axes - 1 generate

        renewed((axis + 1) * c_direction - 1 downto axis * c_direction) <= plain_direction(g_exact,
          signed(behind(normal_low(c_config, axis) + c_vector - 1 downto normal_low(c_config, axis))));

      end generate;

    end generate;

    views : if c_shape.second generate

      signal to_eye : vectors_t;

      begin

        axes : for axis in 0 to c_axes - 1 generate

          to_eye((axis + 1) * c_vector - 1 downto axis * c_vector) <= std_logic_vector(
            -signed(in_token(place_low(c_config, axis) + c_vector - 1 downto place_low(c_config, axis))));

        end generate;

        unit_view : entity work.unit_vector
          generic map (
            g_exact       => g_exact,
            g_vector_bits => c_vector
            )
          port map (
            clk        => clk,
            reset      => reset,
            enable     => flows,
            components => to_eye,
            unit       => view
            );

    else generate

      view <= (others => '0');

    end generate;

  else generate

    constant c_offset : positive := c_formats.offset.bits;
    constant c_place  : positive := c_formats.light_place.bits;

    signal at_place    : std_logic; -- the light is positional
    signal straight    : directions_t; -- L of one that is not
    signal normal      : directions_t;
    signal normal_now  : directions_t; -- at the dot product
    signal to_light    : directions_t;
    signal half        : directions_t;
    signal opposite    : directions_t; -- A
    signal dot         : std_logic_vector(2 * c_direction downto 0);
    signal cosine_now  : unsigned(c_formats.direction.fraction downto 0);
    signal raised      : weight_t;
    signal weight      : weight_t;
    signal before_horizon : std_logic; -- lit, and no light below the horizon: at_time c_at.to_light + dot product
    signal lit_now     : std_logic;

    begin

      renewed <= (others => '0');
      view    <= (others => '0');

      axes : for axis in 0 to c_axes - 1 generate

        constant c_low : natural := axis * c_direction;

        begin

          normal(c_low + c_direction - 1 downto c_low) <=
            in_token(normal_low(c_config, axis) + c_direction - 1 downto normal_low(c_config, axis));
          straight(c_low + c_direction - 1 downto c_low) <=
            light_direction(g_exact, of_light(light, c_light_axis.place, axis));

      end generate;

      -- L

      lights : if c_shape.first generate

        signal points   : vectors_t;
        signal points_now : vectors_t;
        signal places   : std_logic_vector(c_axes * (c_place + c_vector) - 1 downto 0);
        signal offsets  : std_logic_vector(c_axes * c_offset - 1 downto 0);
        signal unit     : directions_t;

        begin

          points <= in_token(place_low(c_config, c_axes) - 1 downto place_low(c_config, 0));

          before_offset : entity work.delay_line
            generic map (
              g_bits  => points'length,
              g_depth => c_at.summed - 1
              )
            port map (
              clk     => clk,
              reset   => reset,
              enable  => flows,
              word    => points,
              delayed => points_now
              );

          far : if c_shape.far generate

            constant c_low : natural := distance_low(c_config);

            signal light_places : std_logic_vector(c_axes * c_place - 1 downto 0);
            signal distance     : std_logic_vector(c_vector - 1 downto 0);

            begin

              distance <= in_token(c_low + c_vector - 1 downto c_low);

              axes_far : for axis in 0 to c_axes - 1 generate

                light_places((axis + 1) * c_place - 1 downto axis * c_place) <=
                  of_light(light, c_light_axis.place, axis);

              end generate;

              at_distance : entity work.vector_multiply
                generic map (
                  g_a_bits => c_place,
                  g_b_bits => c_vector
                  )
                port map (
                  clk      => clk,
                  enable   => flows,
                  a        => light_places,
                  b        => distance & distance & distance,
                  products => places
                  );

          end generate;

          way : process (clk)
          begin
            if rising_edge(clk) then
              if flows = '1' then
                for axis in 0 to c_axes - 1 loop
                  if g_exact then
                    offsets((axis + 1) * c_offset - 1 downto axis * c_offset) <= offset(g_exact, axis_of(places, axis),
                      axis_of(points_now, axis), of_header(light, c_light_header.shift));
                  else
                    offsets((axis + 1) * c_offset - 1 downto axis * c_offset) <= offset(g_exact,
                      resize(signed(of_light(light, c_light_axis.place, axis)), c_offset), axis_of(points_now, axis),
                      "0");
                  end if;
                end loop;
              end if;
            end if;
          end process;

          to_unit : entity work.unit_vector
            generic map (
              g_exact       => g_exact,
              g_vector_bits => c_offset
              )
            port map (
              clk        => clk,
              reset      => reset,
              enable     => flows,
              components => offsets,
              unit       => unit
              );

          to_light <= unit when at_place = '1' else straight;

      else generate

        to_light <= straight;

      end generate;

      positional : if c_shape.positional generate

        at_place <= light(c_light_header.positional.low);

      else generate

        at_place <= '0';

      end generate;

      -- H, and whether the light is above the horizon.

      highlights : if g_kind = c_specular and c_shape.second generate

        constant c_sum : positive := normalized_bits(c_config, g_kind, g_light);

        signal sums : std_logic_vector(c_axes * c_sum - 1 downto 0);
        signal unit : directions_t;

        begin

          to_unit : entity work.unit_vector
            generic map (
              g_exact       => g_exact,
              g_vector_bits => c_sum
              )
            port map (
              clk        => clk,
              reset      => reset,
              enable     => flows,
              components => sums,
              unit       => unit
              );

          way : if g_exact generate

            signal both        : std_logic_vector(2 * c_axes * c_direction - 1 downto 0); -- view vector, N
            signal views       : directions_t;
            signal normals     : directions_t;
            signal horizon_dot : std_logic_vector(2 * c_direction downto 0);
            signal above       : std_logic;

            begin

              before_sum : entity work.delay_line
                generic map (
                  g_bits  => both'length,
                  g_depth => c_at.to_light
                  )
                port map (
                  clk    => clk,
                  reset  => reset,
                  enable => flows,
                  word    => in_token(view_low(c_config, c_axes) - 1 downto view_low(c_config, 0)) & normal,
                  delayed => both
                  );

              views   <= both(both'high downto views'length);
              normals <= both(normals'high downto 0);

              add : process (clk)
              begin
                if rising_edge(clk) then
                  if flows = '1' then
                    for axis in 0 to c_axes - 1 loop
                      sums((axis + 1) * c_sum - 1 downto axis * c_sum) <=
                        std_logic_vector(resize(axis_of(to_light, axis), c_sum) + axis_of(views, axis));
                    end loop;
                  end if;
                end if;
              end process;

              horizon : entity work.dot_product
                generic map (
                  g_bits => c_direction
                  )
                port map (
                  clk    => clk,
                  enable => flows,
                  a      => normals,
                  b      => to_light,
                  sum    => horizon_dot
                  );

              above <= is_positive(signed(horizon_dot));

              beside_above : entity work.delay_line
                generic map (
                  g_bits  => 1,
                  g_depth => c_at.term - c_at.to_light - c_dot_product_latency
                  )
                port map (
                  clk        => clk,
                  reset      => reset,
                  enable     => flows,
                  word(0)    => above,
                  delayed(0) => before_horizon
                  );

              half <= unit;

          else generate

            add : process (clk)
              variable low : natural;
            begin
              if rising_edge(clk) then
                if flows = '1' then
                  for axis in 0 to c_axes - 1 loop
                    low := place_low(c_config, axis);
                    sums((axis + 1) * c_sum - 1 downto axis * c_sum) <= std_logic_vector(signed(offset(g_exact,
                      resize(signed(of_light(light, c_light_axis.place, axis)), c_sum),
                      signed(in_token(low + c_vector - 1 downto low)), "0")) +
                      signed(of_light(light, c_light_axis.half, axis)));
                  end loop;
                end if;
              end if;
            end process;

            axes_half : for axis in 0 to c_axes - 1 generate

              constant c_low : natural := axis * c_direction;

              begin

                half(c_low + c_direction - 1 downto c_low) <= unit(c_low + c_direction - 1 downto c_low)
                  when at_place = '1' else of_light(light, c_light_axis.half, axis);

            end generate;

            before_horizon <= '1';

          end generate;

      elsif g_kind = c_specular generate

        axes_half : for axis in 0 to c_axes - 1 generate

          half((axis + 1) * c_direction - 1 downto axis * c_direction) <= of_light(light, c_light_axis.half, axis);

        end generate;

        before_horizon <= '1';

      else generate

        half           <= (others => '0');
        before_horizon <= '1';

      end generate;

      -- The weight.

      before_cosine : entity work.delay_line
        generic map (
          g_bits  => normal'length,
          g_depth => c_at.cosine
          )
        port map (
          clk     => clk,
          reset   => reset,
          enable  => flows,
          word    => normal,
          delayed => normal_now
          );

      opposite <= to_light when g_kind = c_diffuse else half;

      angle : entity work.dot_product
        generic map (
          g_bits => c_direction
          )
        port map (
          clk    => clk,
          enable => flows,
          a      => normal_now,
          b      => opposite,
          sum    => dot
          );

      cosine_now <= cosine(g_exact, signed(dot));

      diffuse : if g_kind = c_diffuse generate

        weights : process (clk)
        begin
          if rising_edge(clk) then
            if flows = '1' then
              raised <= cosine_weight(g_exact, cosine_now);
            end if;
          end if;
        end process;

      else generate

        constant c_low : natural := material_low(c_config) + exponent_low(c_config);

        signal exponent : std_logic_vector(c_formats.exponent.bits - 1 downto 0);

        begin

          before_power : entity work.delay_line
            generic map (
              g_bits  => exponent'length,
              g_depth => c_at.angle
              )
            port map (
              clk     => clk,
              reset   => reset,
              enable  => flows,
              word    => in_token(c_low + exponent'high downto c_low),
              delayed => exponent
              );

          power : entity work.power
            generic map (
              g_exact => g_exact
              )
            port map (
              clk      => clk,
              enable   => flows,
              base     => std_logic_vector(cosine_now),
              exponent => exponent,
              result   => raised
              );

      end generate;

      cones : if c_shape.spots generate

        signal cone_axis  : directions_t;
        signal axis_dot   : std_logic_vector(2 * c_direction downto 0);
        signal factor     : weight_t;
        signal factor_now : weight_t;
        signal raised_now : weight_t;

        begin

          axes_cone : for axis in 0 to c_axes - 1 generate

            cone_axis((axis + 1) * c_direction - 1 downto axis * c_direction) <=
              of_light(light, c_light_axis.axis, axis);

          end generate;

          from_axis : entity work.dot_product
            generic map (
              g_bits => c_direction
              )
            port map (
              clk    => clk,
              enable => flows,
              a      => to_light,
              b      => cone_axis,
              sum    => axis_dot
              );

          spot_cone : entity work.spot_cone
            generic map (
              g_exact => g_exact
              )
            port map (
              clk      => clk,
              enable   => flows,
              axis_sum => axis_dot,
              outer    => of_header(light, c_light_header.outer),
              slope    => of_header(light, c_light_header.slope),
              factor   => factor
              );

          beside_factor : entity work.delay_line
            generic map (
              g_bits  => c_weight,
              g_depth => c_at.weight - 1 - c_at.factor
              )
            port map (
              clk     => clk,
              reset   => reset,
              enable  => flows,
              word    => factor,
              delayed => factor_now
              );

          beside_raised : entity work.delay_line
            generic map (
              g_bits  => c_weight,
              g_depth => c_at.weight - 1 - c_at.raised
              )
            port map (
              clk     => clk,
              reset   => reset,
              enable  => flows,
              word    => raised,
              delayed => raised_now
              );

          narrow : process (clk)
          begin
            if rising_edge(clk) then
              if flows = '1' then
                weight <= raised_now;
                if light(c_light_header.spot.low) = '1' then
                  weight <= coned_weight(g_exact, unsigned(raised_now) * unsigned(factor_now));
                end if;
              end if;
            end if;
          end process;

      else generate

        weight <= raised;

      end generate;

      -- The term.

      last : block is
        constant c_product : positive := c_reflected + c_weight + 2;

        signal reflections : std_logic_vector(c_axes * (c_reflected + 1) - 1 downto 0);
        signal factor      : std_logic_vector(c_weight downto 0);
        signal products    : std_logic_vector(c_axes * c_product - 1 downto 0);
      begin

        factor <= '0' & weight;

        channels : for channel in 0 to c_axes - 1 generate

          constant c_low : natural := channel * (c_k + c_intensity + 2);

          begin

            reflections((channel + 1) * (c_reflected + 1) - 1 downto channel * (c_reflected + 1)) <=
              '0' & reflected(g_exact, unsigned(k_i(c_low + c_k + c_intensity - 1 downto c_low)));

            there : if channel < g_channels generate

              terms((channel + 1) * (c_reflected + c_weight) - 1 downto channel * (c_reflected + c_weight)) <=
                products(channel * c_product + c_reflected + c_weight - 1 downto channel * c_product);

            end generate;

        end generate;

        weighted : entity work.vector_multiply
          generic map (
            g_a_bits => c_reflected + 1,
            g_b_bits => c_weight + 1
            )
          port map (
            clk      => clk,
            enable   => flows,
            a        => reflections,
            b        => factor & factor & factor,
            products => products
            );

      end block;

      beside_lit : entity work.delay_line
        generic map (
          g_bits  => 1,
          g_depth => c_at.term - 1
          )
        port map (
          clk        => clk,
          reset      => reset,
          enable     => flows,
          word(0)    => lit,
          delayed(0) => lit_now
          );

      shaded <= r.valid and lit_now and before_horizon;

  end generate;

end architecture;
