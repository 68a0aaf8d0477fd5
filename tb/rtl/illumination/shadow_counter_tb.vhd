-- SPDX-License-Identifier: Apache-2.0
-- Every clock is compared with the golden model: every column after reset, sequences on few columns at full speed and
-- with pauses, counts beyond both ends of their format, negative counts of volumes around an object, clears, and
-- resets.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity shadow_counter_tb is
  generic (g_folder : string := "shadow_counter");
end entity;

architecture sim of shadow_counter_tb is
  signal clk                               : std_logic := '0';
  signal reset, ready, step, clear, counts : std_logic;
  signal opens, object                     : std_logic;
  signal x                                 : std_logic_vector(formats(true).pixel_x.bits - 1 downto 0);
  signal eye                               : std_logic_vector(formats(true).shadow_count.bits - 1 downto 0);
  signal lit, fault                        : std_logic;
begin
  dut : entity work.shadow_counter
    port map (
      clk        => clk,
      reset      => reset,
      ready      => ready,
      step       => step,
      clear      => clear,
      counts     => counts,
      opens      => opens,
      object     => object,
      x          => x,
      around_eye => eye,
      lit        => lit,
      fault      => fault);

  run : process is
    variable vectors               : vectors_t;
    variable counted, reset_before : std_logic;
    variable waits                 : natural;
  begin
    vectors.open_file(g_folder & "/columns.txt");
    reset_before := '1';
    while vectors.next_vector loop
      vectors.drive(reset);
      vectors.drive(step);
      vectors.drive(clear);
      vectors.drive(counts);
      vectors.drive(opens);
      vectors.drive(object);
      vectors.drive(x);
      vectors.drive(eye);
      waits := vectors.read_number;
      settle;
      for i in 1 to waits loop
        if ready /= '0' then
          vectors.fail("ready after " & to_string(i - 1) & " clocks, not after " & to_string(waits));
        end if;
        tick(clk);
        settle;
      end loop;
      if reset = '0' and ready /= '1' then
        vectors.fail("not ready after " & to_string(waits) & " clocks");
      end if;
      vectors.read_flag(counted);
      vectors.check_if(counted, "lit", lit);
      vectors.check_if(not reset_before, "fault", fault);
      reset_before := reset and reset_before;
      tick(clk);
    end loop;
    finish(finished);
  end process;

  report_end(finished, "shadow_counter_tb");
end architecture;
