-- SPDX-License-Identifier: Apache-2.0
-- Tokens of all kinds through all steps of the schedule: one after the other, then with random pauses before and after
-- them. Each input is 'X' in the clocks in which the contract does not read it.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity token_register_tb is
  generic (g_folder : string := "token_register");
end entity;

architecture sim of token_register_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
    constant c_shape   : shape_t    := shape(c_config, c_kind, c_light);

    -- Bits of a product of an ambient processor, and of the others.
    function product_word_bits return positive is
    begin
      if c_kind = c_ambient then
        return c_formats.coefficient.bits + c_formats.light_intensity.bits;
      end if;
      return product_bits(c_config.exact);
    end function;

    constant c_bits  : positive := shared_product_bits(c_config, c_kind, c_light);
    constant c_words : positive := product_bits(c_config.exact); -- in the file

    signal ended        : boolean := false;
    signal clk          : std_logic := '0';
    signal take, object : std_logic := '0';
    signal in_token     : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => 'X');
    signal cycle        : natural range 0 to c_at.leave := 0;
    signal defined      : std_logic := '0';
    signal unit         : std_logic_vector(c_axes * c_formats.direction.bits - 1 downto 0) := (others => 'X');
    signal products     : std_logic_vector(c_axes * c_bits - 1 downto 0) := (others => 'X');
    signal token        : std_logic_vector(in_token'range);
  begin
    dut : entity work.token_register
      generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
      port map (
        clk      => clk,
        take     => take,
        object   => object,
        in_token => in_token,
        cycle    => cycle,
        defined  => defined,
        unit     => unit,
        products => products,
        token    => token);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable vectors        : vectors_t;
      variable random         : unsigned(31 downto 0) := to_unsigned(c_at.leave, 32);
      variable is_object      : std_logic;
      variable token_now      : std_logic_vector(token'range);
      variable held           : std_logic_vector(token'range);
      variable unit_1, unit_2 : std_logic_vector(unit'range);
      variable words          : std_logic_vector(c_axes * c_words - 1 downto 0);

      -- The products' bits that the register reads.
      impure function read_bits return std_logic_vector is
        variable result : std_logic_vector(c_axes * product_word_bits - 1 downto 0);
      begin
        for axis in 0 to c_axes - 1 loop
          result((axis + 1) * product_word_bits - 1 downto axis * product_word_bits) :=
            words(axis * c_words + product_word_bits - 1 downto axis * c_words);
        end loop;
        return result;
      end function;

      procedure clock (step : natural) is
      begin
        cycle    <= step;
        unit     <= (others => 'X');
        products <= (others => 'X');
        if c_shape.first and step = c_at.round_1 then
          unit <= unit_1;
        elsif c_shape.second and step = c_at.round_2 then
          unit <= unit_2;
        end if;
        if step = c_at.add then
          products <= spaced(read_bits, c_bits);
        end if;
        wait until rising_edge(clk);
      end procedure;

      procedure pass (stalls : boolean) is
      begin
        vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
        while vectors.next_vector loop
          vectors.read_flag(is_object);
          vectors.drive(defined);
          vectors.read_word(token_now);
          vectors.read_word(unit_1);
          vectors.read_word(unit_2);
          vectors.read_word(words);
          -- Without take the register keeps its token
          if stalls then
            held := token;
            pause(clk, random, 1);
            if token /= held then
              vectors.fail("changes before it is taken");
            end if;
          end if;
          take     <= '1';
          object   <= is_object;
          in_token <= token_now;
          cycle    <= 0;
          wait until rising_edge(clk);
          take     <= '0';
          object   <= 'X';
          in_token <= (others => 'X');
          if is_object = '1' then
            clock(1);
            vectors.check("token taken", token);
            for step in 2 to c_at.leave - 1 loop
              clock(step);
            end loop;
          end if;
          clock(c_at.leave);
          if is_object = '0' then
            vectors.check("token taken", token);
          end if;
          if stalls then
            pause(clk, random, 1);
          end if;
          vectors.check("token", token);
          cycle <= 0;
        end loop;
        vectors.close_file;
      end procedure;
    begin
      pass(stalls => false);
      pass(stalls => true);
      ended    <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "token_register_tb");
end architecture;
