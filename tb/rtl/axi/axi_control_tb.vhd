-- SPDX-License-Identifier: Apache-2.0
-- A shader that is busy for some clocks after each vector, that stops for ever, or that reports a fault, and items with a
-- cause. Each vector of a good frame must go to the shader once, and the frame must end 9 clocks after the shader is
-- idle. A bad frame must end with its cause, its vectors discarded, with the shader reset, and the next frame must be
-- good.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.tb_pkg.all;

entity axi_control_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of axi_control_tb is
  constant c_limit_bits : positive := 5;
  constant c_limit      : positive := 2 ** c_limit_bits;

  type frame_t is (good, takes_nothing, stays_busy, reports, reports_late, has_bad_item);

  function cause_of (kind : frame_t) return cause_t is
  begin
    case kind is
      when good =>
        return c_no_fault;
      when takes_nothing | stays_busy =>
        return c_limit_reached;
      when reports | reports_late =>
        return c_shader_fault;
      when has_bad_item =>
        return c_wrong_kind;
    end case;
  end function;

  signal clk                       : std_logic := '0';
  signal reset                     : std_logic := '1';
  signal in_valid                  : std_logic := '0';
  signal in_ready                  : std_logic;
  signal in_end                    : std_logic := '0';
  signal in_cause                  : cause_t   := c_no_fault;
  signal init_valid                : std_logic;
  signal init_ready, busy, stalled : std_logic := '0';
  signal shader_fault              : std_logic := '0';
  signal shader_reset, frame_end   : std_logic;
  signal done                      : std_logic := '0';
  signal cause                     : cause_t;
  signal ended                     : boolean := false;
begin
  dut : entity work.axi_control
    generic map (g_limit_bits => c_limit_bits)
    port map (
      clk          => clk,
      reset        => reset,
      in_valid     => in_valid,
      in_ready     => in_ready,
      in_end       => in_end,
      in_cause     => in_cause,
      init_valid   => init_valid,
      init_ready   => init_ready,
      busy         => busy,
      stalled      => stalled,
      shader_fault => shader_fault,
      shader_reset => shader_reset,
      frame_end    => frame_end,
      done         => done,
      cause        => cause);

  clk <= not clk after c_half_period when not ended;

  run : process is
    variable random : unsigned(31 downto 0) := to_unsigned(9, 32);

    -- A frame of `vectors` vectors; the shader works `steps` clocks on each. With `pauses` the receiver stalls at random.
    procedure draw (kind : frame_t; vectors, steps : natural; pauses : boolean) is
      constant c_place : string := "axi_control: " & frame_t'image(kind) & ", frame of vectors";

      variable to_send : natural := vectors + 1; -- items: the last one is the end
      variable passed  : natural := 0; -- vectors that the shader took
      variable left    : natural := 0; -- clocks for which the shader works
      variable waits   : natural := 0; -- clocks since the last transfer, without those of a stall
      variable late    : natural := 0; -- clocks since the shader was idle
      variable resets  : boolean := false;
    begin
      loop
        random       := next_random(random);
        in_valid     <= to_flag(to_send > 0);
        in_end       <= to_flag(to_send = 1);
        in_cause     <= c_no_fault;
        if kind = has_bad_item and to_send = vectors then
          in_cause <= c_wrong_kind;
        end if;
        init_ready   <= to_flag(left = 0 and kind /= takes_nothing);
        busy         <= to_flag(left > 0);
        stalled      <= to_flag(pauses and left > 0 and random(3) = '1');
        shader_fault <= to_flag((kind = reports and passed > 1 and not resets) or (kind = reports_late and late > 7));
        wait until rising_edge(clk);
        check(c_place, vectors, "shader_reset", shader_reset, or cause);
        check(c_place, vectors, "init_valid in reset", init_valid and shader_reset, '0');
        exit when frame_end = '1';
        if stalled = '0' then
          waits := waits + 1;
        end if;
        assert waits < c_limit + 15 report c_place & " " & to_string(vectors) & ": hangs" severity failure;
        if left > 0 and stalled = '0' and kind /= stays_busy then
          left := left - 1;
        end if;
        if left = 0 and to_send = 0 then
          late := late + 1;
        end if;
        if init_valid = '1' and init_ready = '1' then
          passed := passed + 1;
          left   := steps;
        end if;
        if in_valid = '1' and in_ready = '1' then
          to_send := to_send - 1;
          waits   := 0;
        end if;
        if shader_reset = '1' then
          left   := 0;
          resets := true;
        end if;
      end loop;
      check(c_place, vectors, "vectors not taken", to_send, 0);
      check(c_place, vectors, "cause", cause, cause_of(kind));
      if kind = good then
        check(c_place, vectors, "vectors that the shader took", passed, vectors);
        if not pauses then
          check(c_place, vectors, "clocks between the end of the vectors and the frame's end", waits, steps + 8);
        end if;
      end if;
      -- The receiver takes the last transfer some clocks later.
      in_valid <= '1';
      for i in 1 to 3 loop
        wait until rising_edge(clk);
        check(c_place, vectors, "in_ready before done", in_ready, '0');
        check(c_place, vectors, "frame_end before done", frame_end, '1');
      end loop;
      in_valid     <= '0';
      shader_fault <= '0';
      done         <= '1';
      wait until rising_edge(clk);
      done <= '0';
    end procedure;
  begin
    wait_clocks(clk, 2);
    check("axi_control: clock", 2, "in_ready in reset", in_ready, '0');
    reset <= '0';
    wait until rising_edge(clk);
    for kind in frame_t loop
      for vectors in 2 to 5 loop
        for steps in 1 to c_limit - 10 loop
          draw(kind, vectors, steps, steps mod 3 = 2);
          draw(good, vectors, steps, false);
        end loop;
      end loop;
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "axi_control_tb");
end architecture;
