-- SPDX-License-Identifier: Apache-2.0
-- A model of the board's SRAM at the pins, one system clock at a time. Twin of SramModel in sim/board/sram_model.hpp,
-- with the same rules.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.c_words;

entity board_sram is
  port (
    clk         : in  std_logic;
    address     : in  std_logic_vector(17 downto 0);
    data_in     : in  std_logic_vector(15 downto 0);
    data_enable : in  std_logic;
    read        : in  std_logic;
    write       : in  std_logic;
    data_out    : out std_logic_vector(15 downto 0) -- the register in the cells of the pins
  );
end entity;

architecture sim of board_sram is

begin

  memory : process (clk)
    type memory_t is array (0 to 2 ** 18 - 1) of natural range 0 to 2 ** 16 - 1;

    variable words    : memory_t := (others => 16#5a5a#);
    variable was_read : boolean  := false;
    variable at       : natural;
  begin
    if rising_edge(clk) then
      -- Check the rules of the bus.
      assert not (read = '1' and write = '1') report "SRAM: read and write" severity failure;
      assert data_enable = write
        report "SRAM: the FPGA drives the data, but does not write, or the reverse"
        severity failure;
      assert not (write = '1' and was_read)
        report "SRAM: write in the clock after a read: the bus is not released"
        severity failure;
      was_read := read = '1';
      -- Read or write. Without a read the bus has noise.
      data_out <= x"a5a5";
      if read = '1' or write = '1' then
        at := to_integer(unsigned(address));
        assert at < c_words report "SRAM: address " & integer'image(at) severity failure;
        if write = '1' then
          words(at) := to_integer(unsigned(data_in));
        else
          data_out <= std_logic_vector(to_unsigned(words(at), 16));
        end if;
      end if;
    end if;
  end process;

end architecture;
