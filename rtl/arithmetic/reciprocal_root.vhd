-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     1 / sqrt(square), by which a vector is multiplied to become a unit vector. Between 1 and 4 a table gives
--             the value at the middle of each cell, with as many cells from 1 to 2 as from 2 to 4. Preset exact adds a
--             Newton step, y = T (3 - x T**2) / 2. Below 1 the result is twice that for 4 square.
-- Formats     square: format square, 1/4 to 4 (0 also gives a number); reciprocal: format root with one more whole bit
-- Latency     reciprocal_root_latency of shading_pkg, in clocks: 7 with the Newton step, otherwise 1. The
--             clocks: T; T**2; two for x T**2; 3 - x T**2; two for the last product
-- Throughput  1 per clock
-- Error       relative: 2**-19.7 exact, 2**-6.89 published. The length of a unit vector is within 2**-19.4, or
--             2**-6.86, of 1
-- Source      processors paper, section 3.3 and figure 2 (1/sqrt by a table); the Newton step is ours
-- Golden twin model/golden/reciprocal_root.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.function_pkg.all;
use work.shading_pkg.all;

entity reciprocal_root is
  generic (
    g_exact : boolean := true
  );
  port (
    clk        : in  std_logic;
    square     : in  std_logic_vector(formats(g_exact).square.bits - 1 downto 0);
    reciprocal : out std_logic_vector(formats(g_exact).root.bits downto 0)
  );
end entity;

architecture rtl of reciprocal_root is

  constant c_formats  : formats_t := formats(g_exact);
  constant c_high     : natural   := c_formats.square.bits - 1;
  constant c_fraction : natural   := c_formats.square.fraction;
  constant c_address  : natural   := function_format(g_exact, c_reciprocal_root).cell_bits;

  signal below_one  : std_logic;
  signal x          : std_logic_vector(square'range);
  signal address    : std_logic_vector(c_address - 1 downto 0);
  signal entry      : std_logic_vector(sample_bits(g_exact, c_reciprocal_root) - 1 downto 0);
  signal root       : std_logic_vector(c_formats.root.bits - 1 downto 0); -- of x
  signal root_below : std_logic; -- below_one, with the root

begin

  below_one <= '1' when square(c_high downto c_fraction) = (c_high downto c_fraction => '0') else '0';
  x     <= square(c_high - 2 downto 0) & "00" when below_one = '1' else square;

  -- Use the bits below the highest one that is set, of weight 2 or of weight 1.
  address <= '1' & x(c_high - 1 downto c_high - c_address + 1) when x(c_high) = '1' else
    '0' & x(c_high - 2 downto c_high - c_address);

  rom : entity work.function_rom
    generic map (
      g_exact => g_exact,
      g_which => c_reciprocal_root
      )
    port map (
      clk     => clk,
      enable  => '1',
      address => address,
      sample  => entry
      );

  align_below : entity work.delay_line
    generic map (
      g_bits  => 1,
      g_depth => reciprocal_root_latency(g_exact)
      )
    port map (
      clk        => clk,
      enable     => '1',
      word(0)    => below_one,
      delayed(0) => root_below
      );

  reciprocal <= root & '0' when root_below = '1' else '0' & root;

  newton : if c_formats.root.fraction > c_formats.root_entry.fraction generate

    constant c_x_bits        : positive := 24; -- 2 of them whole
    constant c_x_fraction    : positive := c_x_bits - 2;
    constant c_rest_bits     : positive := 25; -- 2 of them whole
    constant c_rest_fraction : positive := c_rest_bits - 2;
    constant c_entry_bits    : positive := c_formats.root_entry.bits;
    constant c_square_bits   : positive := 2 * c_entry_bits;
    constant c_cut           : natural  := c_x_fraction + c_square_bits - c_rest_fraction; -- bits cut from x T**2
    -- The Newton step is below the root by up to 3/2 of the entry's error squared. Add half of that.
    constant c_raised : natural                            := 3 * 2 ** c_rest_fraction + root_raise(g_exact);
    constant c_three  : unsigned(c_rest_bits - 1 downto 0) := to_unsigned(c_raised, c_rest_bits);
    -- The lowest bit of the root in T (3 - x T**2), which is twice the root.
    constant c_root_low : natural := c_entry_bits + c_rest_fraction + 1 - c_formats.root.fraction;

    signal waiting_x     : std_logic_vector(c_x_bits - 1 downto 0);     -- with T**2
    signal waiting_entry : std_logic_vector(c_entry_bits - 1 downto 0); -- with the rest
    signal entry_square  : std_logic_vector(c_square_bits + 1 downto 0);
    signal x_square      : std_logic_vector(c_x_bits + c_square_bits + 1 downto 0);
    signal rest          : std_logic_vector(c_rest_bits - 1 downto 0);
    signal twice         : std_logic_vector(c_entry_bits + c_rest_bits + 1 downto 0);

  begin

    align_x : entity work.delay_line
      generic map (
        g_bits  => c_x_bits,
        g_depth => 2
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => x(c_high downto c_high - c_x_bits + 1),
        delayed => waiting_x
        );

    square_entry : entity work.signed_multiplier
      generic map (
        g_a_bits => c_entry_bits + 1,
        g_b_bits => c_entry_bits + 1,
        g_clocks => 1
        )
      port map (
        clk     => clk,
        a       => '0' & entry,
        b       => '0' & entry,
        product => entry_square
        );

    multiply_x : entity work.signed_multiplier
      generic map (
        g_a_bits => c_x_bits + 1,
        g_b_bits => c_square_bits + 1,
        g_clocks => 2
        )
      port map (
        clk     => clk,
        a       => '0' & waiting_x,
        b       => entry_square(c_square_bits downto 0),
        product => x_square
        );

    subtract : process (clk)
      variable difference : unsigned(c_x_bits + c_square_bits - 1 downto 0);
    begin
      if rising_edge(clk) then
        difference := (c_three & (c_cut - 1 downto 0 => '0')) - unsigned(x_square(difference'range));
        rest       <= std_logic_vector(difference(difference'high downto c_cut));
      end if;
    end process;

    align_entry : entity work.delay_line
      generic map (
        g_bits  => c_entry_bits,
        g_depth => 4
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => entry,
        delayed => waiting_entry
        );

    multiply_entry : entity work.signed_multiplier
      generic map (
        g_a_bits => c_entry_bits + 1,
        g_b_bits => c_rest_bits + 1,
        g_clocks => 2
        )
      port map (
        clk     => clk,
        a       => '0' & waiting_entry,
        b       => '0' & rest,
        product => twice
        );

    root <= twice(c_root_low + root'high downto c_root_low);

  else generate

    root <= entry;

  end generate;

end architecture;
