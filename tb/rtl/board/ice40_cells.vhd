-- SPDX-License-Identifier: Apache-2.0
-- Simulation models of the iCE40's cells that board_top uses, with the modes that it uses and with delays of pins.
-- Times of an HX8K, slowest case, from Project IceStorm's icefuzz/timings_hx8k.txt: IO_PAD and PRE_IO.

library ieee;
use ieee.std_logic_1164.all;

-- The PLL with feedback by its phase shifter: output A has the frequency of the reference divided by DIVR + 1,
-- output B is a quarter of a period later. LOCK comes after c_lock_time.
entity SB_PLL40_2F_CORE is
  generic (
    FEEDBACK_PATH       : string;
    PLLOUT_SELECT_PORTA : string;
    PLLOUT_SELECT_PORTB : string;
    SHIFTREG_DIV_MODE   : std_logic_vector(0 downto 0);
    DIVR                : std_logic_vector(3 downto 0);
    DIVF                : std_logic_vector(6 downto 0);
    DIVQ                : std_logic_vector(2 downto 0);
    FILTER_RANGE        : std_logic_vector(2 downto 0)
  );
  port (
    REFERENCECLK  : in  std_logic;
    PLLOUTGLOBALA : out std_logic := '0';
    PLLOUTGLOBALB : out std_logic := '0';
    RESETB        : in  std_logic;
    BYPASS        : in  std_logic;
    LOCK          : out std_logic := '0'
  );
end entity;

library ieee;
use ieee.numeric_std.all;

architecture sim of SB_PLL40_2F_CORE is
  constant c_lock_time : time := 3 us;
begin
  assert FEEDBACK_PATH = "PHASE_AND_DELAY" and PLLOUT_SELECT_PORTA = "SHIFTREG_0deg"
    and PLLOUT_SELECT_PORTB = "SHIFTREG_90deg" and SHIFTREG_DIV_MODE = "0" and DIVF = "0000000"
    report "SB_PLL40_2F_CORE: the model does not have this mode" severity failure;

  run : process is
    variable start     : time;
    variable reference : time; -- periods
    variable period    : time;
    variable vco       : real; -- in MHz
  begin
    wait until rising_edge(REFERENCECLK);
    start := now;
    wait until rising_edge(REFERENCECLK);
    reference := now - start;
    period := reference * (to_integer(unsigned(DIVR)) + 1);
    vco := 1.0e6 / real(period / 1 ps) * 2.0 ** to_integer(unsigned(DIVQ));
    assert vco >= 533.0 and vco <= 1066.0
      report "SB_PLL40_2F_CORE: its oscillator would run at " & to_string(vco, 1) & " MHz, not 533 to 1066" severity failure;
    assert BYPASS = '0' and RESETB = '1' report "SB_PLL40_2F_CORE: the model does not have this mode" severity failure;
    while true loop
      PLLOUTGLOBALA <= '1', '0' after period / 2;
      PLLOUTGLOBALB <= transport '1' after period / 4, '0' after period / 4 * 3;
      LOCK          <= '1' when now > c_lock_time else '0';
      for i in 0 to to_integer(unsigned(DIVR)) loop
        wait until rising_edge(REFERENCECLK);
      end loop;
    end loop;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;

-- The cell of a pin. PIN_TYPE as in Lattice's technology library.
entity SB_IO is
  generic (
    PIN_TYPE : std_logic_vector(5 downto 0)
  );
  port (
    PACKAGE_PIN   : inout std_logic := 'Z';
    INPUT_CLK     : in    std_logic;
    OUTPUT_CLK    : in    std_logic;
    OUTPUT_ENABLE : in    std_logic;
    D_OUT_0       : in    std_logic;
    D_OUT_1       : in    std_logic;
    D_IN_0        : out   std_logic
  );
end entity;

architecture sim of SB_IO is
  constant c_clock_to_pin : time := 2.5 ns;
  constant c_setup        : time := 2.5 ns; -- of a pin before INPUT_CLK
  constant c_bidirectional : boolean := PIN_TYPE = "110100";
  constant c_output        : boolean := PIN_TYPE = "010101";
  constant c_halves        : boolean := PIN_TYPE = "010001";

  signal enable : std_logic := '0';
  signal high   : std_logic := 'U'; -- output register of the rising edge
  signal low    : std_logic := 'U'; -- of the falling edge
begin
  assert c_bidirectional or c_output or c_halves
    report "SB_IO: the model does not have PIN_TYPE " & to_string(PIN_TYPE) severity failure;

  registers : process (OUTPUT_CLK) is
  begin
    if rising_edge(OUTPUT_CLK) then
      enable <= OUTPUT_ENABLE;
      high   <= D_OUT_0;
    end if;
    if falling_edge(OUTPUT_CLK) then
      low <= D_OUT_1;
    end if;
  end process;

  bidirectional : if c_bidirectional generate
    PACKAGE_PIN <= transport high after c_clock_to_pin when enable = '1' else 'Z' after c_clock_to_pin;

    sample : process (INPUT_CLK) is
    begin
      if rising_edge(INPUT_CLK) then
        D_IN_0 <= PACKAGE_PIN;
        if PACKAGE_PIN'last_event < c_setup then
          D_IN_0 <= 'X';
        end if;
      end if;
    end process;
  elsif c_output generate
    PACKAGE_PIN <= transport high after c_clock_to_pin;
    D_IN_0 <= 'U';
  else generate
    PACKAGE_PIN <= transport high after c_clock_to_pin when OUTPUT_CLK = '1' else low after c_clock_to_pin;
    D_IN_0 <= 'U';
  end generate;
end architecture;
