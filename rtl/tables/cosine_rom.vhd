-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     A table of a power of the cosine. Preset exact: entry k is
--             cos(pi/2 * (k + 1/2) / 2**address_bits) ** power, for half of the bell, from the top on. An own table
--             instead contains a highlight of the scene, cos(reach * (k + 1/2) / 2**address_bits) ** exponent. Preset
--             published: the address is signed and wraps. The table is cos**2 over half bells, or cos over whole bells
--             with 0 for negative values.
-- Formats     sample: unsigned, in units of 1 / (2**data_bits - 1); table: cosine_pkg
-- Latency     1 clock from an address with enable to its sample
-- Throughput  1 sample per clock
-- Error       half a step of the sample, plus half a cell of the angle times the greatest slope: see cosine_pkg
-- Source      spherical paper, section 4 and figure 11
-- Golden twin model/golden/cosine_rom.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.cosine_pkg.all;

entity cosine_rom is
  generic (
    g_exact  : boolean  := true;
    g_power  : positive := 2;
    g_cosine : cosine_t
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    address : in  std_logic_vector(address_bits(g_cosine) - 1 downto 0);
    sample  : out std_logic_vector(data_bits(g_cosine) - 1 downto 0)
  );
end entity;

architecture rtl of cosine_rom is

  -- A descending range: for an ascending one GHDL's netlist subtracts the address from the last index.
  type rom_t is array (2 ** address'length - 1 downto 0) of std_logic_vector(sample'range);

  type reg_t is record
    sample : std_logic_vector(sample'range);
  end record;

  function entries return rom_t is
    constant c_table : cosine_table_t := cosine_table(g_exact, g_power, g_cosine);

    variable rom : rom_t;
  begin
    for i in rom'range loop
      rom(i) := std_logic_vector(to_unsigned(c_table(i), data_bits(g_cosine)));
    end loop;
    return rom;
  end function;

  constant c_rom : rom_t := entries;

  signal r : reg_t;

begin

  registers : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        r.sample <= c_rom(to_integer(unsigned(address)));
      end if;
    end if;
  end process;

  sample <= r.sample;

end architecture;
