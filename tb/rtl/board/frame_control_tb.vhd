-- SPDX-License-Identifier: Apache-2.0
-- The clear after reset and three frames, with random stalls of the writes. Every buffer that must be cleared is
-- written exactly once, with its word, and no other address is. The swap is in the clock after the first blank_start
-- after drained, and not earlier.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.tb_pkg.all;

entity frame_control_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of frame_control_tb is
  signal ended         : boolean := false;
  signal clk           : std_logic := '0';
  signal reset         : std_logic := '1';
  signal frame_end     : std_logic := '0';
  signal background    : word_t := (others => '0');
  signal drained       : std_logic := '1';
  signal blank_start   : std_logic := '0';
  signal ending, front : std_logic;
  signal shown         : unsigned(3 downto 0);
  signal write_valid   : std_logic;
  signal write_ready   : std_logic := '0';
  signal write_address : address_t;
  signal write_data    : word_t;

  signal ready : std_logic := '1';
begin
  dut : entity work.frame_control
    port map (
      clk           => clk,
      reset         => reset,
      frame_end     => frame_end,
      background    => background,
      drained       => drained,
      blank_start   => blank_start,
      ending        => ending,
      front         => front,
      shown         => shown,
      write_valid   => write_valid,
      write_ready   => write_ready,
      write_address => write_address,
      write_data    => write_data);

  clk <= not clk after c_half_period when not ended;
  write_ready <= write_valid and ready;

  stall : process (clk) is
    variable random : unsigned(31 downto 0) := to_unsigned(5, 32);
  begin
    if rising_edge(clk) then
      random := next_random(random);
      ready  <= to_flag(random(31 downto 29) /= "000");
    end if;
  end process;

  run : process is
    -- Follow a clear of the addresses from `low` to `high`, then of the depths unless they are among these.
    procedure check_clear (low, high : natural; colour : word_t) is
      variable address  : natural := low;
      variable expected : word_t;
    begin
      while address < c_words loop
        wait until rising_edge(clk) and write_ready = '1';
        expected := colour;
        if address >= c_depth_base then
          expected := c_farthest;
        end if;
        check("frame_control: address", address, "write_address", to_integer(write_address), address);
        check("frame_control: address", address, "write_data", write_data, expected);
        check("frame_control: address", address, "ending", ending, '1');
        address := address + 1;
        if address = high + 1 then
          address := maximum(address, c_depth_base);
        end if;
      end loop;
      for i in 1 to 20 loop
        wait until rising_edge(clk);
        assert write_valid = '0' and ending = '0' report "frame_control_tb: does not end" severity failure;
      end loop;
    end procedure;

    procedure check_waits (clocks : positive; front_now : std_logic) is
    begin
      for i in 1 to clocks loop
        wait until rising_edge(clk);
        assert ending = '1' and front = front_now and write_valid = '0'
          report "frame_control_tb: swaps too early" severity failure;
      end loop;
    end procedure;

    variable front_now : std_logic := '0';
    variable colour    : word_t;
  begin
    wait_clocks(clk, 3);
    reset <= '0';
    check_clear(0, c_words - 1, x"0000");
    assert front = '0' and shown = 0 report "frame_control_tb: shows a frame after reset" severity failure;
    for frame in 1 to 3 loop
      colour := std_logic_vector(to_unsigned(16#1111# * frame, 16));
      -- A vertical blank without a frame changes nothing.
      blank_start <= '1';
      wait until rising_edge(clk);
      blank_start <= '0';
      wait until rising_edge(clk);
      assert front = front_now and ending = '0' report "frame_control_tb: swaps without a frame" severity failure;
      drained    <= '0';
      frame_end  <= '1';
      background <= colour;
      wait until rising_edge(clk);
      frame_end  <= '0';
      background <= not colour;
      wait until rising_edge(clk);
      -- Neither a blank before drained nor drained without a blank swaps.
      check_waits(20, front_now);
      blank_start <= '1';
      check_waits(1, front_now);
      blank_start <= '0';
      check_waits(20, front_now);
      drained <= '1';
      check_waits(20, front_now);
      blank_start <= '1';
      wait until rising_edge(clk);
      blank_start <= '0';
      wait for 1 ns;
      front_now := not front_now;
      assert front = front_now and shown = frame
        report "frame_control_tb: does not swap in the clock after blank_start" severity failure;
      -- The new back buffer is the one that was shown.
      check_clear(to_integer(colour_base(not front_now)), to_integer(colour_base(not front_now)) + c_pixels - 1, colour);
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "frame_control_tb");
end architecture;
