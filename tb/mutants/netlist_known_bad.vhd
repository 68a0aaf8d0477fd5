-- SPDX-License-Identifier: Apache-2.0
-- Constructs for which GHDL 2.0.0 writes a wrong netlist without a message. The netlist test must detect each one: the
-- driver refuses it, or GHDL's simulation and Verilator's differ.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity netlist_known_bad is
  generic (
    g_construct : natural := 0
  );
  port (
    clk      : in  std_logic;
    reset    : in  std_logic;
    stimulus : in  std_logic_vector(159 downto 0);
    response : out std_logic_vector(95 downto 0)
  );
end entity;

architecture rtl of netlist_known_bad is
  signal a, b   : signed(39 downto 0);
  signal result : signed(39 downto 0);

  -- 64 bits, of which only the upper 32 have a 1.
  function upper_bits return std_logic_vector is
    variable word : std_logic_vector(63 downto 0) := (others => '0');
  begin
    word(63 downto 62) := "11";
    return word;
  end function;

  signal chosen : std_logic_vector(63 downto 0);
begin
  a <= signed(stimulus(55 downto 16));
  b <= signed(stimulus(127 downto 88));

  sound : if g_construct = 0 generate
    result <= a + b;
  end generate;
  shift : if g_construct = 1 generate
    result <= shift_right(a, 3);
  end generate;
  narrow : if g_construct = 2 generate
    result <= resize(resize(a, 12), 40);
  end generate;
  absolute : if g_construct = 3 generate
    result <= abs a;
  end generate;
  divide : if g_construct = 4 generate
    result <= a / b when b /= 0 else a;
  end generate;
  smaller : if g_construct = 5 generate
    result <= minimum(a, b);
  end generate;
  wide_constant : if g_construct = 6 generate
    result <= a + signed'(x"8000000001");
  end generate;
  modulo : if g_construct = 7 generate
    result <= a mod b when b /= 0 else a;
  end generate;
  fallback : if g_construct = 8 generate
    choose : process (all)
    begin
      case stimulus(1 downto 0) is
        when "00" =>
          result <= a;
        when "01" =>
          result <= b;
        when others =>
          result <= a + b;
      end case;
    end process;
  end generate;

  upper : if g_construct = 9 generate
    chosen <= upper_bits when stimulus(0) = '1' else std_logic_vector(resize(a, 64));
    result <= signed(chosen(63 downto 24));
  end generate;
  large_integer : if g_construct = 10 generate
    result <= a when unsigned(stimulus(1 downto 0)) <= 5 else b;
  end generate;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        response <= (others => '0');
      else
        response <= std_logic_vector(resize(result, response'length));
      end if;
    end if;
  end process;
end architecture;
