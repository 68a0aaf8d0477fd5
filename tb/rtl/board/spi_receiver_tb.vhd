-- SPDX-License-Identifier: Apache-2.0
-- A host at the fastest clock and at random slower ones sends good packets, and packets with every kind of fault: each
-- bit of a packet wrong, too short, too long, unknown commands, no room, an end of frame while another is under way, a
-- stop in the middle. Every good vector comes out once, unchanged, and no other; the status byte reports what happened,
-- once. The CRC is computed by a second method, long division of the whole message, which gives 29B1 for "123456789".
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

entity spi_receiver_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of spi_receiver_tb is
  -- whole bytes, and padded
  constant c_init_bits : integer_vector := (24, 37);
begin
  forms : for form in c_init_bits'range generate
    constant c_bytes : positive := (c_init_bits(form) + 7) / 8;

    -- A message, its first bit on the left.
    subtype message_t is std_logic_vector;

    -- The remainder of the message times x**16, with the first 16 bits inverted, by the polynomial.
    function crc (message : message_t) return std_logic_vector is
      variable rest : std_logic_vector(0 to message'length + 15) := message & x"0000";
    begin
      rest(0 to 15) := not rest(0 to 15);
      for i in 0 to message'length - 1 loop
        if rest(i) = '1' then
          rest(i to i + 16) := rest(i to i + 16) xor '1' & x"1021";
        end if;
      end loop;
      return rest(message'length to message'length + 15);
    end function;

    signal ended                : boolean := false;
    signal clk                  : std_logic := '0';
    signal reset, select_n      : std_logic := '1';
    signal sck, data_in         : std_logic := '0';
    signal pin_select_n         : std_logic := '1';
    signal pin_clock, pin_data  : std_logic := '0';
    signal data_out, init_valid : std_logic;
    signal init_ready           : std_logic := '1';
    signal init_data            : std_logic_vector(c_init_bits(form) - 1 downto 0);
    signal frame_end            : std_logic;
    signal background           : std_logic_vector(15 downto 0);
    signal ending, fault        : std_logic := '0';
    signal shown                : unsigned(3 downto 0) := "0101";

    signal vectors, ends             : natural := 0; -- that came out
    signal last_vector     : std_logic_vector(init_data'range);
    signal last_background : std_logic_vector(15 downto 0);
  begin
    dut : entity work.spi_receiver
      generic map (g_init_bits => c_init_bits(form))
      port map (
        clk        => clk,
        reset      => reset,
        select_n   => pin_select_n,
        clock      => pin_clock,
        data_in    => pin_data,
        data_out   => data_out,
        init_valid => init_valid,
        init_ready => init_ready,
        init_data  => init_data,
        frame_end  => frame_end,
        background => background,
        ending     => ending,
        fault      => fault,
        shown      => shown);

    clk <= not clk after c_half_period when not ended;

    -- The registers at the pins.
    pins : process (clk) is
    begin
      if rising_edge(clk) then
        pin_select_n <= select_n;
        pin_clock    <= sck;
        pin_data     <= data_in;
      end if;
    end process;

    receive : process (clk) is
      variable waiting : boolean := false;
      variable valid_before : boolean := false;
      variable held    : std_logic_vector(init_data'range);
      variable since   : natural := 0; -- clocks with pin_select_n = '1', this one included
    begin
      if rising_edge(clk) and reset = '0' then
        since := since + 1;
        if pin_select_n = '0' then
          since := 0;
        end if;
        assert not (frame_end = '1' or (init_valid = '1' and not valid_before)) or since = 3
          report "spi_receiver_tb: the packet comes out after " & to_string(since - 1) & " clocks, expected 2"
          severity failure;
        valid_before := init_valid = '1';
        assert not waiting or (init_valid = '1' and init_data = held)
          report "spi_receiver_tb: a vector that waits changes" severity failure;
        waiting := init_valid = '1' and init_ready = '0';
        held    := init_data;
        if init_valid = '1' and init_ready = '1' then
          vectors     <= vectors + 1;
          last_vector <= init_data;
        end if;
        if frame_end = '1' then
          ends            <= ends + 1;
          last_background <= background;
        end if;
      end if;
    end process;

    run : process is
      constant c_fastest : time := 4 * 2 * c_half_period; -- period of the SPI clock

      variable random                 : unsigned(31 downto 0) := to_unsigned(c_init_bits(form), 32);
      variable period                 : time := c_fastest;
      variable status                 : std_logic_vector(7 downto 0);
      variable good_vectors, good_ends : natural := 0;

      -- Send the bits of one packet and receive its status.
      procedure send (bits : message_t) is
      begin
        select_n <= '0';
        wait for 6 * 2 * c_half_period;
        for i in bits'range loop
          data_in <= bits(i);
          wait for period / 2;
          if i - bits'low < 8 then
            status := status(6 downto 0) & data_out;
          else
            assert data_out = '0' report "spi_receiver_tb: data after the status" severity failure;
          end if;
          sck <= '1';
          wait for period / 2;
          sck <= '0';
        end loop;
        wait for 2 * 2 * c_half_period;
        select_n <= '1';
        wait for 6 * 2 * c_half_period;
        -- From now on at any phase to clk.
        random := next_random(random);
        wait for to_integer(random(4 downto 0)) * 1 ns;
      end procedure;

      procedure expect (what : string; expected : std_logic_vector(7 downto 0)) is
      begin
        assert status = expected
          report "spi_receiver_tb: " & what & ": status " & to_string(status) & ", expected " & to_string(expected)
          severity failure;
        assert vectors = good_vectors and ends = good_ends
          report "spi_receiver_tb: " & what & ": " & to_string(vectors) & " vectors and " & to_string(ends)
          & " ends, expected " & to_string(good_vectors) & " and " & to_string(good_ends)
          severity failure;
      end procedure;

      -- Read the status; flags: fault, error.
      procedure expect_status (what : string; room, under_way, fault_flag, error_flag : std_logic) is
      begin
        send(x"00");
        expect(what, room & under_way & fault_flag & error_flag & std_logic_vector(shown));
      end procedure;

      impure function drawn_vector return std_logic_vector is
        variable bits : std_logic_vector(8 * c_bytes - 1 downto 0);
      begin
        for i in bits'range loop
          random  := next_random(random);
          bits(i) := random(9);
        end loop;
        return bits;
      end function;

      variable payload : std_logic_vector(8 * c_bytes - 1 downto 0);

      impure function vector_packet return message_t is
      begin
        return x"01" & payload & crc(x"01" & payload);
      end function;

      impure function end_packet (colour : std_logic_vector(15 downto 0)) return message_t is
      begin
        return x"02" & colour & crc(x"02" & colour);
      end function;

      procedure send_good_vector (what : string) is
      begin
        payload := drawn_vector;
        send(vector_packet);
        good_vectors := good_vectors + 1;
        expect(what, "1000" & std_logic_vector(shown));
        assert last_vector = payload(c_init_bits(form) - 1 downto 0)
          report "spi_receiver_tb: " & what & ": another vector comes out" severity failure;
      end procedure;

      -- A damaged packet is reported by the next status byte, and by no other.
      procedure send_bad (what : string; bits : message_t) is
      begin
        send(bits);
        if bits'length >= 8 then
          expect(what, "1000" & std_logic_vector(shown));
        end if;
        expect_status(what & ", then", '1', '0', '0', '1');
        expect_status(what & ", then again", '1', '0', '0', '0');
      end procedure;

      variable packet : std_logic_vector(0 to 8 * c_bytes + 23);
    begin
      assert crc(x"313233343536373839") = x"29B1"
        report "spi_receiver_tb: the testbench's CRC is wrong" severity failure;
      wait_clocks(clk, 5);
      reset <= '0';
      wait for 20 ns;
      expect_status("after reset", '1', '0', '0', '0');

      for i in 1 to 20 loop
        period := c_fastest + to_integer(random(7 downto 0)) * 1 ns * (i mod 2);
        send_good_vector("vector");
        send(end_packet(std_logic_vector(random(15 downto 0))));
        good_ends := good_ends + 1;
        expect("end of frame", "1000" & std_logic_vector(shown));
        shown <= shown + 1;
        wait for 0 ns;
      end loop;
      period := c_fastest;

      -- Every wrong bit, and every wrong length up to two bytes too long.
      payload := drawn_vector;
      packet  := vector_packet;
      for i in packet'range loop
        packet(i) := not packet(i);
        send_bad("bit " & to_string(i) & " wrong", packet);
        packet(i) := not packet(i);
      end loop;
      for length in 1 to packet'length - 1 loop
        send_bad(to_string(length) & " bits", packet(0 to length - 1));
      end loop;
      send_bad("one bit more", packet & '0');
      send_bad("one byte more", packet & x"00");
      send_bad("twice", packet & packet);
      send_bad("nothing but zeros", (1 to 4200 => '0'));
      packet(0 to 39) := end_packet(x"1234");
      for i in 0 to 39 loop
        packet(i) := not packet(i);
        send_bad("end of frame: bit " & to_string(i) & " wrong", packet(0 to 39));
        packet(i) := not packet(i);
      end loop;
      send_bad("end of frame with two bytes more", end_packet(x"1234") & x"0000");
      send_bad("unknown command", x"03" & crc(x"03"));
      send_bad("status with a byte more", x"0000");

      -- Select without a clock is no packet.
      send(std_logic_vector'(""));
      expect_status("no bits", '1', '0', '0', '0');

      -- No room: the packet is dropped, the vector that waits stays.
      init_ready <= '0';
      payload    := drawn_vector;
      send(vector_packet);
      expect("with room", "1000" & std_logic_vector(shown));
      expect_status("while it waits", '0', '0', '0', '0');
      payload := not payload;
      send(vector_packet);
      expect("without room", "0000" & std_logic_vector(shown));
      payload := not payload;
      expect_status("dropped without room", '0', '0', '0', '1');
      send(end_packet(x"5555"));
      good_ends := good_ends + 1;
      expect("end of frame while a vector waits", "0000" & std_logic_vector(shown));
      assert last_background = x"5555" report "spi_receiver_tb: wrong background" severity failure;
      ending <= '1';
      expect_status("end under way", '0', '1', '0', '0');
      init_ready   <= '1';
      wait for 4 * 2 * c_half_period;
      good_vectors := good_vectors + 1;
      assert last_vector = payload(c_init_bits(form) - 1 downto 0)
        report "spi_receiver_tb: the vector that waited has changed" severity failure;
      expect_status("vector taken, end under way", '0', '1', '0', '0');
      send(vector_packet);
      expect("vector while an end is under way", "0100" & std_logic_vector(shown));
      send(end_packet(x"AAAA"));
      expect("second end of frame", "0101" & std_logic_vector(shown));
      ending <= '0';
      wait for 2 * 2 * c_half_period;
      expect_status("end done", '1', '0', '0', '1');
      send_good_vector("after the end");

      -- Faults are reported once, also one that comes while the status is sent.
      fault <= '1';
      wait until rising_edge(clk);
      fault <= '0';
      expect_status("fault", '1', '0', '1', '0');
      expect_status("fault read", '1', '0', '0', '0');
      fault <= transport '1' after 10 * 2 * c_half_period, '0' after 11 * 2 * c_half_period;
      expect_status("fault meanwhile", '1', '0', '0', '0');
      expect_status("fault after", '1', '0', '1', '0');
      fault <= '1';
      wait until rising_edge(clk);
      fault <= transport '0', '1' after 10 * 2 * c_half_period, '0' after 11 * 2 * c_half_period;
      expect_status("fault, and another meanwhile", '1', '0', '1', '0');
      expect_status("the other fault", '1', '0', '1', '0');
      expect_status("both faults read", '1', '0', '0', '0');
      send_good_vector("at the end");
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "spi_receiver_tb");
end architecture;
