-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Contracts of streams, asserted in the user's simulation: a word that waits does not change; no answer comes
--             without a request.
-- Source      ours
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package stream_pkg is

  -- Stop the simulation if a word changes while it waits. Call it at each rising edge. item: valid, then the word.
  -- waiting is the caller's memory: the item of the clock before, with '1' as valid if it was not taken.
  procedure check_stream (
    port_name    :       string;
    reset, ready :       std_logic;
    item         :       std_logic_vector;
    waiting      : inout std_logic_vector);

  -- Stop the simulation if an answer comes without a request. Call it at each rising edge. request = '1': last + 1 answers
  -- are requested in this clock. missing is the caller's memory: answers that have not come.
  procedure check_answers (
    port_name     :       string;
    reset         :       std_logic;
    request       :       std_logic;
    last          :       unsigned;
    valid, answer :       std_logic; -- valid: an answer is offered; answer: it is taken
    missing       : inout natural);

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

  procedure check_answers (
    port_name     :       string;
    reset         :       std_logic;
    request       :       std_logic;
    last          :       unsigned;
    valid, answer :       std_logic;
    missing       : inout natural) is
  begin
    if request = '1' then
      missing := missing + to_integer(last) + 1;
    end if;
    assert missing > 0 or valid /= '1' or reset /= '0'
      report port_name & ": an answer without a request"
      severity failure;
    if reset = '1' then
      missing := 0;
    elsif answer = '1' and missing > 0 then
      missing := missing - 1;
    end if;
  end procedure;

end package body;
