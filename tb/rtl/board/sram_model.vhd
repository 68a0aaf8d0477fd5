-- SPDX-License-Identifier: Apache-2.0
-- The board's SRAM, Samsung K6R4016V1D of 10 ns, with its times at the pins. While the outputs turn on or off, and from a
-- change of an address until the word is valid, they drive 'W'. A write whose times are too short, and a data pin that
-- both sides drive, are failures. Contents after power-on are random.

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

package sram_words_pkg is

  type sram_t is protected
    procedure randomize;
    procedure set (address : natural; word : std_logic_vector(15 downto 0));
    impure function get (address : natural) return std_logic_vector;
  end protected;

end package;

package body sram_words_pkg is

  type sram_t is protected body
    type words_t is array (0 to 2 ** 18 - 1) of natural range 0 to 65535;

    variable words : words_t;

    procedure randomize is
      variable random : unsigned(31 downto 0) := to_unsigned(7, 32);
    begin
      for i in words'range loop
        random   := next_random(random);
        words(i) := to_integer(random(31 downto 16));
      end loop;
    end procedure;

    procedure set (address : natural; word : std_logic_vector(15 downto 0)) is
    begin
      words(address) := to_integer(unsigned(word));
    end procedure;

    impure function get (address : natural) return std_logic_vector is
    begin
      return std_logic_vector(to_unsigned(words(address), 16));
    end function;
  end protected body;

end package body;

use work.sram_words_pkg.all;

-- A package of its own: the body of the type is before the variable.
package sram_model_pkg is

  -- The contents of the only instance, for the testbench.
  shared variable sram : sram_t;

end package;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.sram_model_pkg.all;

entity sram_model is
  port (
    address : in    std_logic_vector(17 downto 0);
    data    : inout std_logic_vector(15 downto 0) := (others => 'Z');
    ce_n    : in    std_logic;
    oe_n    : in    std_logic;
    we_n    : in    std_logic
  );
end entity;

architecture sim of sram_model is
  -- Reads: from an address, from oe_n to valid data, from oe_n to high impedance.
  constant c_aa  : time := 10 ns;
  constant c_oe  : time := 5 ns;
  constant c_ohz : time := 5 ns;
  -- Writes: width of the pulse with oe_n high, address before its end, data before its end.
  constant c_wp : time := 7 ns;
  constant c_aw : time := 7 ns;
  constant c_dw : time := 5 ns;

  signal driven : std_logic_vector(data'range) := (others => 'Z');
begin
  data <= driven;

  fill : process is
  begin
    sram.randomize;
    wait;
  end process;

  read : process is
    variable valid_at : time;
  begin
    wait on address, oe_n;
    if oe_n = '0' and ce_n = '0' and we_n = '1' then
      driven <= (others => 'W');
      if not is_x(address) then
        valid_at := maximum(c_aa - address'last_event, c_oe - oe_n'last_event);
        driven <= transport (15 downto 0 => 'W'), sram.get(to_integer(unsigned(address))) after valid_at;
      end if;
    elsif oe_n'event then
      driven <= transport (15 downto 0 => 'W'), (15 downto 0 => 'Z') after c_ohz;
    end if;
  end process;

  -- Only one side drives the data pins.
  contention : process (data) is
  begin
    for i in data'range loop
      assert data(i) /= 'X' and not (driven(i) = 'W' and data(i) /= 'W')
        report "sram_model: data pin " & to_string(i) & " is driven by both sides" severity failure;
    end loop;
  end process;

  write : process (we_n, address) is
    variable fall : time := 0 ns;
  begin
    assert not (address'event and we_n = '0') report "sram_model: the address changes in a write" severity failure;
    if falling_edge(we_n) then
      fall := now;
    elsif rising_edge(we_n) and ce_n = '0' and fall > 0 ns then
      assert not is_x(address) and not is_x(data) report "sram_model: writes an unknown word" severity failure;
      assert oe_n = '1' report "sram_model: a write with oe_n low" severity failure;
      assert now - fall >= c_wp and address'last_event >= c_aw and data'last_event >= c_dw
        report "sram_model: a write is too short: pulse " & to_string(now - fall) & ", address "
        & to_string(address'last_event) & ", data " & to_string(data'last_event) severity failure;
      sram.set(to_integer(unsigned(address)), data);
    end if;
  end process;
end architecture;
