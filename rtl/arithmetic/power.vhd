-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     base ** exponent as 2 ** (exponent * log2(base)). The number of leading zeros of the base is the whole
--             part of the negative logarithm; a table gives the rest. The product's whole part shifts the value that a
--             second table gives for its fraction. Preset exact interpolates in both tables. Preset published reads the
--             value at the middle of a cell, and gives 1 for base 1.
-- Formats     base: 0 to 1, one whole bit and direction's fraction bits; exponent: format exponent; result: weight
-- Latency     power_latency of shading_pkg, in clocks: 11; in preset published 7, without g_pipelined 2
-- Throughput  1 per clock
-- Error       exact 2**-15 + exponent * 2**-23; published, in steps of 1/255: 2.0 at exponent 1, 9.8 at 10, 45 at 50,
--             83 at 100, because a cell of the logarithm is 1/64 wide
-- Source      processors paper, section 3.1 (the power by a table). The logarithms are ours, because a table for all
--             exponents is too large
-- Golden twin model/golden/power.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.function_pkg.all;
use work.shading_pkg.all;

entity power is
  generic (
    g_exact     : boolean := true;
    g_pipelined : boolean := true -- preset published: with registers between the steps
  );
  port (
    clk      : in  std_logic;
    base     : in  std_logic_vector(formats(g_exact).direction.fraction downto 0);
    exponent : in  std_logic_vector(formats(g_exact).exponent.bits - 1 downto 0);
    result   : out std_logic_vector(formats(g_exact).weight.bits - 1 downto 0)
  );
end entity;

architecture rtl of power is

  constant c_formats   : formats_t         := formats(g_exact);
  constant c_log       : function_format_t := function_format(g_exact, c_logarithm);
  constant c_dec       : function_format_t := function_format(g_exact, c_decay);
  constant c_fraction  : positive          := c_formats.direction.fraction;
  constant c_exponent  : positive          := c_formats.exponent.bits;
  constant c_weight    : positive          := c_formats.weight.bits;

  -- Stages that count leading zeros. Stage i removes 2**i zeros.
  constant c_stages : positive := index_bits(c_fraction + 1);

  function smaller (a, b : natural) return natural is
  begin
    if a < b then
      return a;
    end if;
    return b;
  end function;

  -- Widths of -log2(base), and of its product with the exponent.
  constant c_loss_bits      : positive := c_stages + c_log.fraction_bits;
  constant c_decay_fraction : positive := smaller(c_log.fraction_bits, 20);
  constant c_cut_bits       : natural  := c_log.fraction_bits + c_formats.exponent.fraction - c_decay_fraction;
  constant c_product_bits   : positive := c_loss_bits + c_exponent - c_cut_bits;
  constant c_whole_bits     : positive := c_product_bits - c_decay_fraction;
  -- The decay before the shift: one whole bit, and guard bits below a weight.
  constant c_guard      : positive := 2;
  constant c_decay_bits : positive := c_formats.weight.fraction + c_guard + 1;
  constant c_shifts     : positive := 5;

  subtype lead_t is unsigned(c_stages - 1 downto 0);
  subtype loss_t is unsigned(c_loss_bits - 1 downto 0);
  subtype product_t is unsigned(c_product_bits - 1 downto 0);
  subtype decay_t is unsigned(c_decay_bits - 1 downto 0);
  subtype weight_t is std_logic_vector(c_weight - 1 downto 0);
  subtype exponent_t is unsigned(c_exponent - 1 downto 0);

  type normalized_t is record
    lead     : lead_t;
    mantissa : std_logic_vector(c_fraction - 1 downto 0);
  end record;

  -- Remove the leading zeros of the base and the one that follows them.
  function normalize (word : std_logic_vector(c_fraction downto 0)) return normalized_t is
    constant c_zeros  : std_logic_vector(c_fraction downto 0) := (others => '0');

    variable shifted : std_logic_vector(c_fraction downto 0) := word;
    variable lead    : lead_t                                := (others => '0');
  begin
    for stage in lead_t'range loop
      if shifted(c_fraction downto c_fraction - 2 ** stage + 1) = c_zeros(2 ** stage - 1 downto 0) then
        shifted     := shifted(c_fraction - 2 ** stage downto 0) & c_zeros(2 ** stage - 1 downto 0);
        lead(stage) := '1';
      end if;
    end loop;
    return (lead, shifted(c_fraction - 1 downto 0));
  end function;

  -- Shift the decay right by the product's whole part, and round half up.
  function shifted_weight (decay : decay_t; whole : unsigned(c_whole_bits - 1 downto 0)) return weight_t is
    constant c_zeros  : unsigned(c_whole_bits + c_decay_bits - 1 downto 0) := (others => '0');

    variable shifted : decay_t := decay;
  begin
    for stage in 0 to c_shifts - 1 loop
      if whole(stage) = '1' then
        if 2 ** stage < c_decay_bits then
          shifted := c_zeros(2 ** stage - 1 downto 0) & shifted(c_decay_bits - 1 downto 2 ** stage);
        else
          shifted := (others => '0');
        end if;
      end if;
    end loop;
    if whole(c_whole_bits - 1 downto c_shifts) /= c_zeros(c_whole_bits - 1 downto c_shifts) then
      shifted := (others => '0');
    end if;
    return std_logic_vector(shifted(c_decay_bits - 1 downto c_guard) + shifted(c_guard - 1 downto c_guard - 1));
  end function;

  -- Clocks for each cut between two steps.
  constant c_cut : natural := boolean'pos(g_exact or g_pipelined);

  -- A base of 1 has no leading zero. A base of 0 is marked.
  signal cut_base : std_logic_vector(base'range);
  signal normal   : normalized_t;
  signal split    : std_logic_vector(c_fraction + c_stages downto 0); -- from the lowest: mantissa, zeros, mark
  signal marked   : std_logic_vector(c_stages downto 0);              -- zeros, mark

  -- Of the base of log_sample.
  signal lead             : lead_t;
  signal zero             : std_logic;
  signal waiting_exponent : std_logic_vector(exponent'range);

  signal log_sample    : std_logic_vector(sample_bits(g_exact, c_logarithm) - 1 downto 0);
  signal decay_address : std_logic_vector(c_dec.cell_bits - 1 downto 0);
  signal decay_sample  : std_logic_vector(sample_bits(g_exact, c_decay) - 1 downto 0);

begin

  assert 2 ** c_shifts > c_decay_bits
    report "power: " & to_string(c_shifts) & " stages do not shift a decay of " & to_string(c_decay_bits)
    & " bits to zero"
    severity failure;

  first_cut : entity work.delay_line
    generic map (
      g_bits  => base'length,
      g_depth => c_cut
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => base,
      delayed => cut_base
      );

  normal <= normalize(cut_base);

  second_cut : entity work.delay_line
    generic map (
      g_bits  => split'length,
      g_depth => c_cut
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => not (or cut_base) & std_logic_vector(normal.lead) & normal.mantissa,
      delayed => split
      );

  logarithms : entity work.function_rom
    generic map (
      g_exact => g_exact,
      g_which => c_logarithm
      )
    port map (
      clk     => clk,
      enable  => '1',
      address => split(c_fraction - 1 downto c_fraction - c_log.cell_bits),
      sample  => log_sample
      );

  align_zeros : entity work.delay_line
    generic map (
      g_bits  => marked'length,
      g_depth => 1
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => split(split'high downto c_fraction),
      delayed => marked
      );

  lead <= unsigned(marked(lead'range));
  zero <= marked(marked'high);

  align_exponent : entity work.delay_line
    generic map (
      g_bits  => exponent'length,
      g_depth => 2 * c_cut + 1
      )
    port map (
      clk     => clk,
      enable  => '1',
      word    => exponent,
      delayed => waiting_exponent
      );

  decays : entity work.function_rom
    generic map (
      g_exact => g_exact,
      g_which => c_decay
      )
    port map (
      clk     => clk,
      enable  => '1',
      address => decay_address,
      sample  => decay_sample
      );

  interpolated : if g_exact generate

    constant c_log_rest : positive := c_fraction - c_log.cell_bits;
    constant c_dec_rest : positive := c_decay_fraction - c_dec.cell_bits;

    subtype log_value_t is unsigned(c_log.value_bits - 1 downto 0);
    subtype dec_value_t is unsigned(c_dec.value_bits - 1 downto 0);

    type wholes_t is array (natural range <>) of unsigned(c_whole_bits - 1 downto 0);

    type exponents_t is array (natural range <>) of exponent_t;

    -- Element i of an array is valid i clocks after the inputs. The other fields are valid in the clock in which they are
    -- read.
    type reg_t is record
      log_rest  : std_logic_vector(c_log_rest - 1 downto 0);
      lead      : lead_t;
      log_value : log_value_t;
      loss      : loss_t;
      exponents : exponents_t(4 to 5);
      zeros     : std_logic_vector(4 to 10);
      dec_rest  : std_logic_vector(c_dec_rest - 1 downto 0);
      dec_value : dec_value_t;
      wholes    : wholes_t(8 to 10);
      decay     : decay_t;
      result    : weight_t;
    end record;

    signal r : reg_t;

    signal log_part : std_logic_vector(c_log_rest + c_log.slope_bits + 1 downto 0);
    signal wide     : std_logic_vector(c_loss_bits + c_exponent + 1 downto 0);
    signal product  : product_t;
    signal dec_part : std_logic_vector(c_dec_rest + c_dec.slope_bits + 1 downto 0);

  begin

    multiply_slope : entity work.signed_multiplier
      generic map (
        g_a_bits => c_log.slope_bits + 1,
        g_b_bits => c_log_rest + 1,
        g_clocks => 1
        )
      port map (
        clk     => clk,
        a       => '0' & log_sample(log_sample'high downto c_log.value_bits),
        b       => '0' & r.log_rest,
        product => log_part
        );

    multiply_loss : entity work.signed_multiplier
      generic map (
        g_a_bits => c_loss_bits + 1,
        g_b_bits => c_exponent + 1,
        g_clocks => 2
        )
      port map (
        clk     => clk,
        a       => '0' & std_logic_vector(r.loss),
        b       => '0' & std_logic_vector(r.exponents(5)),
        product => wide
        );

    product       <= unsigned(wide(c_loss_bits + c_exponent - 1 downto c_cut_bits));
    decay_address <= std_logic_vector(product(c_decay_fraction - 1 downto c_dec_rest));

    multiply_decay : entity work.signed_multiplier
      generic map (
        g_a_bits => c_dec.slope_bits + 1,
        g_b_bits => c_dec_rest + 1,
        g_clocks => 1
        )
      port map (
        clk     => clk,
        a       => '0' & decay_sample(decay_sample'high downto c_dec.value_bits),
        b       => '0' & r.dec_rest,
        product => dec_part
        );

    registers : process (clk)
      variable leading : loss_t; -- the number of leading zeros
    begin
      if rising_edge(clk) then
        r.zeros     <= zero & r.zeros(4 to 9);
        r.exponents <= unsigned(waiting_exponent) & r.exponents(4);

        r.wholes(9 to 10) <= r.wholes(8 to 9);
        r.wholes(8)       <= product(c_product_bits - 1 downto c_decay_fraction);

        r.log_rest  <= split(r.log_rest'range);
        r.lead      <= lead;
        r.log_value <= unsigned(log_sample(c_log.value_bits - 1 downto 0));

        leading                                          := (others => '0');
        leading(leading'high downto c_log.fraction_bits) := r.lead;
        r.loss                                           <= leading
          - (r.log_value + unsigned(log_part(c_log_rest + c_log.slope_bits - 1 downto c_log_rest)));

        r.dec_rest  <= std_logic_vector(product(c_dec_rest - 1 downto 0));
        r.dec_value <= unsigned(decay_sample(c_dec.value_bits - 1 downto 0));
        r.decay     <= r.dec_value - unsigned(dec_part(c_dec_rest + c_dec.slope_bits - 1 downto c_dec_rest));

        r.result <= shifted_weight(r.decay, r.wholes(10));
        if r.zeros(10) = '1' then
          r.result <= (others => '0');
        end if;
      end if;
    end process;

    result <= r.result;

  else generate

    -- Under the decay's lowest bit.
    constant c_low : positive := c_formats.weight.fraction + c_guard - c_dec.fraction_bits;

    subtype loss_word_t is std_logic_vector(c_loss_bits + c_exponent downto 0);
    subtype raised_word_t is std_logic_vector(c_product_bits downto 0);

    type reg_t is record
      zero  : std_logic;
      one   : std_logic;
      whole : unsigned(c_whole_bits - 1 downto 0);
    end record;

    signal r : reg_t;

    signal loss        : loss_t;
    signal loss_cut    : loss_word_t;   -- base is 0, exponent, loss
    signal raised      : product_t;
    signal raised_cut  : raised_word_t; -- base is 0, product
    signal raised_now  : product_t;
    signal weight      : weight_t;

  begin

    lessen : process (all)
      variable leading : loss_t; -- the number of leading zeros
    begin
      leading                                          := (others => '0');
      leading(leading'high downto c_log.fraction_bits) := lead;
      loss                                             <= leading - unsigned(log_sample);
      if lead = 0 then
        loss <= (others => '0');
      end if;
    end process;

    third_cut : entity work.delay_line
      generic map (
        g_bits  => loss_cut'length,
        g_depth => c_cut
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => zero & waiting_exponent & std_logic_vector(loss),
        delayed => loss_cut
        );

    raised <= unsigned(loss_cut(c_loss_bits - 1 downto 0))
      * unsigned(loss_cut(c_loss_bits + c_exponent - 1 downto c_loss_bits));

    fourth_cut : entity work.delay_line
      generic map (
        g_bits  => raised_cut'length,
        g_depth => c_cut
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => loss_cut(loss_cut'high) & std_logic_vector(raised),
        delayed => raised_cut
        );

    raised_now    <= unsigned(raised_cut(product_t'range));
    decay_address <= std_logic_vector(raised_now(c_decay_fraction - 1 downto c_decay_fraction - c_dec.cell_bits));

    registers : process (clk)
    begin
      if rising_edge(clk) then
        r.zero  <= raised_cut(raised_cut'high);
        r.one   <= '0';
        if raised_now = (raised_now'range => '0') then
          r.one <= '1';
        end if;
        r.whole <= raised_now(c_product_bits - 1 downto c_decay_fraction);
      end if;
    end process;

    choose : process (all)
    begin
      weight <= shifted_weight('0' & unsigned(decay_sample) & (c_low - 1 downto 0 => '0'), r.whole);
      if r.zero = '1' then
        weight <= (others => '0');
      elsif r.one = '1' then
        weight               <= (others => '0');
        weight(c_weight - 1) <= '1';
      end if;
    end process;

    last_cut : entity work.delay_line
      generic map (
        g_bits  => weight'length,
        g_depth => c_cut
        )
      port map (
        clk     => clk,
        enable  => '1',
        word    => weight,
        delayed => result
        );

  end generate;

end architecture;
