-- SPDX-License-Identifier: Apache-2.0
-- Reads runs of words from an AXI4 memory, on both widths of the bus: at full speed at several latencies, with random
-- stalls at both ends, and with error responses. Every word must be that of its address, once and in order. At full speed
-- one word comes per clock, also at the largest latency of the contract. axi_rules checks every clock. The proof has stops
-- and all that is not of size.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_memory_pkg.all;
use work.axi_words_pkg.all;
use work.memory_pkg.all;
use work.tb_pkg.all;

entity burst_reader_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of burst_reader_tb is
begin
  bus_runs : for lanes in 1 to 2 generate
    constant c_bits      : positive := 32 * lanes;
    constant c_bytes     : positive := c_bits / 8;
    constant c_latencies : integer_vector := (1, 16, 44);

    constant c_no_request : request_t := (valid => '0', addr => (others => '0'), len => (others => '0'), size => "01" & to_flag(lanes = 2), burst => "01");
    constant c_no_write   : manager_t := (ar | aw => c_no_request, wdata => (others => '0'), wstrb => (others => '0'),
      rready => '1', others => '0');

    signal ended               : boolean := false;
    signal clk                 : std_logic := '0';
    signal reset               : std_logic := '1';
    signal start, out_ready    : std_logic := '0';
    signal address             : address_t := (others => '0');
    signal count               : unsigned(28 downto 0) := (others => '0');
    signal busy, fault         : std_logic;
    signal out_valid, out_last : std_logic;
    signal out_data            : std_logic_vector(c_bits - 1 downto 0);
    signal m                   : manager_t := c_no_write;
    signal s                   : subordinate_t;
    signal latency             : positive := 1;
    signal pauses, errors      : natural := 0;
  begin
    dut : entity work.burst_reader
      generic map (g_data_bits => c_bits)
      port map (
        clk           => clk,
        reset         => reset,
        start         => start,
        address       => address,
        count         => count,
        stop          => '0',
        busy          => busy,
        fault         => fault,
        m_axi_arvalid => m.ar.valid,
        m_axi_arready => s.arready,
        m_axi_araddr  => m.ar.addr,
        m_axi_arlen   => m.ar.len,
        m_axi_rvalid  => s.rvalid,
        m_axi_rdata   => s.rdata(c_bits - 1 downto 0),
        m_axi_rresp   => s.rresp,
        out_valid     => out_valid,
        out_ready     => out_ready,
        out_data      => out_data,
        out_last      => out_last);

    memory : entity work.axi_memory
      generic map (g_memory => lanes, g_data_bits => c_bits)
      port map (clk => clk, reset => reset, latency => latency, pause => pauses, errors => errors, m => m, s => s);

    rules : entity work.axi_rules
      generic map (g_true_colour => false, g_data_bits => c_bits, g_any_place => true)
      port map (clk => clk, reset => reset, m => m, s => s);

    clk <= not clk after c_half_period when not ended;

    read : process is
      variable random : unsigned(31 downto 0) := to_unsigned(7, 32);

      -- Reads `number` times 8 bytes at a random place. out_ready is '1' in one of 2**rests clocks.
      procedure read_run (run, number, rests : natural) is
        constant c_place : string  := "burst_reader: run";
        constant c_words : natural := 2 * number / lanes;

        variable index       : natural; -- of the next word of 32 bits in memory
        variable got, clocks : natural := 0;
      begin
        random  := next_random(random);
        index   := 2 * to_integer(random(20 downto 9));
        address <= to_unsigned(c_memory_origin + 4 * index, address'length);
        count   <= to_unsigned(number, count'length);
        start   <= '1';
        wait until rising_edge(clk);
        start <= '0';
        while got < c_words loop
          random    := next_random(random);
          out_ready <= to_flag(chance(random(30 downto 23), rests));
          wait until rising_edge(clk);
          check(c_place, run, "busy", busy, '1');
          clocks := clocks + 1;
          if out_valid = '1' and out_ready = '1' then
            for lane in 0 to lanes - 1 loop
              check(c_place, run, "word " & to_string(got), out_data(32 * lane + 31 downto 32 * lane), memories.get(lanes, index));
              index := index + 1;
            end loop;
            got := got + 1;
            check(c_place, run, "out_last of word " & to_string(got), out_last, to_flag(got = c_words));
          end if;
          assert clocks < 20_000 report c_place & " " & to_string(run) & " does not end" severity failure;
        end loop;
        out_ready <= '0';
        wait_clocks(clk, 2);
        check(c_place, run, "busy after the last word", busy, '0');
        if rests = 0 and pauses = 0 then
          check(c_place, run, "clocks above one per word and a start", maximum(clocks - c_words - latency - 24, 0), 0);
        end if;
        if errors = 0 or number > 200 then
          check(c_place, run, "fault", fault, to_flag(errors > 0));
        end if;
      end procedure;
    begin
      memories.randomize(lanes);
      wait_clocks(clk, 2);
      reset <= '0';
      for i in 0 to 149 loop
        latency <= c_latencies(i mod 3);
        pauses  <= i / 3 mod 3;
        errors  <= (i / 25 mod 2) * 4;
        wait until rising_edge(clk);
        random := next_random(random);
        read_run(i, 1 + to_integer(random(14 downto 8)) + 600 * boolean'pos(i mod 7 = 3), i / 18 mod 3);
      end loop;
      ended <= true;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "burst_reader_tb");
end architecture;
