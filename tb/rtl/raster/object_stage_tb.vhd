-- SPDX-License-Identifier: Apache-2.0
-- Lines of all three rounds, often on a few columns, against the golden model. Three kinds of pass: full speed, in
-- which no clock may be lost; random stalls on both sides; a reset in the middle. Words of an input file: clear, token.
-- Words of an output file: the expected tokens.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.tb_pkg.all;

entity object_stage_tb is
  generic (g_folder : string := "object_stage");
end entity;

architecture sim of object_stage_tb is
begin
  presets : for exact in boolean generate
    constant c_stem : string := g_folder & "/" & preset_name(exact);

    -- A header, and a few more bits.
    constant c_bits : positive := pixel_channel_low(exact, 0) + 37;

    signal ended           : boolean := false;
    signal clk             : std_logic := '0';
    signal reset           : std_logic := '1';
    signal clear, in_valid : std_logic := '0';
    signal in_ready        : std_logic;
    signal in_token        : std_logic_vector(c_bits - 1 downto 0) := (others => '0');
    signal out_valid       : std_logic;
    signal out_ready       : std_logic := '0';
    signal out_token       : std_logic_vector(c_bits - 1 downto 0);
    signal busy, idle      : std_logic;
  begin
    dut : entity work.object_stage
      generic map (g_exact => exact, g_bits => c_bits)
      port map (
        clk       => clk,
        reset     => reset,
        clear     => clear,
        in_valid  => in_valid,
        in_ready  => in_ready,
        in_token  => in_token,
        out_valid => out_valid,
        out_ready => out_ready,
        out_token => out_token,
        busy      => busy,
        idle      => idle);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable inputs, outputs : vectors_t;

      -- One pass. With stalls, a token is offered in one of two clocks and accepted in one of two clocks. The pass ends
      -- with a reset after reset_at tokens; 0: no reset.
      procedure pass (seed : natural; stalls : boolean; reset_at : natural) is
        variable random   : unsigned(31 downto 0) := to_unsigned(seed, 32);
        variable token    : std_logic_vector(c_bits - 1 downto 0);
        variable held     : std_logic_vector(c_bits - 1 downto 0);
        variable clears   : std_logic;
        variable clearing : boolean := true;
        variable to_come  : boolean;
        variable offered  : boolean := false;
        variable waiting  : boolean := false;
        variable taken    : natural := 0;
        variable still    : natural := 0; -- clocks without a transfer

        procedure next_input is
        begin
          to_come := inputs.next_vector;
          if to_come then
            inputs.read_flag(clears);
            inputs.read_word(token);
          end if;
        end procedure;
      begin
        inputs.open_file(c_stem & "_in.txt");
        outputs.open_file(c_stem & "_out.txt");
        next_input;
        loop
          random := next_random(random);
          -- A clear is given between tokens, with no token offered.
          if to_come and clears = '1' and in_valid = '0' and idle = '1' then
            clear    <= '1';
            in_valid <= '0';
            wait until rising_edge(clk);
            clear    <= '0';
            clearing := true;
            next_input;
          end if;
          offered   := to_come and clears = '0' and (offered or not stalls or random(9) = '1');
          in_valid  <= to_flag(offered);
          in_token  <= token;
          out_ready <= to_flag(not stalls or random(20) = '1');
          wait until rising_edge(clk);
          still := still + 1;
          assert still < 2 ** (formats(true).pixel_x.bits + 1)
            report c_stem & ": nothing moves after " & to_string(taken) & " tokens" severity failure;

          if in_ready = '1' then
            clearing := false;
          elsif not stalls and not clearing then
            inputs.fail("is not taken at once");
          end if;
          assert idle = (not busy and in_ready)
            report c_stem & ": idle is " & to_string(idle) & ", busy " & to_string(busy) & ", in_ready "
            & to_string(in_ready)
            severity failure;
          if waiting and out_valid = '0' then
            outputs.fail("is withdrawn");
          end if;
          if out_valid = '1' then
            if busy /= '1' then
              outputs.fail("not busy with this token");
            end if;
            if waiting then
              if out_token /= held then
                outputs.fail("changes while it waits");
              end if;
            else
              outputs.expect_vector("token");
              outputs.check("token", out_token);
            end if;
            held := out_token;
            still := 0;
          end if;
          waiting := out_valid = '1' and out_ready = '0';
          if in_valid = '1' and in_ready = '1' then
            taken   := taken + 1;
            offered := false;
            still   := 0;
            exit when taken = reset_at;
            next_input;
          elsif not to_come then
            exit when busy = '0';
          end if;
        end loop;
        in_valid <= '0';
        if taken = reset_at then
          reset <= '1';
        elsif outputs.next_vector then
          outputs.fail("this token did not leave");
        end if;
        inputs.close_file;
        outputs.close_file;
        wait until rising_edge(clk);
        reset <= '0';
        wait until rising_edge(clk);
        assert busy = '0' and out_valid = '0' report c_stem & ": busy with nothing" severity failure;
      end procedure;
    begin
      wait until rising_edge(clk);
      reset <= '0';
      pass(3, false, 0);
      pass(5, true, 500);
      pass(7, true, 0);
      pass(9, false, 600);
      pass(11, false, 0);
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "object_stage_tb");
end architecture;
