-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Passes the vectors of a frame to a shader, finds the frame's end, and ends a frame that the shader cannot
--             draw. The vector with in_last = '1' is the frame's last one: no other vector is taken until all fragments
--             of the frame are output.
--             A frame is faulty if the shader reports a fault, or if the shader does not go on: a vector waits, or the
--             frame has not ended, 2**g_limit_bits clocks after the last vector was taken. The shader is then reset, the
--             other vectors of the frame are taken and discarded, and the frame ends. The next frame is drawn.
-- Contract    in and init are valid/ready. in_ready depends on init_ready and registers only. The shader's init_ready,
--             busy, shader_fault and shader_reset are synchronous; busy = '0': no vector and no fragment is in the
--             shader. A shader reports a fault at most 8 clocks after the first with busy = '0'. frame_end: all fragments of the
--             frame have been taken from the shader. done: the frame's last transfer is taken. fault = '1' from the
--             clock after the fault to the frame's last transfer.
--             stalled: the shader waits for the receiver. These clocks do not count.
-- Formats     none
-- Latency     0 from in to init; 9 clocks from the first clock with busy = '0' to frame_end
-- Throughput  1 vector per clock
-- Error       none: each vector of a frame without a fault is passed once, in order. It waits at most 2**g_limit_bits
--             clocks in which the receiver does not stall
-- Source      ours
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

entity axi_control is
  generic (
    g_limit_bits : positive := 26 -- at least twice the clocks of the largest triangle
  );
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    in_valid     : in  std_logic;
    in_ready     : out std_logic;
    in_last      : in  std_logic;
    init_valid   : out std_logic;
    init_ready   : in  std_logic;
    busy         : in  std_logic;
    stalled      : in  std_logic;
    shader_fault : in  std_logic;
    shader_reset : out std_logic;
    frame_end    : out std_logic;
    done         : in  std_logic;
    fault        : out std_logic
  );
end entity;

architecture rtl of axi_control is

  -- Clocks without a vector or fragment in the shader before the frame ends: those in which it may report a fault.
  constant c_settle : positive := 8;

  constant c_limit : unsigned(g_limit_bits - 1 downto 0) := (others => '1');

  type reg_t is record
    open_frame   : std_logic; -- the frame's last vector has not been taken
    idle         : std_logic_vector(1 to c_settle); -- the shader was idle after the last vector, index clocks ago
    frame_end    : std_logic;
    fault        : std_logic;
    shader_reset : std_logic;
    clocks       : unsigned(c_limit'range); -- for which a vector or the frame's end waits
  end record;

  signal r, r_next : reg_t;

  signal ready : std_logic;
  signal waits : std_logic; -- for the shader

begin

  -- Discard the vectors of a faulty frame.
  ready      <= r.open_frame and (r.fault or (init_ready and not r.shader_reset));
  init_valid <= in_valid and r.open_frame and not r.shader_reset;
  waits      <= in_valid and not ready when r.open_frame = '1' else not r.frame_end;

  combinational : process (all)
    variable v    : reg_t;
    variable late : boolean; -- the shader does not go on
  begin
    v := r;
    -- Count the clocks without progress.
    if waits = '0' then
      v.clocks := (others => '0');
    elsif stalled = '0' then
      v.clocks := r.clocks + 1;
    end if;

    -- End the frame when the shader is empty.
    v.idle      := (not r.open_frame and not busy) & r.idle(1 to c_settle - 1);
    if r.idle = (r.idle'range => '1') then
      v.frame_end := '1';
    end if;
    if in_valid = '1' and ready = '1' and in_last = '1' then
      v.open_frame := '0';
    end if;

    -- A fault ends only a frame that has not ended.
    late := waits = '1' and stalled = '0' and r.clocks = c_limit;
    if r.frame_end = '0' and r.shader_reset = '0' and (shader_fault = '1' or late) then
      v.fault := '1';
    end if;

    -- Begin the next frame.
    if done = '1' then
      v.open_frame := '1';
      v.idle       := (others => '0');
      v.frame_end  := '0';
      v.fault      := '0';
    end if;
    v.shader_reset := v.fault;
    if reset = '1' then
      v.open_frame   := '1';
      v.idle         := (others => '0');
      v.frame_end    := '0';
      v.fault        := '0';
      v.shader_reset := '1';
      v.clocks       := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  in_ready     <= ready;
  shader_reset <= r.shader_reset;
  frame_end    <= r.frame_end;
  fault        <= r.fault;

end architecture;
