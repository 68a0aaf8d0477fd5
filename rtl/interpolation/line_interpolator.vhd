-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A register with an adder: takes a start value, then adds an increment per step. The slices of the spherical
--             shader step their angles with it; part_interpolator is the same with a carry.
-- Formats     g_bits of two's complement throughout; sums wrap, modulo 2**g_bits
-- Latency     1 clock from load or step to value
-- Throughput  1 step per clock
-- Error       adds none; k steps carry k times the increment's rounding
-- Source      spherical paper, figure 12 (line interpolator); quadratic paper, figure 6 (each of its registers)
-- Golden twin model/golden/line_interpolator.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity line_interpolator is
  generic (
    g_bits : positive
  );
  port (
    clk       : in  std_logic;
    load      : in  std_logic; -- wins over step
    start     : in  std_logic_vector(g_bits - 1 downto 0);
    step      : in  std_logic;
    increment : in  std_logic_vector(g_bits - 1 downto 0);
    value     : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of line_interpolator is

  type reg_t is record
    value : signed(g_bits - 1 downto 0);
  end record;

  signal r : reg_t;

begin

  -- Load or add. One clocked process: a separate combinational one makes GHDL compute the sum after each change of an
  -- input, 1.6 times the instructions of a frame.
  registers : process (clk)
  begin
    if rising_edge(clk) then
      if load = '1' then
        r.value <= signed(start);
      elsif step = '1' then
        r.value <= r.value + signed(increment);
      end if;
    end if;
  end process;

  value <= std_logic_vector(r.value);

end architecture;
