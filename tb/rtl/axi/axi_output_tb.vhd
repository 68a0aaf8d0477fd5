-- SPDX-License-Identifier: Apache-2.0
-- Frames of 0 to 7 numbered words, at full speed and with random stalls at both ends, and a reset in the middle. Every
-- word must come out once, in order, the last one of a frame with out_last, and at full speed one clock after the next
-- word came. A transfer that waits must not change.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity axi_output_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of axi_output_tb is
  constant c_bits   : positive := 16;
  constant c_frames : positive := 400;

  signal clk                       : std_logic := '0';
  signal reset                     : std_logic := '1';
  signal in_valid                  : std_logic := '0';
  signal in_ready                  : std_logic;
  signal in_data                   : std_logic_vector(c_bits - 1 downto 0) := (others => '0');
  signal frame_end                 : std_logic := '0';
  signal out_valid                 : std_logic;
  signal out_ready                 : std_logic := '0';
  signal out_data                  : std_logic_vector(c_bits - 1 downto 0);
  signal out_last, out_empty, done : std_logic;
  signal ended                     : boolean := false;
begin
  dut : entity work.axi_output
    generic map (g_bits => c_bits)
    port map (
      clk       => clk,
      reset     => reset,
      in_valid  => in_valid,
      in_ready  => in_ready,
      in_data   => in_data,
      frame_end => frame_end,
      out_valid => out_valid,
      out_ready => out_ready,
      out_data  => out_data,
      out_last  => out_last,
      out_empty => out_empty,
      done      => done);

  clk <= not clk after c_half_period when not ended;

  run : process is
    variable random : unsigned(31 downto 0) := to_unsigned(7, 32);

    -- One frame of `words` words. in_valid is '1' in one of 2**in_pause clocks, out_ready in one of 2**out_pause.
    procedure draw (frame, words, in_pause, out_pause : natural) is
      variable sent, got, clocks : natural := 0;
      variable offered, waiting  : boolean := false;
      variable held              : std_logic_vector(c_bits + 1 downto 0);
    begin
      loop
        random    := next_random(random);
        offered   := sent < words and (offered or chance(random(19 downto 12), in_pause));
        in_valid  <= to_flag(offered);
        in_data   <= std_logic_vector(to_unsigned(16 * frame + sent, c_bits));
        frame_end <= to_flag(sent = words);
        out_ready <= to_flag(chance(random(30 downto 23), out_pause));
        wait until rising_edge(clk);
        clocks := clocks + 1;
        if in_pause = 0 and out_pause = 0 then
          check("axi_output: frame", frame, "in_ready", in_ready, '1');
          check("axi_output: frame", frame, "out_valid", out_valid, to_flag(clocks > 2 or words = 0 or sent = words));
        end if;
        if waiting then
          check("axi_output: frame", frame, "a transfer that waits", out_last & out_empty & out_data, held);
        end if;
        if out_valid = '1' then
          check("axi_output: frame", frame, "out_empty", out_empty, to_flag(words = 0));
          check("axi_output: frame", frame, "out_last", out_last, to_flag(sent = words and got + 1 >= words));
          if words > 0 then
            check("axi_output: frame", frame, "out_data", out_data, std_logic_vector(to_unsigned(16 * frame + got, c_bits)));
          end if;
        end if;
        check("axi_output: frame", frame, "out_valid that stays", out_valid or not to_flag(waiting), '1');
        check("axi_output: frame", frame, "done", done, out_valid and out_ready and out_last);
        held    := out_last & out_empty & out_data;
        waiting := out_valid = '1' and out_ready = '0';
        if in_valid = '1' and in_ready = '1' then
          sent    := sent + 1;
          offered := false;
        end if;
        if out_valid = '1' and out_ready = '1' then
          got := got + 1;
          exit when out_last = '1';
        end if;
        assert clocks < 10_000 report "axi_output: frame " & to_string(frame) & " does not end" severity failure;
      end loop;
      frame_end <= '0';
    end procedure;
  begin
    wait_clocks(clk, 2);
    reset <= '0';
    wait until rising_edge(clk);
    check("axi_output: frame", 0, "in_ready after a reset", in_ready, '0');
    for frame in 0 to c_frames - 1 loop
      draw(frame, frame mod 8, frame / 8 mod 3, frame / 24 mod 3);
    end loop;
    -- Words that a reset discards.
    in_valid  <= '1';
    out_ready <= '0';
    wait_clocks(clk, 5);
    check("axi_output: frame", c_frames, "in_ready of a full entity", in_ready, '0');
    in_valid <= '0';
    reset    <= '1';
    wait until rising_edge(clk);
    reset <= '0';
    wait until rising_edge(clk);
    check("axi_output: frame", c_frames, "out_valid after a reset", out_valid, '0');
    draw(c_frames, 5, 0, 0);
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "axi_output_tb");
end architecture;
