-- SPDX-License-Identifier: Apache-2.0
-- The arithmetic of the shading processors in both presets, one result per lane. GHDL's simulation and its netlist must
-- be equal. Includes the constructs that the steps between RTL and Verilator rewrite.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.netlist_constructs_pkg.c_lane;
use work.netlist_constructs_pkg.c_lanes;
use work.netlist_constructs_pkg.c_stimulus;
use work.netlist_constructs_pkg.lane;
use work.netlist_constructs_pkg.lanes_t;
use work.shading_pkg.all;

entity netlist_shading is
  port (
    clk      : in  std_logic;
    reset    : in  std_logic;
    stimulus : in  std_logic_vector(c_stimulus - 1 downto 0);
    response : out std_logic_vector(c_lanes * c_lane - 1 downto 0)
  );
end entity;

architecture rtl of netlist_shading is
  constant c_bits   : positive := 24;
  constant c_filled : positive := 15;  -- clocks; more than the depth of every pipeline here

  signal a, b       : std_logic_vector(71 downto 0);
  signal control    : std_logic_vector(15 downto 0);
  signal lanes      : lanes_t;
  signal count      : unsigned(3 downto 0);
  signal filled     : std_logic;
  signal enable     : std_logic;
  signal sum        : std_logic_vector(2 * c_bits downto 0);
  signal products   : std_logic_vector(6 * c_bits - 1 downto 0);
  signal shifted    : std_logic_vector(71 downto 0);
  signal widened    : std_logic_vector(71 downto 0);
  signal narrowed   : std_logic_vector(47 downto 0);
  signal line_1     : std_logic_vector(39 downto 0);
  signal line_2     : std_logic_vector(70 downto 0);
  signal line_9     : std_logic_vector(71 downto 0);
  signal load, step : std_logic;
  signal part       : std_logic_vector(19 downto 0);
  signal part_carry : std_logic;
  signal factored   : std_logic_vector(31 downto 0);
  signal summed     : std_logic_vector(7 downto 0);
begin
  control <= stimulus(15 downto 0);
  a       <= stimulus(87 downto 16);
  b       <= stimulus(159 downto 88);
  enable  <= control(0) or control(1) or not filled;
  filled  <= '1' when count = c_filled else '0';

  fill : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        count <= (others => '0');
      elsif filled = '0' then
        count <= count + 1;
      end if;
    end if;
  end process;

  dot : entity work.dot_product
    generic map (g_bits => c_bits)
    port map (clk => clk, enable => enable, a => a, b => b, sum => sum);

  multiply : entity work.vector_multiply
    generic map (g_a_bits => c_bits, g_b_bits => c_bits)
    port map (clk => clk, enable => enable, a => a, b => b, products => products);

  shift : entity work.vector_shift
    generic map (g_vector_bits => 24, g_result_bits => 24)
    port map (clk => clk, enable => enable, components => a, shifted => shifted);

  widen : entity work.vector_shift
    generic map (g_vector_bits => 17, g_result_bits => 24)
    port map (clk => clk, enable => enable, components => b(50 downto 0), shifted => widened);

  narrow : entity work.vector_shift
    generic map (g_vector_bits => 24, g_result_bits => 16)
    port map (clk => clk, enable => enable, components => b, shifted => narrowed);

  presets : for preset in 0 to 1 generate
    constant c_exact   : boolean   := preset = 0;
    constant c_formats : formats_t := formats(c_exact);

    constant c_half    : positive  := c_formats.exponent.bits / 2;
    constant c_gentle  : positive  := c_formats.spot_slope.bits * 3 / 4;
    constant c_outer   : positive  := c_formats.direction.bits;
    constant c_low     : positive  := c_formats.direction.fraction + c_outer / 2 - 1;

    signal exponent   : std_logic_vector(c_formats.exponent.bits - 1 downto 0);
    signal base       : std_logic_vector(c_formats.direction.fraction downto 0);
    signal dot_sum    : std_logic_vector(2 * c_formats.direction.bits downto 0);
    signal reciprocal : std_logic_vector(c_formats.root.bits downto 0);
    signal result     : std_logic_vector(c_formats.weight.bits - 1 downto 0);
    signal factor     : std_logic_vector(c_formats.weight.bits - 1 downto 0);
    signal slope      : std_logic_vector(c_formats.spot_slope.bits - 1 downto 0);
    begin
      base <= '1' & (c_formats.direction.fraction - 1 downto 0 => '0') when control(5 downto 2) = "0000" else
        '0' & a(c_formats.direction.fraction - 1 downto 0);
      -- Mix in small exponents, and points near the cone's edge.
      exponent <= b(c_formats.exponent.bits - 1 downto 0) when control(6) = '1' else
        (c_half - 1 downto 0 => '0') & b(c_formats.exponent.bits - 1 downto c_half);
      dot_sum <= b(2 * c_formats.direction.bits downto 0) when control(9 downto 7) = "000" else
        std_logic_vector(resize(not (signed(a(c_outer - 1 downto c_outer / 2)) & signed(b(c_low downto 0))), dot_sum'length));

      root : entity work.reciprocal_root
        generic map (g_exact => c_exact)
        port map (clk => clk, enable => enable, square => a(c_formats.square.bits - 1 downto 0),
          reciprocal => reciprocal);

      raise : entity work.power
        generic map (g_exact => c_exact)
        port map (clk => clk, enable => enable, base => base, exponent => exponent,
          result => result);

      cone : entity work.spot_cone
        generic map (g_exact => c_exact)
        port map (clk => clk, enable => enable, axis_sum => dot_sum,
          outer => a(c_formats.direction.bits - 1 downto 0), slope => slope, factor => factor);

        -- Use gentle slopes in three of four cases. A steep slope mostly gives 0 or 1.
      slope <= a(71 downto 72 - slope'length) when b(1 downto 0) = "11" else
        (slope'length - 1 downto c_gentle => '0') & a(71 downto 72 - c_gentle);

      lanes(5 + preset)  <= lane(reciprocal);
      lanes(7 + preset)  <= lane(result);
      lanes(9 + preset)  <= lane(factor);
      lanes(14 + preset) <= lane(std_logic_vector(cosine(c_exact, signed(dot_sum))) & is_positive(signed(dot_sum)));
  end generate;

  one : entity work.delay_line
    generic map (g_bits => 40, g_depth => 1)
    port map (clk => clk, enable => enable, word => a(39 downto 0), delayed => line_1);

  two : entity work.delay_line
    generic map (g_bits => 71, g_depth => 2)
    port map (clk => clk, enable => enable, word => a(70 downto 0), delayed => line_2);

  nine : entity work.delay_line
    generic map (g_bits => 72, g_depth => 9)
    port map (clk => clk, enable => enable, word => b, delayed => line_9);

  load <= control(10) or not filled;
  step <= control(11); -- also together with load: no contract allows that, but the RTL defines the result

  interpolate : entity work.part_interpolator
    generic map (g_bits => 20)
    port map (clk => clk, load => load, start => a(19 downto 0), step => step, increment => b(19 downto 0),
      carry_in => control(12), value => part, carry_out => part_carry);

  factor_by : entity work.multiplier
    generic map (g_a_bits => 8, g_b_bits => 24)
    port map (clk => clk, enable => enable, a => a(31 downto 24), b => b(39 downto 16), product => factored);

  sum_up : entity work.saturating_sum
    generic map (g_terms => 3, g_term_bits => 18, g_fraction_bits => 11, g_result_bits => 8)
    port map (clk => clk, enable => enable, terms => a(53 downto 0), result => summed);

  lanes(0)  <= lane(sum);
  lanes(1)  <= lane(products(71 downto 0));
  lanes(2)  <= lane(products(143 downto 72));
  lanes(3)  <= lane(shifted);
  lanes(4)  <= lane(widened);
  lanes(11) <= lane(line_1);
  lanes(12) <= lane(line_2);
  lanes(13) <= lane(line_9);
  lanes(16) <= lane(narrowed);
  lanes(17) <= lane(std_logic_vector(clamped(unsigned(a), 12)) & std_logic_vector(clamped(unsigned(b(19 downto 0)), 18))
    & std_logic_vector(round_half_up(unsigned(a(20 downto 0)), 7)));
  lanes(18) <= lane(std_logic_vector(round_half_up(signed(b(40 downto 0)), 13)));
  lanes(19) <= lane(std_logic_vector(signed(a(29 downto 0)) * signed(b(17 downto 0))));
  lanes(20) <= lane(std_logic_vector(unsigned(b(32 downto 0)) * unsigned(a(33 downto 0))));

  lanes(21) <= lane(part_carry & part);
  lanes(22) <= lane(factored);
  lanes(23) <= lane(summed);

  unused : for i in 24 to c_lanes - 1 generate
    lanes(i) <= (others => '0');
  end generate;

  respond : for i in lanes'range generate
    response((i + 1) * c_lane - 1 downto i * c_lane) <= lanes(i) when filled = '1' else (others => '0');
  end generate;
end architecture;
