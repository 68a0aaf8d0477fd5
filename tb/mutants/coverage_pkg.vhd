-- SPDX-License-Identifier: Apache-2.0
-- What coverage.cpp puts into the RTL's text; the bodies are in coverage_counters.c.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package coverage_pkg is

  function ran (id : natural) return boolean;
  attribute foreign of ran : function is "VHPIDIRECT halfway_ran";

  function was (id : natural; condition : boolean) return boolean;
  attribute foreign of was : function is "VHPIDIRECT halfway_was";

  function new_instance (file_id : natural) return natural;
  attribute foreign of new_instance : function is "VHPIDIRECT halfway_new_instance";

  function saw_word (instance, id : natural; word : std_logic_vector) return boolean;
  attribute foreign of saw_word : function is "VHPIDIRECT halfway_saw";

  procedure saw (instance, id : in natural; word : in std_logic_vector);

  procedure saw (instance, id : in natural; word : in unsigned);

  procedure saw (instance, id : in natural; word : in signed);

  procedure saw (instance, id : in natural; word : in std_logic);

end package;

package body coverage_pkg is

  function ran (id : natural) return boolean is
  begin
    report "VHPIDIRECT halfway_ran" severity failure;
    return true;
  end function;

  function was (id : natural; condition : boolean) return boolean is
  begin
    report "VHPIDIRECT halfway_was" severity failure;
    return true;
  end function;

  function new_instance (file_id : natural) return natural is
  begin
    report "VHPIDIRECT halfway_new_instance" severity failure;
    return 0;
  end function;

  function saw_word (instance, id : natural; word : std_logic_vector) return boolean is
  begin
    report "VHPIDIRECT halfway_saw" severity failure;
    return true;
  end function;

  procedure saw (instance, id : in natural; word : in std_logic_vector) is
  begin
    assert saw_word(instance, id, word);
  end procedure;

  procedure saw (instance, id : in natural; word : in unsigned) is
  begin
    assert saw_word(instance, id, std_logic_vector(word));
  end procedure;

  procedure saw (instance, id : in natural; word : in signed) is
  begin
    assert saw_word(instance, id, std_logic_vector(word));
  end procedure;

  procedure saw (instance, id : in natural; word : in std_logic) is
    variable bits : std_logic_vector(0 downto 0);
  begin
    bits(0) := word;
    assert saw_word(instance, id, bits);
  end procedure;

end package body;
