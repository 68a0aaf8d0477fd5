-- SPDX-License-Identifier: Apache-2.0
-- Reads runs of words from an AXI4 memory by burst_reader, behind read_arbiter, while another reader reads single words
-- and bursts through the same port: at full speed, with latencies, random stalls, stops and error responses. Every word
-- must be that of its address, once and in order. Bursts end at multiples of 16 words. At full speed one word comes per
-- clock, also at a latency of 30.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_memory_pkg.all;
use work.axi_words_pkg.all;
use work.memory_pkg.all;
use work.tb_pkg.all;

entity burst_reader_checker is
  generic (
    g_memory    : natural;
    g_data_bits : positive
  );
end entity;

architecture sim of burst_reader_checker is
  constant c_bytes  : positive := g_data_bits / 8;
  constant c_runs   : positive := 300;
  constant c_origin : unsigned(31 downto 0) := to_unsigned(c_memory_origin, 32);

  constant c_no_request : request_t := (valid => '0', addr => (others => '0'), len => (others => '0'), size => "000", burst => "01");
  constant c_no_access  : manager_t := (ar | aw => c_no_request, wdata => (others => '0'), wstrb => (others => '0'), others => '0');

  signal clk                  : std_logic := '0';
  signal reset                : std_logic := '1';
  signal start, stop          : std_logic := '0';
  signal address              : address_t := (others => '0');
  signal count                : unsigned(28 downto 0) := (others => '0');
  signal busy, fault          : std_logic;
  signal arvalid, arready     : std_logic;
  signal araddr               : address_t;
  signal arlen                : unsigned(7 downto 0);
  signal rvalid               : std_logic;
  signal out_valid, out_last  : std_logic;
  signal out_ready            : std_logic := '0';
  signal out_data             : std_logic_vector(g_data_bits - 1 downto 0);
  signal other_arvalid        : std_logic := '0';
  signal other_arready        : std_logic;
  signal other_araddr         : address_t := (others => '0');
  signal other_arlen          : unsigned(7 downto 0) := (others => '0');
  signal other_rvalid         : std_logic;
  signal other_rready         : std_logic := '0';
  signal other_rests          : natural := 1; -- the other reader works in one of 2**other_rests clocks
  signal m                    : manager_t := c_no_access;
  signal s                    : subordinate_t;
  signal latency              : positive := 1;
  signal pauses, errors       : natural := 0;
  signal run                  : natural := 0;
  signal ended                : boolean := false;

  impure function word_at (place : unsigned(31 downto 0)) return std_logic_vector is
    variable word : std_logic_vector(g_data_bits - 1 downto 0);
  begin
    for i in 0 to g_data_bits / 32 - 1 loop
      word(32 * i + 31 downto 32 * i) := memories.get(g_memory, (to_integer(place) - c_memory_origin) / 4 + i);
    end loop;
    return word;
  end function;
begin
  dut : entity work.burst_reader
    generic map (g_data_bits => g_data_bits)
    port map (
      clk           => clk,
      reset         => reset,
      start         => start,
      address       => address,
      count         => count,
      stop          => stop,
      busy          => busy,
      fault         => fault,
      m_axi_arvalid => arvalid,
      m_axi_arready => arready,
      m_axi_araddr  => araddr,
      m_axi_arlen   => arlen,
      m_axi_rvalid  => rvalid,
      m_axi_rdata   => s.rdata(g_data_bits - 1 downto 0),
      m_axi_rresp   => s.rresp,
      out_valid     => out_valid,
      out_ready     => out_ready,
      out_data      => out_data,
      out_last      => out_last);

  arbiter : entity work.read_arbiter
    port map (
      clk           => clk,
      reset         => reset,
      a_arvalid     => other_arvalid,
      a_arready     => other_arready,
      a_araddr      => other_araddr,
      a_arlen       => other_arlen,
      a_rvalid      => other_rvalid,
      a_rready      => other_rready,
      b_arvalid     => arvalid,
      b_arready     => arready,
      b_araddr      => araddr,
      b_arlen       => arlen,
      b_rvalid      => rvalid,
      m_axi_arvalid => m.ar.valid,
      m_axi_arready => s.arready,
      m_axi_araddr  => m.ar.addr,
      m_axi_arlen   => m.ar.len,
      m_axi_rvalid  => s.rvalid,
      m_axi_rready  => m.rready,
      m_axi_rlast   => s.rlast);

  memory : entity work.axi_memory
    generic map (g_memory => g_memory, g_data_bits => g_data_bits)
    port map (clk => clk, reset => reset, latency => latency, pause => pauses, errors => errors, m => m, s => s);

  clk <= not clk after c_half_period when not ended;

  rules : process (clk) is
    variable before : request_t := m.ar;
    variable waits  : boolean := false;
  begin
    if rising_edge(clk) then
      if waits then
        check("burst_reader: run", run, "a request that waits", m.ar.valid & std_logic_vector(m.ar.addr & m.ar.len),
          '1' & std_logic_vector(before.addr & before.len));
      end if;
      if arvalid = '1' then
        check("burst_reader: run", run, "the first and the last block of 16 words of a burst",
          to_integer(araddr) / (16 * c_bytes), (to_integer(araddr) + c_bytes * to_integer(arlen)) / (16 * c_bytes));
      end if;
      before := m.ar;
      waits  := m.ar.valid = '1' and s.arready = '0' and reset = '0';
    end if;
  end process;

  -- The other reader: bursts of 1 to 4 words, one on its way.
  other : process is
    variable random : unsigned(31 downto 0) := to_unsigned(5, 32);
  begin
    while not ended loop
      random := next_random(random);
      if chance(random(19 downto 12), other_rests) and other_rests < 8 then
        other_arvalid <= '1';
        other_araddr  <= c_origin + c_bytes * to_integer(random(14 downto 6) & "00");
        other_arlen   <= resize(random(21 downto 20), 8);
        wait until rising_edge(clk) and other_arready = '1';
        other_arvalid <= '0';
        for word in 0 to to_integer(other_arlen) loop
          other_rready <= '0';
          random := next_random(random);
          if not chance(random(19 downto 12), other_rests) then
            wait until rising_edge(clk);
          end if;
          other_rready <= '1';
          wait until rising_edge(clk) and other_rvalid = '1';
          check("burst_reader: run", run, "a word of the other reader", s.rdata(g_data_bits - 1 downto 0),
            word_at(other_araddr + c_bytes * word));
        end loop;
        other_rready <= '0';
      else
        wait until rising_edge(clk);
      end if;
    end loop;
    wait;
  end process;

  read : process is
    variable random : unsigned(31 downto 0) := to_unsigned(7, 32);

    -- Reads `number` times 8 bytes. out_ready is '1' in one of 2**rests clocks. After `stop_after` words the reader is stopped.
    procedure read_run (number, rests, stop_after : natural) is
      constant c_words     : natural := number * 64 / g_data_bits;
      variable got, clocks : natural := 0;
      variable place      : address_t;
    begin
      random  := next_random(random);
      place   := c_origin + 8 * to_integer(random(20 downto 9));
      address <= place;
      count   <= to_unsigned(number, count'length);
      start   <= '1';
      wait until rising_edge(clk);
      start   <= '0';
      wait for 0 ns;
      while busy = '1' or clocks = 0 loop
        random    := next_random(random);
        stop      <= to_flag(got >= stop_after);
        out_ready <= to_flag(chance(random(30 downto 23), rests));
        wait until rising_edge(clk);
        clocks := clocks + 1;
        if out_valid = '1' and out_ready = '1' then
          check("burst_reader: run", run, "word " & to_string(got), out_data, word_at(place + c_bytes * got));
          if stop_after > c_words then
            check("burst_reader: run", run, "out_last of word " & to_string(got), out_last, to_flag(got = c_words - 1));
          end if;
          got := got + 1;
        end if;
        assert clocks < 20_000 report "burst_reader: run " & to_string(run) & " does not end" severity failure;
        wait for 0 ns;
      end loop;
      out_ready <= '0';
      stop      <= '0';
      if stop_after > c_words then
        check("burst_reader: run", run, "words", got, c_words);
        if rests = 0 and pauses = 0 and other_rests = 8 then
          check("burst_reader: run", run, "clocks above one per word and a start", maximum(clocks - c_words - latency - 24, 0), 0);
        end if;
      elsif got < stop_after or got > c_words then
        check("burst_reader: run", run, "words of a stopped run", got, stop_after);
      end if;
      if errors = 0 then
        check("burst_reader: run", run, "fault", fault, '0');
      elsif number > 200 then
        check("burst_reader: run", run, "fault", fault, '1');
      end if;
    end procedure;
  begin
    memories.randomize(g_memory);
    wait_clocks(clk, 2);
    reset <= '0';
    wait until rising_edge(clk);
    for i in 0 to c_runs - 1 loop
      run         <= i;
      latency     <= (i mod 3) * 15 + 1;
      pauses      <= i / 3 mod 3;
      if i mod 10 = 9 and i mod 7 /= 3 then
        pauses <= 5; -- a request waits longer than the next burst takes
      end if;
      other_rests <= 8 - (i / 9 mod 2) * 7;
      errors      <= (i / 25 mod 2) * 4;
      wait_clocks(clk, 2 + (i / 9 mod 2) * 100); -- the other reader ends its burst
      random      := next_random(random);
      if i mod 7 = 6 then
        read_run(to_integer(random(14 downto 8)), i / 18 mod 3, to_integer(random(21 downto 18)));
      elsif i mod 7 = 3 then
        read_run(600, i / 18 mod 2, natural'high);
      else
        read_run(to_integer(random(14 downto 8)), i / 18 mod 3, natural'high);
      end if;
    end loop;
    ended <= true;
    finish(finished);
  end process;
end architecture;

use work.tb_pkg.all;

entity burst_reader_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of burst_reader_tb is
begin
  bus_32 : entity work.burst_reader_checker
    generic map (g_memory => 0, g_data_bits => 32);

  bus_64 : entity work.burst_reader_checker
    generic map (g_memory => 1, g_data_bits => 64);

  report_end(finished, "burst_reader_tb");
end architecture;
