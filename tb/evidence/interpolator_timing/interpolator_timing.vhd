-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The published specular slice with its delays: the line interpolator (adder, multiplexer, register),
--             followed by ROM and multiplier. Behavioural and not synthesizable: rtl/ describes the hardware, this
--             model shows its timing.
-- Contract    At a rising edge of step the register loads start if init = '1', else the sum. product belongs to the
--             angle in the register and is valid at the next step.
-- Formats     angle and slope s0.11, where 1.0 is half a bell; sums wrap. ra is the upper six bits of the angle. factor
--             u8, sample u6, product u14. factor has eight bits because the byte of one colour is sufficient here.
-- Delays      Published, for an XCV300-6: multiplexer 5 ns, adder 10 ns, register 5 ns, one step every 60 ns.
--             Not published: ROM and multiplier. 55 ns of a step remain for them after the register; the testbench
--             assumes 15 ns and 35 ns.
--             Stage 1, from step to multiplexer: register + adder + multiplexer. Stage 2, from step to product:
--             register + ROM + multiplier. Both stages start with the register, so they overlap. The longer stage is
--             the lower bound of the step.
-- Source      spherical paper, figure 12 (the slice) and figure 17 (its timing)
-- Golden twin none; tb/evidence/interpolator_timing/interpolator_timing_tb.vhd computes the expected values

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.cosine_pkg.all;

entity interpolator_timing is
  generic (
    g_mux_delay        : delay_length;
    g_adder_delay      : delay_length;
    g_register_delay   : delay_length;
    g_rom_delay        : delay_length;
    g_multiplier_delay : delay_length
  );
  port (
    init       : in  std_logic;
    step       : in  std_logic;
    start      : in  std_logic_vector(11 downto 0);
    slope      : in  std_logic_vector(11 downto 0);
    factor     : in  std_logic_vector(7 downto 0);
    sum        : out std_logic_vector(11 downto 0); -- adder
    next_angle : out std_logic_vector(11 downto 0); -- multiplexer
    angle      : out std_logic_vector(11 downto 0); -- register
    ra         : out std_logic_vector(5 downto 0);
    sample     : out std_logic_vector(5 downto 0);  -- ROM
    product    : out std_logic_vector(13 downto 0)
  );
end entity;

architecture behaviour of interpolator_timing is

  constant c_bell : cosine_table_t(0 to 2 ** ra'length - 1) :=
    cosine_table(exact => false, power => 2, address_bits => ra'length, data_bits => sample'length);

begin

  sum        <= std_logic_vector(unsigned(angle) + unsigned(slope)) after g_adder_delay;
  next_angle <= start after g_mux_delay when init = '1' else sum after g_mux_delay;

  registers : process (step) is
  begin
    if rising_edge(step) then
      angle <= next_angle after g_register_delay;
    end if;
  end process;

  ra <= angle(angle'high downto angle'high - ra'length + 1);

  rom : process (ra) is
  begin
    if is_x(ra) then
      sample <= (others => 'X') after g_rom_delay;
    else
      sample <= std_logic_vector(to_unsigned(c_bell(to_integer(unsigned(ra))), sample'length)) after g_rom_delay;
    end if;
  end process;

  product <= std_logic_vector(unsigned(factor) * unsigned(sample)) after g_multiplier_delay;

end architecture;
