-- SPDX-License-Identifier: Apache-2.0
-- A model of an SPI host at the board's pins: sends the packets of a script, which is described in sim/extras/board/spi_host.hpp.
-- Twin of SpiHost there, at the shortest times of docs/board.md.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity board_host is
  generic (
    g_script : string
  );
  port (
    clk          : in  std_logic;
    select_n     : out std_logic := '1';
    clock        : out std_logic := '0';
    data         : out std_logic := '0';
    device_data  : in  std_logic;
    done         : out boolean   := false;
    -- What the device has reported.
    packets      : out natural   := 0;
    status_bytes : out natural   := 0;
    errors       : out natural   := 0;
    faults       : out natural   := 0;
    frames       : out natural   := 0
  );
end entity;

architecture sim of board_host is

  constant c_reset_clocks : positive := 200; -- of the board, at most

begin

  send_script : process
    file script             : text open read_mode is g_script;
    variable action         : line;
    variable kind           : string(1 to 6);
    variable count          : natural; -- bytes of the packet
    variable bits, hold     : natural;
    variable status         : std_logic_vector(7 downto 0);
    variable status_is_new  : boolean := false;

    procedure wait_clocks (number : natural) is
    begin
      for i in 1 to number loop
        wait until rising_edge(clk);
      end loop;
    end procedure;

    -- Send the first bits of a packet; then hold select.
    procedure send (packet : std_logic_vector; number, hold_clocks : natural) is
      alias message : std_logic_vector(0 to packet'length - 1) is packet;
    begin
      wait_clocks(6);
      select_n <= '0';
      wait_clocks(4);
      for bit_number in 0 to number - 1 loop
        clock <= '0';
        data  <= message(bit_number);
        wait_clocks(2);
        if bit_number < 8 then
          status := status(6 downto 0) & device_data;
        end if;
        clock <= '1';
        wait_clocks(2);
      end loop;
      clock <= '0';
      data  <= '0';
      wait_clocks(2 + hold_clocks);
      select_n <= '1';
      -- Count what the status byte reports.
      packets      <= packets + 1;
      status_bytes <= status_bytes + 1;
      if status(4) = '1' then
        errors <= errors + 1;
      end if;
      if status(5) = '1' then
        faults <= faults + 1;
      end if;
      frames <= to_integer(unsigned(status(3 downto 0)));
      status_is_new := number = 8;
    end procedure;

    -- Read the status until the device can take a packet.
    procedure wait_for_room (draws : boolean) is
    begin
      while not status_is_new or status(6) = '1' or (draws and status(7) = '0') loop
        send(x"00", 8, 0);
      end loop;
    end procedure;

    procedure send_packet (bytes, number, hold_clocks : natural) is
      variable packet : std_logic_vector(8 * bytes - 1 downto 0);
    begin
      readline(script, action);
      hread(action, packet);
      wait_for_room(packet(packet'high downto packet'high - 7) = x"01");
      send(packet, number, hold_clocks);
    end procedure;

  begin
    wait_clocks(c_reset_clocks);
    while not endfile(script) loop
      readline(script, action);
      read(action, kind);
      read(action, count);
      read(action, bits);
      read(action, hold);
      if kind = "packet" then
        send_packet(count, bits, hold);
      elsif kind = "pause " then
        wait_clocks(hold);
      else
        wait_for_room(false);
      end if;
    end loop;
    done <= true;
    wait;
  end process;

end architecture;
