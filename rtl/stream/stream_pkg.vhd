-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The contract of a valid/ready stream, asserted in the user's simulation: a word that waits does not change.
-- Source      ours
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;

package stream_pkg is

  -- Stop the simulation if a word changes while it waits. Call it at each rising edge. item: valid, then the word.
  -- waiting is the caller's memory: the item of the clock before, with '1' as valid if it was not taken.
  procedure check_stream (
    port_name    :       string;
    reset, ready :       std_logic;
    item         :       std_logic_vector;
    waiting      : inout std_logic_vector);

end package;

package body stream_pkg is

  procedure check_stream (
    port_name    :       string;
    reset, ready :       std_logic;
    item         :       std_logic_vector;
    waiting      : inout std_logic_vector) is
  begin
    assert waiting(waiting'left) /= '1' or reset = '1' or item = waiting
      report port_name & ": valid or data changes while the word waits"
      severity failure;
    waiting := item;
    waiting(waiting'left) := waiting(waiting'left) and not ready and not reset;
  end procedure;

end package body;
