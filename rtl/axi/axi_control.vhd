-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Passes the vectors of a frame to a shader, finds the frame's end, and ends a frame that the shader cannot
--             draw. in_end = '1' ends the frame's vectors: no other item is taken until all fragments of the frame are
--             output.
--             A frame is faulty if an item has a cause, if the shader reports a fault, or if the shader does not go on: a
--             vector waits, or the frame has not ended, 2**g_limit_bits clocks after the last item was taken. The shader
--             is then reset, the other vectors of the frame are taken and discarded, and the frame ends. The next frame
--             is drawn.
-- Contract    in and init are valid/ready. An item with in_end = '1' or a cause has no vector. in_ready depends on the
--             item, init_ready and registers only. The shader's init_ready,
--             busy, shader_fault and shader_reset are synchronous; busy = '0': no vector and no fragment is in the
--             shader. A shader reports a fault at most 8 clocks after the first with busy = '0'. frame_end: all fragments of the
--             frame have been taken from the shader. done: the frame's last transfer is taken. cause: the frame's first
--             fault, from the clock after it to the frame's last transfer; c_no_fault before.
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
use work.axi_pkg.all;

entity axi_control is
  generic (
    g_limit_bits : positive := 26 -- at least twice the clocks of the largest triangle
  );
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    in_valid     : in  std_logic;
    in_ready     : out std_logic;
    in_end       : in  std_logic;
    in_cause     : in  cause_t;
    init_valid   : out std_logic;
    init_ready   : in  std_logic;
    busy         : in  std_logic;
    stalled      : in  std_logic;
    shader_fault : in  std_logic;
    shader_reset : out std_logic;
    frame_end    : out std_logic;
    done         : in  std_logic;
    cause        : out cause_t
  );
end entity;

architecture rtl of axi_control is

  -- Clocks without a vector or fragment in the shader before the frame ends: those in which it may report a fault.
  constant c_settle : positive := 8;

  constant c_limit : unsigned(g_limit_bits - 1 downto 0) := (others => '1');

  type reg_t is record
    open_frame   : std_logic; -- the end of the frame's vectors has not been taken
    idle         : std_logic_vector(1 to c_settle); -- the shader was idle after the last vector, index clocks ago
    frame_end    : std_logic;
    cause        : cause_t;
    shader_reset : std_logic;
    clocks       : unsigned(c_limit'range); -- for which a vector or the frame's end waits
  end record;

  signal r, r_next : reg_t;

  signal is_vector : std_logic;
  signal faulty    : std_logic;
  signal ready     : std_logic;
  signal waits     : std_logic; -- for the shader

begin

  is_vector <= '1' when in_end = '0' and in_cause = c_no_fault else '0';
  faulty    <= '1' when r.cause /= c_no_fault else '0';

  -- Discard the vectors of a faulty frame. Nothing is taken in the clock after a reset.
  ready      <= r.open_frame and (faulty or ((init_ready or not is_vector) and not r.shader_reset));
  init_valid <= in_valid and is_vector and r.open_frame and not r.shader_reset;
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
    if in_valid = '1' and ready = '1' and in_end = '1' and in_cause = c_no_fault then
      v.open_frame := '0';
    end if;

    -- Keep the first cause. A fault ends only a frame that has not ended.
    late := waits = '1' and stalled = '0' and r.clocks = c_limit;
    if r.frame_end = '0' and r.shader_reset = '0' then
      if shader_fault = '1' then
        v.cause := c_shader_fault;
      elsif late then
        v.cause := c_limit_reached;
      elsif in_valid = '1' and ready = '1' then
        v.cause := in_cause;
      end if;
    end if;

    -- Begin the next frame.
    if done = '1' then
      v.open_frame := '1';
      v.idle       := (others => '0');
      v.frame_end  := '0';
      v.cause      := c_no_fault;
    end if;
    v.shader_reset := or v.cause;
    if reset = '1' then
      v.open_frame   := '1';
      v.idle         := (others => '0');
      v.frame_end    := '0';
      v.cause        := c_no_fault;
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
  cause        <= r.cause;

end architecture;
