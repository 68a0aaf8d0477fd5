-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Ends a frame: waits until the last fragment is written, swaps the colour buffers at the next vertical
--             blank, and clears the new back buffer and the depths. After reset it clears all buffers.
-- Contract    frame_end is '1' for one clock, only while ending = '0'. drained = '1': no vector and no fragment is on
--             its way, and none comes before ending = '0'. front changes only in the clock after blank_start.
--             write_valid/write_ready is a valid/ready stream of writes to the SRAM.
-- Formats     board_pkg: address, word
-- Latency     from drained to the swap: up to a frame of the monitor, 16.8 ms; the clear: 153,600 writes, 3.4 ms with
--             scan-out
-- Throughput  1 write per clock
-- Error       none
-- Source      ours
-- Golden twin none: it only counts

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.line_pkg.flag;

entity frame_control is
  port (
    clk           : in  std_logic;
    reset         : in  std_logic;
    frame_end     : in  std_logic;
    background    : in  word_t; -- of the next frame; read with frame_end
    drained       : in  std_logic;
    blank_start   : in  std_logic;
    ending        : out std_logic;
    front         : out std_logic; -- the colour buffer that is shown
    shown         : out unsigned(3 downto 0); -- frames shown, modulo 16
    write_valid   : out std_logic;
    write_ready   : in  std_logic;
    write_address : out address_t;
    write_data    : out word_t
  );
end entity;

architecture rtl of frame_control is

  type phase_t is (
    idle,
    drain,  -- wait for drained
    await,  -- wait for the vertical blank
    clear
    );

  type reg_t is record
    phase      : phase_t;
    front      : std_logic;
    shown      : unsigned(shown'range);
    background : word_t;
    address    : address_t;
    both       : std_logic; -- clear both colour buffers
  end record;

  signal r, r_next : reg_t;

  signal depths : std_logic; -- the clear is at the depths

begin

  depths <= flag(r.address >= c_depth_base);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    case r.phase is
      when idle =>
        if frame_end = '1' then
          v.phase      := drain;
          v.background := background;
        end if;
      when drain =>
        if drained = '1' then
          v.phase := await;
        end if;
      when await =>
        if blank_start = '1' then
          v.phase   := clear;
          v.front   := not r.front;
          v.shown   := r.shown + 1;
          v.address := colour_base(r.front);
        end if;
      when clear =>
        if write_ready = '1' then
          v.address := r.address + 1;
          if r.address = c_words - 1 then
            v.phase := idle;
            v.both  := '0';
          elsif r.address = c_pixels - 1 and r.both = '0' then
            v.address := to_unsigned(c_depth_base, address_t'length);
          end if;
        end if;
    end case;
    if reset = '1' then
      v.phase      := clear;
      v.front      := '0';
      v.shown      := (others => '0');
      v.background := (others => '0');
      v.address    := (others => '0');
      v.both       := '1';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  ending        <= '0' when r.phase = idle else '1';
  front         <= r.front;
  shown         <= r.shown;
  write_valid   <= '1' when r.phase = clear else '0';
  write_address <= r.address;
  write_data    <= c_farthest when depths = '1' else r.background;

end architecture;
