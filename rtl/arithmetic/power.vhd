-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     base ** exponent as 2 ** (exponent * log2(base)). The number of leading zeros of the base is the whole
--             part of the negative logarithm; a table gives the rest. The product's whole part shifts the value that a
--             second table gives for its fraction. Preset exact interpolates in both tables. Preset published reads the
--             value at the middle of a cell, and gives 1 for base 1.
-- Formats     base: 0 to 1, one whole bit and direction's fraction bits; exponent: format exponent; result: weight
-- Latency     power_latency of shading_pkg, in clocks with enable: 6, in preset published 2
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
    g_exact : boolean := true
  );
  port (
    clk      : in  std_logic;
    enable   : in  std_logic;
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
  function stages return positive is
    variable count : positive := 1;
  begin
    while 2 ** count <= c_fraction loop
      count := count + 1;
    end loop;
    return count;
  end function;

  function smaller (a, b : natural) return natural is
  begin
    if a < b then
      return a;
    end if;
    return b;
  end function;

  -- Widths of -log2(base), and of its product with the exponent.
  constant c_loss_bits      : positive := stages + c_log.fraction_bits;
  constant c_decay_fraction : positive := smaller(c_log.fraction_bits, 20);
  constant c_cut            : natural  := c_log.fraction_bits + c_formats.exponent.fraction - c_decay_fraction;
  constant c_product_bits   : positive := c_loss_bits + c_exponent - c_cut;
  constant c_whole_bits     : positive := c_product_bits - c_decay_fraction;
  -- The decay before the shift: one whole bit, and guard bits below a weight.
  constant c_guard      : positive := 2;
  constant c_decay_bits : positive := c_formats.weight.fraction + c_guard + 1;
  constant c_shifts     : positive := 5;

  subtype lead_t is unsigned(stages - 1 downto 0);
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
    for stage in stages - 1 downto 0 loop
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

  signal is_zero       : std_logic;
  signal split         : normalized_t;
  signal log_sample    : std_logic_vector(sample_bits(g_exact, c_logarithm) - 1 downto 0);
  signal decay_address : std_logic_vector(c_dec.address_bits - 1 downto 0);
  signal decay_sample  : std_logic_vector(sample_bits(g_exact, c_decay) - 1 downto 0);

begin

  assert 2 ** c_shifts > c_decay_bits
    report "power: " & to_string(c_shifts) & " stages do not shift a decay of " & to_string(c_decay_bits)
    & " bits to zero"
    severity failure;

  is_zero <= '1' when base = (base'range => '0') else '0';
  split   <= normalize(base);

  logarithms : entity work.function_rom
    generic map (
      g_exact => g_exact,
      g_which => c_logarithm
      )
    port map (
      clk     => clk,
      enable  => enable,
      address => split.mantissa(c_fraction - 1 downto c_fraction - c_log.address_bits),
      sample  => log_sample
      );

  decays : entity work.function_rom
    generic map (
      g_exact => g_exact,
      g_which => c_decay
      )
    port map (
      clk     => clk,
      enable  => enable,
      address => decay_address,
      sample  => decay_sample
      );

  interpolated : if g_exact generate

    constant c_log_rest : positive := c_fraction - c_log.address_bits;
    constant c_dec_rest : positive := c_decay_fraction - c_dec.address_bits;

    type reg_t is record
      zeros         : std_logic_vector(1 to 5);
      log_lead      : lead_t;
      log_rest      : unsigned(c_log_rest - 1 downto 0);
      log_exponent  : exponent_t;
      loss          : loss_t;
      loss_exponent : exponent_t;
      product       : product_t;
      decay_whole   : unsigned(c_whole_bits - 1 downto 0);
      decay_rest    : unsigned(c_dec_rest - 1 downto 0);
      decay         : decay_t;
      whole         : unsigned(c_whole_bits - 1 downto 0);
      result        : weight_t;
    end record;

    signal r : reg_t;

  begin

    registers : process (clk)
      variable log_part   : unsigned(c_log_rest + c_log.slope_bits - 1 downto 0);
      variable decay_part : unsigned(c_dec_rest + c_dec.slope_bits - 1 downto 0);
      variable logarithm  : unsigned(c_log.value_bits - 1 downto 0);
      variable lead       : loss_t;
      variable wide       : unsigned(c_loss_bits + c_exponent - 1 downto 0);
    begin
      if rising_edge(clk) then
        if enable = '1' then
          r.zeros <= is_zero & r.zeros(1 to 4);

          r.log_lead     <= split.lead;
          r.log_rest     <= unsigned(split.mantissa(c_log_rest - 1 downto 0));
          r.log_exponent <= unsigned(exponent);

          log_part  := unsigned(log_sample(log_sample'high downto c_log.value_bits)) * r.log_rest;
          logarithm := unsigned(log_sample(c_log.value_bits - 1 downto 0))
            + log_part(log_part'high downto c_log_rest);
          lead                                        := (others => '0');
          lead(lead'high downto c_log.fraction_bits)  := r.log_lead;
          r.loss                                      <= lead - logarithm;
          r.loss_exponent                             <= r.log_exponent;

          wide      := r.loss * r.loss_exponent;
          r.product <= wide(wide'high downto c_cut);

          r.decay_whole <= r.product(c_product_bits - 1 downto c_decay_fraction);
          r.decay_rest  <= r.product(c_dec_rest - 1 downto 0);

          decay_part := unsigned(decay_sample(decay_sample'high downto c_dec.value_bits)) * r.decay_rest;
          r.decay    <= unsigned(decay_sample(c_dec.value_bits - 1 downto 0))
            - decay_part(decay_part'high downto c_dec_rest);
          r.whole    <= r.decay_whole;

          r.result <= shifted_weight(r.decay, r.whole);
          if r.zeros(5) = '1' then
            r.result <= (others => '0');
          end if;
        end if;
      end if;
    end process;

    decay_address <= std_logic_vector(r.product(c_decay_fraction - 1 downto c_dec_rest));
    result        <= r.result;

  else generate

    -- Under the decay's lowest bit.
    constant c_low : positive := c_formats.weight.fraction + c_guard - c_dec.fraction_bits;

    type reg_t is record
      log_zero     : std_logic;
      log_one      : std_logic;
      log_lead     : lead_t;
      log_exponent : exponent_t;
      zero         : std_logic;
      one          : std_logic;
      whole        : unsigned(c_whole_bits - 1 downto 0);
    end record;

    signal r       : reg_t;
    signal loss    : loss_t;
    signal raised  : product_t;
    signal shifted : weight_t;

  begin

    lessen : process (all)
      variable lead : loss_t;
    begin
      lead                                       := (others => '0');
      lead(lead'high downto c_log.fraction_bits) := r.log_lead;
      loss                                       <= lead - unsigned(log_sample);
      if r.log_one = '1' then
        loss <= (others => '0');
      end if;
    end process;

    raised        <= loss * r.log_exponent;
    decay_address <= std_logic_vector(raised(c_decay_fraction - 1 downto c_decay_fraction - c_dec.address_bits));

    registers : process (clk)
    begin
      if rising_edge(clk) then
        if enable = '1' then
          r.log_zero     <= is_zero;
          r.log_one      <= base(c_fraction);
          r.log_lead     <= split.lead;
          r.log_exponent <= unsigned(exponent);
          r.zero         <= r.log_zero;
          r.one          <= '0';
          if raised = (raised'range => '0') then
            r.one <= '1';
          end if;
          r.whole <= raised(c_product_bits - 1 downto c_decay_fraction);
        end if;
      end if;
    end process;

    shifted <= shifted_weight('0' & unsigned(decay_sample) & (c_low - 1 downto 0 => '0'), r.whole);

    choose : process (all)
    begin
      result <= shifted;
      if r.zero = '1' then
        result <= (others => '0');
      elsif r.one = '1' then
        result           <= (others => '0');
        result(c_weight - 1) <= '1';
      end if;
    end process;

  end generate;

end architecture;
