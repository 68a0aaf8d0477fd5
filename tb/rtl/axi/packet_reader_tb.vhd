-- SPDX-License-Identifier: Apache-2.0
-- Random packets on both widths of the bus: vectors of each kind, ends of frames, unknown kinds, wrong lengths, and
-- packets that in_last cuts off. Each must be one item, with its cause. A vector must contain its words, and zero above
-- them. The item must come 2 clocks after the packet's last word, and a packet of n bus words take n + 2 clocks at
-- full speed. With random stalls an item that waits must not change.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.tb_pkg.all;

entity packet_reader_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of packet_reader_tb is
  constant c_bits    : positive := 150;
  constant c_lengths : packet_lengths_t := (
    c_triangle_packet => 5, c_record_packet => 2, c_load_packet => 0, c_walk_packet => 4
    );
  constant c_packets : positive := 4000;
begin
  bus_runs : for lanes in 1 to 2 generate
    signal ended               : boolean   := false;
    signal clk                 : std_logic := '0';
    signal reset               : std_logic := '1';
    signal in_valid, in_last   : std_logic := '0';
    signal in_ready, out_valid : std_logic;
    signal in_data             : std_logic_vector(lanes * c_word_bits - 1 downto 0) := (others => '0');
    signal out_ready           : std_logic := '0';
    signal out_end             : std_logic;
    signal out_cause           : cause_t;
    signal out_vector          : std_logic_vector(c_bits - 1 downto 0);
  begin
    dut : entity work.packet_reader
      generic map (g_bits => c_bits, g_lengths => c_lengths, g_bus_bits => lanes * c_word_bits)
      port map (
        clk        => clk,
        reset      => reset,
        in_valid   => in_valid,
        in_ready   => in_ready,
        in_data    => in_data,
        in_last    => in_last,
        out_valid  => out_valid,
        out_ready  => out_ready,
        out_end    => out_end,
        out_cause  => out_cause,
        out_vector => out_vector);

    clk <= not clk after c_half_period when not ended;

    run : process is
      constant c_place : string := "packet_reader, bus of " & to_string(lanes * c_word_bits) & " bits: packet";

      variable random : unsigned(31 downto 0) := to_unsigned(5, 32);

      -- A packet of `number`, and its item. With `pauses` both ends pause at random.
      procedure send (number : natural; pauses : boolean) is
        variable kind, length, expected : natural;
        variable words                  : natural; -- in pairs, as the length announces
        variable sent                   : natural; -- bus words, fewer if it is cut off
        variable cause                  : cause_t := c_no_fault;
        variable vector                 : std_logic_vector(191 downto 0) := (others => '0');
        variable bus_words              : std_logic_vector(9 * 64 - 1 downto 0) := (others => '0');
        variable item                   : std_logic_vector(c_bits + 3 downto 0);
      begin
        random := next_random(random);
        kind   := to_integer(random(2 downto 0));
        if random(10 downto 6) = 0 then
          kind := kind + 2 ** to_integer(random(5 downto 3) + 3);
        end if;
        expected := 0;
        if kind >= c_triangle_packet and kind <= c_walk_packet then
          expected := c_lengths(kind);
        end if;
        if kind /= c_end_packet and expected = 0 then
          cause := c_wrong_kind;
        end if;
        length := expected;
        if random(13 downto 11) = 0 then
          length := to_integer(random(17 downto 14));
          if length /= expected and cause = c_no_fault then
            cause := c_wrong_length;
          end if;
        end if;

        -- A packet is a whole number of pairs of words.
        words := length / 2 * 2 + 2;
        bus_words(15 downto 0)  := std_logic_vector(to_unsigned(kind, 16));
        bus_words(31 downto 16) := std_logic_vector(to_unsigned(length, 16));
        for word in 1 to length loop
          random := next_random(random);
          bus_words((word + 1) * 32 - 1 downto word * 32) := std_logic_vector(random);
        end loop;
        if cause = c_no_fault then
          vector(length * 32 - 1 downto 0) := bus_words((length + 1) * 32 - 1 downto 32);
        end if;
        random := next_random(random);
        sent := words / lanes;
        if random(2 downto 0) = 0 and sent > 1 then
          sent := 1 + to_integer(random(10 downto 3)) mod (sent - 1);
          if cause = c_no_fault then
            cause := c_wrong_length;
          end if;
        end if;
        in_last <= '0';
        for beat in 0 to sent - 1 loop
          if pauses then
            in_valid <= '0';
            pause(clk, random, 1);
          end if;
          random   := next_random(random);
          in_valid <= '1';
          in_data  <= bus_words((beat + 1) * lanes * 32 - 1 downto beat * lanes * 32);
          -- The last word of a whole packet may have in_last.
          in_last  <= to_flag(beat = sent - 1 and (sent < words / lanes or random(0) = '1'));
          wait until rising_edge(clk) and in_ready = '1';
          check(c_place, number, "out_valid before the last word", out_valid, '0');
        end loop;
        in_valid  <= '0';
        in_last   <= '0';
        out_ready <= to_flag(not pauses);
        wait until rising_edge(clk);
        check(c_place, number, "out_valid 1 clock after the last word", out_valid, '0');
        check(c_place, number, "in_ready 1 clock after the last word", in_ready, '0');
        loop
          wait until rising_edge(clk);
          check(c_place, number, "out_valid", out_valid, '1');
          check(c_place, number, "in_ready while an item waits", in_ready, '0');
          item := out_cause & out_end & out_vector;
          check(c_place, number, "cause", out_cause, cause);
          if cause = c_no_fault then
            check(c_place, number, "end", out_end, to_flag(kind = c_end_packet));
            if kind /= c_end_packet then
              check(c_place, number, "vector", out_vector, vector(c_bits - 1 downto 0));
            end if;
          end if;
          exit when out_ready = '1';
          random    := next_random(random);
          out_ready <= random(0);
        end loop;
        out_ready <= '0';
      end procedure;
    begin
      wait_clocks(clk, 2);
      check(c_place, 0, "in_ready in reset", in_ready, '0');
      check(c_place, 0, "out_valid in reset", out_valid, '0');
      reset <= '0';
      wait until rising_edge(clk);
      for number in 1 to c_packets loop
        send(number, number > c_packets / 2);
        if number mod 1000 = 7 then
          -- A reset in the middle of a packet.
          in_valid <= '1';
          in_data  <= std_logic_vector(to_unsigned(c_triangle_packet, in_data'length));
          wait until rising_edge(clk) and in_ready = '1';
          in_valid <= '0';
          reset    <= '1';
          wait until rising_edge(clk);
          reset <= '0';
          wait until rising_edge(clk);
          check(c_place, number, "out_valid after a reset", out_valid, '0');
        end if;
      end loop;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "packet_reader_tb");
end architecture;
