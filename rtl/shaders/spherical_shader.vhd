-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The spherical shader: one header per triangle and one record per line in, one fragment per covered pixel
--             out.
--               stream_register -> triangle_walker -> z_interpolator, ambient_light and a spherical_light per light
--               -> colour_sum -> stream_queue
--             Only the walker waits when fragments are not taken. The stages after it never stall: the queue has a
--             place for every pixel that the walker has started.
--             Hardware that no effect needs does not exist: there are no lights without diffuse light and highlights,
--             and no line records if no light has a part in them.
-- Contract    Both streams are valid/ready; a fragment does not change while it waits. A triangle's header (walk,
--             depth, ambient) is followed by one record for every line of its walk, also for lines without a pixel.
--             spherical_pkg gives the positions of the lights' parts. With one channel (g_channels = 1) red, green and
--             blue are equal.
-- Formats     formats_pkg: init (header), ambient, diffuse, specular, depth, colour
-- Latency     11 clocks from a header taken to the triangle's first fragment, if its first line covers a pixel
-- Throughput  1 fragment per clock, with no bubble between spans and lines. With line records, two clocks are lost
--             between triangles if the last span has a single pixel, and one if it has two. Without line records, one
--             clock is lost after a triangle of a single pixel. A line without a pixel costs one clock if no span is
--             drawn meanwhile
-- Error       the sum of the terms is exact and rounded once; for factors and samples see formats_pkg and cosine_rom
-- Source      spherical paper, section 4 and figure 12
-- Golden twin model/golden/spherical_shader.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.cosine_pkg.all;
use work.spherical_pkg.all;

entity spherical_shader is
  generic (
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_lights             : natural  := 1;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := g_channels; -- 1: highlights are grey, with one multiplier per light
    g_powers             : natural  := 2; -- bit i: the table of cosine to the power 2**i exists
    g_cosine             : cosine_t := default_cosine(g_exact);
    g_multiplier_bits    : natural  := 0 -- width of the device's multipliers; 0: products in lookup tables
  );
  port (
    clk               : in  std_logic;
    reset             : in  std_logic;
    init_valid        : in  std_logic;
    init_ready        : out std_logic;
    init_data         : in  std_logic_vector(init_bits(g_exact, g_channels, g_lights, g_diffuse, g_specular,
      g_highlight_channels) - 1 downto 0);
    fragment_valid    : out std_logic;
    fragment_ready    : in  std_logic;
    fragment_triangle : out std_logic_vector(formats(g_exact).triangle.bits - 1 downto 0);
    fragment_y        : out std_logic_vector(formats(g_exact).pixel_y.bits - 1 downto 0);
    fragment_x        : out std_logic_vector(formats(g_exact).pixel_x.bits - 1 downto 0);
    fragment_z        : out std_logic_vector(formats(g_exact).depth.bits - 1 downto 0);
    fragment_red      : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_green    : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    fragment_blue     : out std_logic_vector(formats(g_exact).colour.bits - 1 downto 0);
    busy              : out std_logic; -- a vector or a fragment is inside
    fault             : out std_logic -- always '0'
  );
end entity;

architecture rtl of spherical_shader is

  constant c_formats     : formats_t := formats(g_exact);
  constant c_walk_bits   : positive  := init_bits(g_exact, 0); -- of the header: walk and depth
  constant c_header_bits : positive  := c_walk_bits + ambient_bits(g_exact, g_channels);

  -- Lights with a part in the line records.
  constant c_lights     : natural := g_lights * boolean'pos(g_diffuse or g_specular);
  constant c_light_bits : natural := light_part_bits(g_exact, g_channels, g_diffuse, g_specular, g_highlight_channels);
  constant c_records    : boolean := c_lights > 0;

  -- Groups of terms, with a term per channel: ambient, then for each light its diffuse and its specular products.
  constant c_light_groups : natural  := light_terms(g_diffuse, g_specular);
  constant c_groups       : positive := 1 + c_lights * c_light_groups;
  constant c_data_bits    : positive := data_bits(g_cosine); -- of a sample
  constant c_group_bits   : positive := g_channels * term_bits(g_exact, c_data_bits);

  -- Clocks after the span stage: samples, products (three clocks), sums.
  constant c_sampled    : positive := 1;
  constant c_multiplied : positive := 4;
  constant c_summed     : positive := 5;

  -- Parts of the depth's skewed words (skew_pkg). A pixel's depth is valid as many clocks after the span stage,
  -- at most the 2 that the header of its vector stays.
  constant c_depth : integer range 1 to 2 := 2;

  subtype position_t is std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length - 1 downto 0);
  subtype depth_t    is std_logic_vector(c_formats.depth.bits - 1 downto 0);
  subtype fragment_t is std_logic_vector(position_t'length + depth_t'length + 3 * c_formats.colour.bits - 1 downto 0);

  type reg_t is record
    filled       : std_logic_vector(1 to c_summed); -- a pixel, index clocks after the span stage
    line_load    : std_logic;
    line_step    : std_logic;
    line_carry   : std_logic;
    span_load    : std_logic;
    span_advance : std_logic; -- a step without a load
  end record;

  signal r, r_next : reg_t;

  signal init                       : std_logic_vector(init_data'range);
  signal buffer_valid, buffer_ready : std_logic; -- of the init buffer
  signal header_valid, header_ready : std_logic;
  signal line_ready, line_held      : std_logic;
  signal line_load, line_step       : std_logic;
  signal header_load                : std_logic; -- load the triangle's header, with line_load or before
  signal line_carry                 : std_logic;
  signal span_load, span_step       : std_logic;
  signal y                          : std_logic_vector(fragment_y'range);
  signal x                          : std_logic_vector(c_formats.span_x.bits - 1 downto 0);
  signal triangle                   : std_logic_vector(fragment_triangle'range);
  signal header                     : std_logic_vector(c_header_bits - 1 downto 0); -- of the triangle of the line stage
  signal z                          : std_logic_vector(c_formats.depth_sum.bits - 1 downto 0);
  signal walking                    : std_logic;
  signal room, queued               : std_logic;
  signal span_position, position    : position_t; -- at the span stage, with the colours
  signal span_depth, depth_word     : depth_t;    -- c_depth clocks after the span stage, with the colours
  signal terms                      : std_logic_vector(c_groups * c_group_bits - 1 downto 0);
  signal colours                    : std_logic_vector(3 * c_formats.colour.bits - 1 downto 0); -- red lowest
  signal pixel_valid                : std_logic;
  signal pixel, fragment            : fragment_t;

begin

  assert c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction = c_formats.depth.bits
    report "spherical_shader: depth_sum has "
    & integer'image(c_formats.depth_sum.bits - 1 - c_formats.depth_sum.fraction) & " whole bits, depth " & integer'image(c_formats.depth.bits)
    severity failure;

  init_buffer : entity work.stream_register
    generic map (g_bits => init_data'length, g_eager => true)
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => init_valid,
      in_ready  => init_ready,
      in_data   => init_data,
      out_valid => buffer_valid,
      out_ready => buffer_ready,
      out_data  => init
      );

  walker : entity work.triangle_walker
    generic map (g_exact => g_exact)
    port map (
      clk            => clk,
      reset          => reset,
      init_valid     => header_valid,
      init_ready     => header_ready,
      init           => init(c_walk_bits - 1 downto 0),
      line_ready     => line_ready,
      line_held      => line_held,
      line_load      => line_load,
      line_step      => line_step,
      line_carry     => line_carry,
      span_load      => span_load,
      span_step      => span_step,
      fragment_ready => room,
      triangle       => triangle,
      y              => y,
      x              => x,
      busy           => walking
      );

    -- If the line stage holds a line, the vector in the init buffer is that line's record; otherwise it is a header.
    -- Without records every vector is a header.
  header_valid <= buffer_valid and not line_held when c_records else buffer_valid;
  line_ready   <= buffer_valid when c_records else '1';
  buffer_ready <= line_step or line_load when c_records else line_load;
  header_load  <= not line_held when c_records else line_load;

  combinational : process (all)
    variable v : reg_t;
  begin
    v.filled       := span_step & r.filled(1 to c_summed - 1);
    v.line_load    := line_load;
    v.line_step    := line_step and not line_load;
    v.line_carry   := line_carry;
    v.span_load    := span_load;
    v.span_advance := span_step and not span_load;
    if reset = '1' then
      v.filled := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Keep the header: a record may replace it in the init buffer immediately. Load while no line is held, when only
  -- headers arrive.
  header_register : entity work.parameter_register
    generic map (g_bits => c_header_bits)
    port map (clk => clk, load => header_load, start => init(c_header_bits - 1 downto 0), value => header);

  depth : entity work.z_interpolator
    generic map (g_exact => g_exact, g_parts => c_depth)
    port map (
      clk        => clk,
      init       => header(c_walk_bits - 1 downto 0),
      line_load  => r.line_load,
      line_step  => r.line_step,
      line_carry => r.line_carry,
      span_load  => r.span_load,
      span_step  => r.span_advance,
      value      => z
      );

  ambient : entity work.ambient_light
    generic map (g_exact => g_exact, g_channels => g_channels, g_data_bits => c_data_bits, g_depth => c_multiplied)
    port map (
      clk       => clk,
      ambient   => header(c_header_bits - 1 downto c_walk_bits),
      span_load => span_load,
      terms     => terms(c_group_bits - 1 downto 0)
      );

  lights : for number in 0 to c_lights - 1 generate

    constant c_first : positive := 1 + number * c_light_groups; -- of its terms

  begin

    -- Step the slices whenever the walker may step, with or without a pixel, so that a register enables them.
    -- r.filled marks the clocks with a pixel.
    light : entity work.spherical_light
      generic map (
        g_exact              => g_exact,
        g_channels           => g_channels,
        g_diffuse            => g_diffuse,
        g_specular           => g_specular,
        g_highlight_channels => g_highlight_channels,
        g_powers             => g_powers,
        g_cosine             => g_cosine,
        g_multiplier_bits    => g_multiplier_bits
        )
      port map (
        clk         => clk,
        part        => init((number + 1) * c_light_bits - 1 downto number * c_light_bits),
        span_load   => span_load,
        span_step   => room,
        sample_step => r.filled(c_sampled),
        terms       => terms((c_first + c_light_groups) * c_group_bits - 1 downto c_first * c_group_bits)
        );

  end generate;

  sum : entity work.colour_sum
    generic map (g_exact => g_exact, g_channels => g_channels, g_terms => c_groups, g_data_bits => c_data_bits)
    port map (
      clk     => clk,
      enable  => r.filled(c_multiplied),
      terms   => terms,
      colours => colours
      );

    -- Delay position and depth to the clock of the colours.
  span_position <= triangle & y & x(fragment_x'range);
  span_depth    <= z(c_formats.depth_sum.bits - 2 downto c_formats.depth_sum.fraction);

  align_position : entity work.delay_line
    generic map (g_bits => position_t'length, g_depth => c_summed)
    port map (clk => clk, enable => '1', word => span_position, delayed => position);

  align_depth : entity work.delay_line
    generic map (g_bits => depth_t'length, g_depth => c_summed - c_depth)
    port map (clk => clk, enable => '1', word => span_depth, delayed => depth_word);

  pixel_valid <= r.filled(c_summed);
  pixel       <= colours & depth_word & position;

  -- A pixel arrives five clocks after its claim, so seven places are not sufficient.
  queue : entity work.stream_queue
    generic map (g_bits => pixel'length, g_index_bits => 4)
    port map (
      clk       => clk,
      reset     => reset,
      claim     => span_step,
      room      => room,
      pending   => queued,
      in_valid  => pixel_valid,
      in_data   => pixel,
      out_valid => fragment_valid,
      out_ready => fragment_ready,
      out_data  => fragment
      );

  (fragment_blue, fragment_green, fragment_red, fragment_z, fragment_triangle, fragment_y, fragment_x) <= fragment;

  busy  <= buffer_valid or walking or queued;
  fault <= '0';

end architecture;
