-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A table of 1/sqrt(x), log2(x) or 2**-x. If the function is interpolated, a sample is the value at the start of
--             its cell and, above it, the slope: the difference to the value at the cell's end. Otherwise a sample
--             is the value at the middle of its cell.
-- Formats     sample: slope_bits above value_bits, both unsigned; function_pkg
-- Latency     1 clock from an address with enable to its sample
-- Throughput  1 sample per clock
-- Error       half a step of the value at its argument; for the error over a cell see function_pkg
-- Source      processors paper, figures 1 and 2: the tables of x**m and of 1/sqrt(x)
-- Golden twin model/golden/function_rom.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.function_pkg.all;
use work.shading_pkg.all;

entity function_rom is
  generic (
    g_exact : boolean := true;
    g_which : natural := c_reciprocal_root
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    address : in  std_logic_vector(function_format(g_exact, g_which).cell_bits - 1 downto 0);
    sample  : out std_logic_vector(sample_bits(g_exact, g_which) - 1 downto 0)
  );
end entity;

architecture rtl of function_rom is

  constant c_format : function_format_t := function_format(g_exact, g_which);

  subtype sample_t is std_logic_vector(sample_bits(g_exact, g_which) - 1 downto 0);

  -- A descending range: for an ascending one GHDL's netlist subtracts the address from the last index.
  type rom_t is array (2 ** c_format.cell_bits - 1 downto 0) of sample_t;

  function entries return rom_t is
    constant c_table : function_table_t := function_table(g_exact, g_which);

    variable rom   : rom_t;
    variable slope : natural;
  begin
    for i in rom'range loop
      rom(i)(c_format.value_bits - 1 downto 0) := std_logic_vector(to_unsigned(c_table(i), c_format.value_bits));
      if c_format.slope_bits > 0 then
        if c_table(i + 1) > c_table(i) then
          slope := c_table(i + 1) - c_table(i);
        else
          slope := c_table(i) - c_table(i + 1);
        end if;
        rom(i)(sample_t'high downto c_format.value_bits) := std_logic_vector(to_unsigned(slope, c_format.slope_bits));
      end if;
    end loop;
    return rom;
  end function;

  constant c_rom : rom_t := entries;

begin

  registers : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        sample <= c_rom(to_integer(unsigned(address)));
      end if;
    end if;
  end process;

end architecture;
