-- SPDX-License-Identifier: Apache-2.0
-- Every combination of a token's inputs, in every processor: at full speed, with random stalls on both sides, and with
-- resets. The clocks are those of table 4 (tb/vectors/folded.cpp); a token takes, in order, one step of the schedule
-- per clock, and only those that it needs. An input is inverted in the clocks in which the contract does not read it.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity shading_sequence_tb is
  generic (g_folder : string := "shading_sequence");
end entity;

architecture sim of shading_sequence_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config : config_t   := c_processors(i).config;
    constant c_kind   : natural    := c_processors(i).kind;
    constant c_light  : natural    := c_processors(i).light;
    constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_shape : shape_t    := shape(c_config, c_kind, c_light);

    subtype cycle_t is natural range 0 to c_at.leave;

    -- What a token needs: the first and the second unit vector, the factor of a cone.
    type needs_t is record
      first, second, cone : std_logic;
    end record;

    signal ended                          : boolean := false;
    signal clk                            : std_logic := '0';
    signal reset                          : std_logic := '1';
    signal take                           : std_logic := '0';
    signal object, normalize, defined     : std_logic;
    signal positional, spot               : std_logic := '0';
    signal lit, above                     : std_logic;
    signal leave                          : std_logic := '1';
    signal taken                          : std_logic;
    signal cycle                          : cycle_t;
    signal token_object                   : std_logic := '0'; -- inputs of the token
    signal token_normalize, token_defined : std_logic := '0';
    signal token_lit, token_above         : std_logic := '0';

    function is_needed (step : positive; needs : needs_t) return boolean is
    begin
      if c_kind = c_ambient then
        if c_shape.second then
          return step >= c_at.shift_2 or needs.first = '1';
        end if;
        return (step >= c_at.reflect and step <= c_at.add) or needs.first = '1';
      elsif step >= c_at.weigh_in and step < c_at.weigh then
        return needs.cone = '1';
      elsif c_shape.second and step >= c_at.sum_2 and step < c_at.cosine then
        return needs.second = '1';
      end if;
      return step >= c_at.cosine or needs.first = '1';
    end function;

    -- The next step that the token needs, c_at.leave after the last one.
    function next_step (step : cycle_t; needs : needs_t) return cycle_t is
    begin
      for later in step + 1 to c_at.leave - 1 loop
        if is_needed(later, needs) then
          return later;
        end if;
      end loop;
      return c_at.leave;
    end function;
  begin
    dut : entity work.shading_sequence
      generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
      port map (
        clk             => clk,
        reset           => reset,
        take            => take,
        object          => object,
        normalize       => normalize,
        defined         => defined,
        positional      => positional,
        spot            => spot,
        lit             => lit,
        normalize_token => token_normalize,
        above           => above,
        leave           => leave,
        taken           => taken,
        cycle           => cycle);

    clk <= not clk after c_half_period when not ended;

    object    <= token_object xor not take;
    normalize <= token_normalize xor not take;
    defined   <= token_defined xor not take;
    lit       <= token_lit xor not taken;
    above     <= token_above when cycle = c_at.horizon else not token_above;

    run : process is
      variable vectors  : vectors_t;
      variable random   : unsigned(31 downto 0) := to_unsigned(c_at.leave, 32);
      variable number   : natural;      -- clocks of the token so far
      variable reset_at : natural := 0; -- the clock that ends with a reset; 0: none

      -- End the clock in which the token is at `step`.
      procedure clock (step : cycle_t) is
      begin
        reset <= to_flag(number + 1 = reset_at);
        wait until rising_edge(clk);
        number := number + 1;
        if cycle /= step then
          vectors.fail("clock " & to_string(number) & ": cycle is " & to_string(cycle) & ", expected " & to_string(step));
        end if;
        if taken /= (token_object and to_flag(number = 2)) then
          vectors.fail("clock " & to_string(number) & ": taken is " & to_string(taken));
        end if;
      end procedure;

      -- The same for a random number of clocks.
      procedure stall (step : cycle_t) is
      begin
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 1);
          clock(step);
        end loop;
      end procedure;

      procedure pass (stalls, resets : boolean) is
        variable clocks   : positive := c_at.leave;
        variable needs    : needs_t;
        variable complete : std_logic; -- no needed step is left out at the end
        variable step     : cycle_t;
      begin
        vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
        while vectors.next_vector loop
          -- Offer the token
          if stalls then
            number := clocks;
            stall(0);
          end if;
          vectors.drive(token_object);
          vectors.drive(token_normalize);
          vectors.drive(token_defined);
          vectors.drive(positional);
          vectors.drive(spot);
          vectors.drive(token_lit);
          vectors.drive(token_above);
          clocks := vectors.read_number;
          vectors.read_flag(needs.first);
          vectors.read_flag(needs.second);
          vectors.read_flag(needs.cone);
          vectors.read_flag(complete);
          if resets then
            random   := next_random(random);
            reset_at := 1 + to_integer(random(30 downto 16)) mod (clocks - 1);
          end if;
          number := 0;
          step   := 0;
          take   <= '1';
          clock(step);
          take   <= '0';
          -- Follow its steps
          while number < clocks - 1 and number /= reset_at loop
            step := next_step(step, needs);
            clock(step);
          end loop;
          if resets then
            number := clocks;
            clock(0);
          else
            -- Hand it on
            if complete = '1' and next_step(step, needs) /= c_at.leave then
              vectors.fail("leaves before step " & to_string(next_step(step, needs)));
            end if;
            if stalls then
              leave <= '0';
              stall(c_at.leave);
              leave <= '1';
            end if;
            clock(c_at.leave);
          end if;
        end loop;
        vectors.close_file;
      end procedure;
    begin
      wait until rising_edge(clk);
      reset <= '0';
      wait until rising_edge(clk);
      pass(stalls => false, resets => false);
      pass(stalls => true, resets => false);
      pass(stalls => false, resets => true);
      ended    <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "shading_sequence_tb");
end architecture;
