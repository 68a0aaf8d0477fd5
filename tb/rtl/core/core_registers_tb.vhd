-- SPDX-License-Identifier: Apache-2.0
-- core_registers behind register_port. All 64 words are written with all 16 strobes, and read, over AXI4-Lite with random
-- pauses; the inputs change at random. A model that is written from the contract gives each output, each word that is
-- read and each answer in each clock. At the end a reset, and the values after it.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;
use work.memory_pkg.all;
use work.core_registers_pkg.c_version_major;
use work.core_registers_pkg.c_version_minor;
use work.core_registers_pkg.c_version_patch;

entity core_registers_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of core_registers_tb is
  subtype word_t is std_logic_vector(31 downto 0);
  type words_t is array (0 to 63) of word_t;

  -- Offsets of the contract. All words up to the last one exist.
  constant c_control          : natural := 16#18#;
  constant c_status           : natural := 16#1C#;
  constant c_faults           : natural := 16#20#;
  constant c_interrupt_enable : natural := 16#24#;
  constant c_interrupts       : natural := 16#28#;
  constant c_ring_base        : natural := 16#2C#;
  constant c_ring_size        : natural := 16#30#;
  constant c_ring_head        : natural := 16#34#;
  constant c_ring_tail        : natural := 16#38#;
  constant c_picture          : natural := 16#3C#;
  constant c_counters         : natural := 16#40#; -- of triangles, fragments, pixels, busy and stalled clocks
  constant c_last             : natural := 16#50#;

  -- After a reset.
  constant c_words : words_t := (
    0      => x"48414C46",
    1      => std_logic_vector(to_unsigned(c_version_major, 8) & to_unsigned(c_version_minor, 8)
    & to_unsigned(c_version_patch, 16)),
    2      => x"12345678",
    3      => x"9ABCDEF0",
    4      => x"0F1E2D3C",
    5      => x"4B5A6978",
    others => x"00000000");

  -- Bits that a write of this word changes or clears.
  function writable (offset : natural) return word_t is
  begin
    case offset is
      when c_control | c_interrupt_enable | c_interrupts =>
        return x"00000003";
      when c_faults =>
        return x"000000FF";
      when c_ring_base =>
        return x"FFFFFFC0";
      when c_ring_size =>
        return x"0000000F";
      when c_ring_head =>
        return x"FFFFFFFF";
      when others =>
        return x"00000000";
    end case;
  end function;

  signal clk   : std_logic := '0';
  signal reset : std_logic := '1';

  signal awvalid, wvalid, bready, arvalid, rready  : std_logic := '0';
  signal awready, wready, bvalid, arready, rvalid  : std_logic;
  signal awaddr, araddr                            : unsigned(7 downto 0) := (others => '0');
  signal wdata                                     : word_t := (others => '0');
  signal rdata                                     : word_t;
  signal wstrb                                     : std_logic_vector(3 downto 0) := (others => '0');
  signal bresp, rresp                              : std_logic_vector(1 downto 0);
  signal write, write_error, read, read_error      : std_logic;
  signal write_address, read_address               : unsigned(5 downto 0);
  signal write_data, read_data                     : word_t;
  signal write_strobes                             : std_logic_vector(3 downto 0);
  signal enable, abort, interrupt                  : std_logic;
  signal ring_base, picture                        : address_t;
  signal ring_size                                 : unsigned(3 downto 0);
  signal ring_head, ring_tail                      : unsigned(31 downto 0);
  signal busy, command_done, swap                  : std_logic := '0';
  signal command_faults                            : std_logic_vector(7 downto 0) := (others => '0');
  signal picture_base                              : address_t := (others => '0');
  signal triangle, fragment, stalled               : std_logic := '0';
  signal pixels                                    : pixel_count_t := (others => '0');
  signal expected_word                             : word_t; -- of the last read
  signal all_written, ended                        : boolean := false;
begin
  port_of_registers : entity work.register_port
    port map (
      clk           => clk,
      reset         => reset,
      s_axi_awvalid => awvalid,
      s_axi_awready => awready,
      s_axi_awaddr  => awaddr,
      s_axi_wvalid  => wvalid,
      s_axi_wready  => wready,
      s_axi_wdata   => wdata,
      s_axi_wstrb   => wstrb,
      s_axi_bvalid  => bvalid,
      s_axi_bready  => bready,
      s_axi_bresp   => bresp,
      s_axi_arvalid => arvalid,
      s_axi_arready => arready,
      s_axi_araddr  => araddr,
      s_axi_rvalid  => rvalid,
      s_axi_rready  => rready,
      s_axi_rdata   => rdata,
      s_axi_rresp   => rresp,
      write         => write,
      write_address => write_address,
      write_data    => write_data,
      write_strobes => write_strobes,
      write_error   => write_error,
      read          => read,
      read_address  => read_address,
      read_data     => read_data,
      read_error    => read_error);

  dut : entity work.core_registers
    generic map (
      g_shader  => c_words(2),
      g_lights  => c_words(3),
      g_objects => c_words(4),
      g_memory  => c_words(5))
    port map (
      clk            => clk,
      reset          => reset,
      write          => write,
      write_address  => write_address,
      write_data     => write_data,
      write_strobes  => write_strobes,
      write_error    => write_error,
      read_address   => read_address,
      read_data      => read_data,
      read_error     => read_error,
      enable         => enable,
      abort          => abort,
      ring_base      => ring_base,
      ring_size      => ring_size,
      ring_head      => ring_head,
      ring_tail      => ring_tail,
      busy           => busy,
      command_done   => command_done,
      command_faults => command_faults,
      swap           => swap,
      picture_base   => picture_base,
      picture        => picture,
      triangle       => triangle,
      fragment       => fragment,
      pixels         => pixels,
      stalled        => stalled,
      interrupt      => interrupt);

  clk <= not clk after c_half_period when not ended;

  -- Inputs that change at random. A command is done in one clock of 32, so that cleared bits are seen.
  inputs : process is
    variable random : unsigned(31 downto 0) := to_unsigned(11, 32);
  begin
    wait until rising_edge(clk);
    random         := next_random(random);
    busy           <= random(0);
    triangle       <= random(1);
    fragment       <= random(2);
    stalled        <= random(3);
    pixels         <= random(6 downto 4);
    command_done   <= to_flag(random(12 downto 8) = 0);
    swap           <= to_flag(random(17 downto 13) = 0);
    random         := next_random(random);
    command_faults <= std_logic_vector(random(7 downto 0) and random(15 downto 8) and random(23 downto 16));
    picture_base   <= random(15 downto 0) & random(31 downto 16);
  end process;

  -- Compares outputs with the words of the model, then computes the words of the next clock.
  model : process is
    constant c_place : string := "core_registers: clock";

    variable clock  : natural := 0;
    variable words  : words_t;
    variable counts : unsigned(6 downto 0); -- inputs of the clock before: pixels, then the events
    variable aborts : std_logic;
    variable mask   : word_t;
    variable events : word_t;

    impure function word (offset : natural) return unsigned is
    begin
      return unsigned(words(offset / 4));
    end function;

    procedure add (offset : natural; number : unsigned) is
    begin
      words(offset / 4) := std_logic_vector(word(offset) + number);
    end procedure;
  begin
    wait until rising_edge(clk);
    if reset = '1' then
      words  := c_words;
      counts := (others => '0');
      aborts := '0';
    else
      check(c_place, clock, "enable", enable, words(c_control / 4)(0));
      check(c_place, clock, "abort", abort, aborts);
      check(c_place, clock, "interrupt", interrupt, or (words(c_interrupts / 4) and words(c_interrupt_enable / 4)));
      check(c_place, clock, "ring_base", std_logic_vector(ring_base), words(c_ring_base / 4));
      check(c_place, clock, "ring_size", std_logic_vector(ring_size), words(c_ring_size / 4)(3 downto 0));
      check(c_place, clock, "ring_head", std_logic_vector(ring_head), words(c_ring_head / 4));
      check(c_place, clock, "ring_tail", std_logic_vector(ring_tail), words(c_ring_tail / 4));
      check(c_place, clock, "picture", std_logic_vector(picture), words(c_picture / 4));
      if read = '1' then
        check(c_place, clock, "read_data", read_data, words(to_integer(read_address)));
        check(c_place, clock, "read_error", read_error, to_flag(read_address > c_last / 4));
        expected_word <= words(to_integer(read_address));
      end if;

      -- Writes.
      aborts := '0';
      if write = '1' then
        mask := writable(4 * to_integer(write_address));
        check(c_place, clock, "write_error", write_error, not (or mask));
        for i in word_t'range loop
          mask(i) := mask(i) and write_strobes(i / 8);
        end loop;
        if write_address = c_faults / 4 or write_address = c_interrupts / 4 then
          words(to_integer(write_address)) := words(to_integer(write_address)) and not (mask and write_data);
        else
          words(to_integer(write_address)) := (words(to_integer(write_address)) and not mask) or (mask and write_data);
        end if;
        aborts := words(c_control / 4)(1);
        words(c_control / 4)(1) := '0';
      end if;

      -- Events.
      if command_done = '1' then
        events := (0 => '1', 1 => or command_faults, others => '0');
        words(c_interrupts / 4) := words(c_interrupts / 4) or events;
        words(c_faults / 4)(7 downto 0) := words(c_faults / 4)(7 downto 0) or command_faults;
        add(c_ring_tail, "1");
      end if;
      if swap = '1' then
        words(c_picture / 4) := std_logic_vector(picture_base);
      end if;
      add(c_counters, counts(0 downto 0));
      add(c_counters + 4, counts(1 downto 1));
      add(c_counters + 8, counts(6 downto 4));
      add(c_counters + 12, counts(2 downto 2));
      add(c_counters + 16, counts(3 downto 3));
      counts := pixels & stalled & busy & fragment & triangle;
      words(c_status / 4)(0) := busy;
    end if;
    clock := clock + 1;
  end process;

  -- Each word twice with each strobes, and random data: address and data in random order, then the answer. The second
  -- time in reverse order, after other words before and after it were written.
  writes : process is
    constant c_place : string := "core_registers: word";

    variable random : unsigned(31 downto 0) := to_unsigned(7, 32);

    procedure write_word (number : natural; strobes : std_logic_vector(3 downto 0)) is
      variable address_to_come, data_to_come : boolean := true;
      variable data                          : unsigned(31 downto 0);
    begin
      draw_word(random, data);
      awaddr <= to_unsigned(number, 6) & random(11 downto 10);
      wdata  <= std_logic_vector(data);
      wstrb  <= strobes;
      while address_to_come or data_to_come loop
        random := next_random(random);
        if address_to_come and random(12) = '1' then
          awvalid <= '1';
        end if;
        if data_to_come and random(22) = '1' then
          wvalid <= '1';
        end if;
        wait until rising_edge(clk);
        if awvalid = '1' and awready = '1' then
          awvalid         <= '0';
          address_to_come := false;
        end if;
        if wvalid = '1' and wready = '1' then
          wvalid       <= '0';
          data_to_come := false;
        end if;
      end loop;
      pause(clk, random, 1);
      bready <= '1';
      wait until rising_edge(clk) and bvalid = '1';
      check(c_place, number, "bresp", bresp, to_flag(writable(4 * number) = x"00000000") & '0');
      bready <= '0';
    end procedure;
  begin
    wait until rising_edge(clk) and reset = '0';
    for pass in 0 to 1 loop
      for number in 0 to 63 loop
        for strobes in 0 to 15 loop
          write_word(number * (1 - pass) + (63 - number) * pass, std_logic_vector(to_unsigned(strobes, 4)));
          -- Clear bits of faults and interrupts, which would soon be all '1'.
          write_word(c_faults / 4, "0001");
          write_word(c_interrupts / 4, "0001");
        end loop;
      end loop;
    end loop;
    all_written <= true;
    wait;
  end process;

  -- At the same time: all words in their order, and between them the one that is written. Then a reset.
  reads : process is
    constant c_place : string := "core_registers: word";

    variable random : unsigned(31 downto 0) := to_unsigned(13, 32);
    variable passes : natural := 0;

    procedure read_word (number : unsigned(5 downto 0)) is
    begin
      random := next_random(random);
      pause(clk, random, 1);
      araddr  <= number & random(11 downto 10);
      arvalid <= '1';
      wait until rising_edge(clk) and arready = '1';
      arvalid <= '0';
      pause(clk, random, 1);
      rready <= '1';
      wait until rising_edge(clk) and rvalid = '1';
      check(c_place, to_integer(number), "rdata", rdata, expected_word);
      check(c_place, to_integer(number), "rresp", rresp, to_flag(number > c_last / 4) & '0');
      rready <= '0';
    end procedure;
  begin
    wait_clocks(clk, 2);
    reset <= '0';
    while not all_written loop
      for number in 0 to 63 loop
        read_word(to_unsigned(number, 6));
        read_word(awaddr(7 downto 2));
      end loop;
      passes := passes + 1;
    end loop;
    assert passes >= 10 report "core_registers: only " & to_string(passes) & " passes of reads" severity failure;
    reset <= '1';
    wait_clocks(clk, 2);
    reset <= '0';
    for number in 0 to 63 loop
      read_word(to_unsigned(number, 6));
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "core_registers_tb");
end architecture;
