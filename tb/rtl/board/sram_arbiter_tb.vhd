-- SPDX-License-Identifier: Apache-2.0
-- Random requests of the three users, in phases from no scan-out to all clocks scan-out, on a memory behind the
-- registers of the pins. A read's word is that of the memory when the read was taken, and comes after exactly three
-- clocks, to its user. Scan-out is never kept waiting, the depth test is before the clear, and no write is in the clock
-- after a read. Without scan-out, every clock has an access but those between a read and a write.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.tb_pkg.all;

entity sram_arbiter_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of sram_arbiter_tb is
  constant c_places  : positive := 64; -- addresses in use
  constant c_latency : positive := 3;  -- clocks from a read taken to its data
  constant c_clocks  : positive := 40000;

  type memory_t is array (0 to c_places - 1) of word_t;
  type user_t is (none, scan, depth);

  type expected_t is record
    user : user_t;
    word : word_t;
  end record;

  type expectations_t is array (1 to c_latency) of expected_t;

  signal ended                 : boolean := false;
  signal clk                   : std_logic := '0';
  signal reset                 : std_logic := '1';
  signal scan_valid            : std_logic := '0';
  signal scan_address          : address_t := (others => '0');
  signal scan_data_valid       : std_logic;
  signal depth_valid           : std_logic := '0';
  signal depth_ready           : std_logic;
  signal depth_write           : std_logic := '0';
  signal depth_address         : address_t := (others => '0');
  signal depth_data            : word_t := (others => '0');
  signal depth_data_valid      : std_logic;
  signal clear_valid           : std_logic := '0';
  signal clear_ready           : std_logic;
  signal clear_address         : address_t := (others => '0');
  signal clear_data            : word_t := (others => '0');
  signal sram_address          : address_t;
  signal sram_data_out         : word_t;
  signal sram_read, sram_write : std_logic;

  signal sram_data_in : word_t := (others => 'X');
begin
  dut : entity work.sram_arbiter
    port map (
      clk              => clk,
      reset            => reset,
      scan_valid       => scan_valid,
      scan_address     => scan_address,
      scan_data_valid  => scan_data_valid,
      depth_valid      => depth_valid,
      depth_ready      => depth_ready,
      depth_write      => depth_write,
      depth_address    => depth_address,
      depth_data       => depth_data,
      depth_data_valid => depth_data_valid,
      clear_valid      => clear_valid,
      clear_ready      => clear_ready,
      clear_address    => clear_address,
      clear_data       => clear_data,
      sram_address     => sram_address,
      sram_data_out    => sram_data_out,
      sram_read        => sram_read,
      sram_write       => sram_write);

  clk <= not clk after c_half_period when not ended;

  -- The SRAM, with a register at each pin.
  sram : process (clk) is
    variable memory               : memory_t := (others => (others => '0'));
    variable pin_address          : natural;
    variable pin_data             : word_t;
    variable pin_read, pin_write  : std_logic := '0';
  begin
    if rising_edge(clk) then
      assert not (sram_write = '1' and (sram_read = '1' or pin_read = '1'))
        report "sram_arbiter_tb: a write follows a read without a pause" severity failure;
      sram_data_in <= (others => 'X');
      if pin_read = '1' then
        sram_data_in <= memory(pin_address);
      end if;
      if pin_write = '1' then
        memory(pin_address) := pin_data;
      end if;
      pin_address := to_integer(sram_address) mod c_places;
      pin_data    := sram_data_out;
      pin_read    := sram_read;
      pin_write   := sram_write;
    end if;
  end process;

  run : process is
    constant c_place : string := "sram_arbiter: clock";

    variable random       : unsigned(31 downto 0) := to_unsigned(1, 32);
    variable memory       : memory_t              := (others => (others => '0'));
    variable expectations : expectations_t        := (others => (none, (others => '0')));
    variable expected     : expected_t;
    variable was_read     : boolean               := false;
    variable scan_reads   : natural               := 0;
    variable taken        : boolean;

    procedure draw (signal valid : out std_logic; signal address : out address_t; exponent : natural) is
    begin
      random  := next_random(random);
      valid   <= to_flag(chance(random(31 downto 24), exponent));
      address <= resize(random(5 downto 0), c_address_bits);
    end procedure;
  begin
    wait_clocks(clk, 4);
    reset <= '0';
    for n in 1 to c_clocks loop
      wait until rising_edge(clk);
      -- What the contract says of this clock.
      expected := (none, (others => '0'));
      taken    := false;
      if scan_valid = '1' then
        expected := (scan, memory(to_integer(scan_address)));
        taken    := true;
        check(c_place, n, "depth_ready", depth_ready, '0');
        check(c_place, n, "clear_ready", clear_ready, '0');
      elsif depth_valid = '1' then
        taken := depth_write = '0' or not was_read;
        check(c_place, n, "depth_ready", depth_ready, to_flag(taken));
        check(c_place, n, "clear_ready", clear_ready, '0');
        if depth_write = '0' then
          expected := (depth, memory(to_integer(depth_address)));
        elsif taken then
          memory(to_integer(depth_address)) := depth_data;
        end if;
      elsif clear_valid = '1' then
        taken := not was_read;
        check(c_place, n, "clear_ready", clear_ready, to_flag(taken));
        if taken then
          memory(to_integer(clear_address)) := clear_data;
        end if;
      end if;
      was_read := expected.user /= none;
      -- The data of the read three clocks ago.
      check(c_place, n, "scan_data_valid", scan_data_valid, to_flag(expectations(c_latency).user = scan));
      check(c_place, n, "depth_data_valid", depth_data_valid, to_flag(expectations(c_latency).user = depth));
      if expectations(c_latency).user /= none then
        scan_reads := scan_reads + 1;
        check(c_place, n, "word read", sram_data_in, expectations(c_latency).word);
      end if;
      expectations := expected & expectations(1 to c_latency - 1);
      -- Phases: full speed of two users, then scan-out in some, most and all clocks.
      if n < c_clocks / 4 then
        scan_valid <= '0';
        if taken or depth_valid = '0' then
          draw(depth_valid, depth_address, 0);
          depth_write <= random(6);
          depth_data  <= std_logic_vector(random(23 downto 8));
        end if;
      else
        draw(scan_valid, scan_address, 3 * n / c_clocks mod 3);
        if depth_ready = '1' or depth_valid = '0' then
          draw(depth_valid, depth_address, 1);
          depth_write <= random(6);
          depth_data  <= std_logic_vector(random(23 downto 8));
        end if;
      end if;
      if clear_ready = '1' or clear_valid = '0' then
        draw(clear_valid, clear_address, 1);
        clear_data <= std_logic_vector(random(23 downto 8));
      end if;
    end loop;
    assert scan_reads > c_clocks / 4 report "sram_arbiter_tb: few reads" severity failure;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "sram_arbiter_tb");
end architecture;
