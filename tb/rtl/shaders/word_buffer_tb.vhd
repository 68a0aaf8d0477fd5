-- SPDX-License-Identifier: Apache-2.0
-- Both presets. Random vectors are read and started at random times, from the earliest that the contract allows. In the
-- clock in which the interpolators load a part, the words must be those of the started vector.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.skew_pkg.all;
use work.tb_pkg.all;

entity word_buffer_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of word_buffer_tb is
  constant c_vectors : positive := 500;
  constant c_parts   : positive := 2;
begin
  presets : for exact in boolean generate
    constant c_channels     : positive := 1 + 2 * boolean'pos(exact);
    constant c_depth_low    : positive := init_header(exact).z.low;
    constant c_channels_low : positive := init_bits(exact, 0);

    subtype vector_t is std_logic_vector(init_bits(exact, c_channels) - 1 downto 0);

    type vectors_t is array (natural range <>) of vector_t;

    -- Mask of one part of all words.
    function part_mask (part : natural) return vector_t is
      variable mask : vector_t := (others => '0');

      procedure add_words (low, high, bits : natural) is
      begin
        for bit in low to high loop
          if (bit - low) mod bits >= part_low(bits, c_parts, part) and (bit - low) mod bits < part_low(bits, c_parts, part + 1) then
            mask(bit) := '1';
          end if;
        end loop;
      end procedure;
    begin
      add_words(c_depth_low, c_channels_low - 1, formats(exact).depth_sum.bits);
      add_words(c_channels_low, vector_t'high, formats(exact).intensity.bits);
      return mask;
    end function;

    signal ended    : boolean := false;
    signal clk      : std_logic := '0';
    signal reset    : std_logic := '1';
    signal in_valid : std_logic := '0';
    signal in_data  : vector_t := (others => '0');
    signal start    : std_logic := '0';
    signal out_data : vector_t;
  begin
    dut : entity work.word_buffer
      generic map (g_exact => exact, g_channels => c_channels, g_parts => c_parts)
      port map (
        clk      => clk,
        reset    => reset,
        in_valid => in_valid,
        in_data  => in_data,
        start    => start,
        out_data => out_data);

    clk <= not clk after c_half_period when not ended;

    run : process is
      variable random   : unsigned(31 downto 0) := x"92D68CA2";
      variable word     : unsigned(vector_t'range);
      variable current  : vector_t;             -- the next vector to start
      variable started  : vectors_t(1 to c_parts); -- the vector started one clock ago, two clocks ago, ...
      variable starts   : std_logic_vector(1 to c_parts) := (others => '0');
      variable expected : vector_t;
      variable got      : vector_t;
      variable checks   : natural := 0;

      -- Wait one clock, then compare the words that the interpolators load.
      procedure clock is
      begin
        wait until rising_edge(clk);
        for part in 0 to c_parts - 1 loop
          expected := started(part + 1) and part_mask(part);
          got := out_data and part_mask(part);
          if starts(part + 1) = '1' and got /= expected then
            report "word_buffer: check " & to_string(checks) & ": part " & to_string(part) & " is " & to_hstring(got)
              & ", expected " & to_hstring(expected)
              severity failure;
          end if;
          checks := checks + 1;
        end loop;
        starts := start & starts(1 to c_parts - 1);
        started := current & started(1 to c_parts - 1);
      end procedure;

      -- Wait zero to three clocks.
      procedure wait_at_random is
      begin
        random := next_random(random);
        if chance(random(7 downto 0), 1) then
          for i in 1 to to_integer(random(10 downto 9)) loop
            clock;
          end loop;
        end if;
      end procedure;

      procedure start_triangle is
      begin
        start <= '1';
        clock;
        start <= '0';
      end procedure;

      procedure next_vector is
      begin
        draw_word(random, word);
        in_data  <= std_logic_vector(word);
        in_valid <= '1';
      end procedure;
    begin
      clock;
      reset <= '0';
      next_vector;
      for vector in 1 to c_vectors loop
        clock;
        current := in_data;
        wait_at_random;
        -- Start the triangle in the last clock of its vector, or when the next vector is available.
        random := next_random(random);
        if chance(random(7 downto 0), 1) then
          start_triangle;
          in_valid <= '0';
          in_data  <= (others => 'X');
          wait_at_random;
          next_vector;
        else
          clock;
          next_vector;
          wait_at_random;
          start_triangle;
        end if;
      end loop;
      clock;
      clock;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "word_buffer_tb");
end architecture;
