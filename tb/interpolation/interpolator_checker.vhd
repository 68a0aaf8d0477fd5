-- SPDX-License-Identifier: Apache-2.0
-- Drives the same interpolator in one part, in two and so on with the walker's strobes. Every clock of the first is
-- compared with the golden model. Each of the others has the same values, later by one clock per additional part.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity interpolator_checker is
  generic (
    g_file  : string;
    g_parts : positive
  );
  port (
    clk        : out std_logic := '0';
    init       : out std_logic_vector;
    line_load  : out std_logic;
    line_step  : out std_logic;
    line_carry : out std_logic;
    span_load  : out std_logic;
    span_step  : out std_logic;
    values     : in  std_logic_vector -- of the interpolators, that in one part lowest
  );
end entity;

architecture sim of interpolator_checker is
  constant c_bits : positive := values'length / g_parts;

  type words_t is array (natural range <>) of std_logic_vector(c_bits - 1 downto 0);
begin
  run : process is
    variable vectors : vectors_t;
    variable checked : std_logic_vector(0 to g_parts - 1) := (others => '0'); -- now, one clock ago, ...
    variable before  : words_t(0 to g_parts - 1);
    variable value   : std_logic_vector(c_bits - 1 downto 0);
  begin
    vectors.open_file(g_file);
    while vectors.next_vector loop
      checked(1 to checked'high) := checked(0 to checked'high - 1);
      vectors.read_flag(checked(0));
      vectors.drive(init);
      vectors.drive(line_load);
      vectors.drive(line_step);
      vectors.drive(line_carry);
      vectors.drive(span_load);
      vectors.drive(span_step);
      settle;
      before := values(c_bits - 1 downto 0) & before(0 to before'high - 1);
      vectors.check_if(checked(0), "value", before(0));
      for later in 1 to g_parts - 1 loop
        value := values((later + 1) * c_bits - 1 downto later * c_bits);
        if checked(later) = '1' and value /= before(later) then
          vectors.fail("value in " & to_string(later + 1) & " parts is " & to_hstring(value) & ", expected "
            & to_hstring(before(later)) & ", that of " & to_string(later) & " clocks before");
        end if;
      end loop;
      tick(clk);
    end loop;
    finish(finished);
  end process;
end architecture;
