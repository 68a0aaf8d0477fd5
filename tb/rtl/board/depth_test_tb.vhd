-- SPDX-License-Identifier: Apache-2.0
-- Random runs of pixels, ascending, descending, alone and repeated at the same places, into both colour buffers, with
-- an SRAM that is always free, and one that serves another user at random. At the end all words of the memory equal
-- those of a plain depth test, pixel by pixel in order. The clocks of single batches and of a long run equal those of
-- the header.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.sram_words_pkg.all;
use work.sram_model_pkg.all;
use work.tb_pkg.all;

entity depth_test_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of depth_test_tb is
  constant c_reads  : positive := 3;   -- clocks from a read to its data
  constant c_places : positive := 16;  -- pixels in a batch
  constant c_region : positive := 200; -- pixels in use, at the start and the end of the buffers

  shared variable expected : sram_t; -- beside the contents of sram

  signal ended                     : boolean := false;
  signal clk                       : std_logic := '0';
  signal reset                     : std_logic := '1';
  signal back, pixel_valid         : std_logic := '0';
  signal pixel_ready               : std_logic;
  signal pixel_place               : place_t := (others => '0');
  signal pixel_depth, pixel_colour : word_t := (others => '0');
  signal access_valid              : std_logic;
  signal access_ready              : std_logic := '0';
  signal access_write              : std_logic;
  signal access_addr               : address_t;
  signal access_data               : word_t;
  signal data_valid                : std_logic := '0';
  signal data                      : word_t := (others => 'X');
  signal busy                      : std_logic;

  signal slow  : boolean   := false; -- another user takes clocks
  signal other, was_read : std_logic := '0';
  signal clock_number    : natural := 0;
begin
  dut : entity work.depth_test
    port map (
      clk          => clk,
      reset        => reset,
      back         => back,
      pixel_valid  => pixel_valid,
      pixel_ready  => pixel_ready,
      pixel_place  => pixel_place,
      pixel_depth  => pixel_depth,
      pixel_colour => pixel_colour,
      access_valid => access_valid,
      access_ready => access_ready,
      access_write => access_write,
      access_addr  => access_addr,
      access_data  => access_data,
      data_valid   => data_valid,
      data         => data,
      busy         => busy);

  clk <= not clk after c_half_period when not ended;
  clock_number <= clock_number + 1 when rising_edge(clk);

  access_ready <= access_valid and not other and not (access_write and was_read);

  memory : process (clk) is
    type words_t is array (1 to c_reads) of word_t;

    variable random : unsigned(31 downto 0) := to_unsigned(3, 32);
    variable words  : words_t;
    variable valids : std_logic_vector(1 to c_reads) := (others => '0');
    variable pixel  : natural;
  begin
    if rising_edge(clk) then
      random := next_random(random);
      -- The other user reads in runs of 16 clocks on average.
      if not slow then
        other <= '0';
      elsif random(31 downto 28) = 0 then
        other <= not other;
      end if;
      was_read   <= other or (access_ready and not access_write);
      data_valid <= valids(c_reads - 1);
      data       <= words(c_reads - 1) when valids(c_reads - 1) = '1' else (others => 'X');
      words(2 to c_reads) := words(1 to c_reads - 1);
      valids := '0' & valids(1 to c_reads - 1);
      if access_ready = '1' and reset = '0' then
        pixel := to_integer(access_addr) mod c_pixels;
        assert pixel < c_region or pixel >= c_pixels - c_region
          report "depth_test_tb: access to pixel " & to_string(pixel) severity failure;
        if access_write = '0' then
          assert access_addr >= c_depth_base report "depth_test_tb: reads a colour" severity failure;
          words(1)  := sram.get(to_integer(access_addr));
          valids(1) := '1';
        else
          assert access_addr >= c_depth_base
            or (access_addr >= colour_base(back) and access_addr < colour_base(back) + c_pixels)
            report "depth_test_tb: writes to the buffer that is shown" severity failure;
          sram.set(to_integer(access_addr), access_data);
        end if;
      end if;
    end if;
  end process;

  run : process is
    variable random : unsigned(31 downto 0) := to_unsigned(4, 32);

    procedure set_both (address : natural; word : word_t) is
    begin
      sram.set(address, word);
      expected.set(address, word);
    end procedure;

    -- Send a pixel, and draw it in the expected memory.
    procedure send (place : natural; depth, colour : word_t) is
    begin
      pixel_place  <= to_unsigned(place, pixel_place'length);
      pixel_depth  <= depth;
      pixel_colour <= colour;
      pixel_valid  <= '1';
      wait until rising_edge(clk) and pixel_ready = '1';
      pixel_valid <= '0';
      if unsigned(depth) < unsigned(expected.get(c_depth_base + place)) then
        expected.set(c_depth_base + place, depth);
        expected.set(to_integer(colour_base(back)) + place, colour);
      end if;
    end procedure;

    procedure drain is
    begin
      loop
        wait until rising_edge(clk);
        exit when busy = '0';
      end loop;
    end procedure;

    -- A batch of `count` pixels on pixels of depth 8000, of which `kept` are nearer.
    procedure batch (count, kept : natural) is
      variable start : natural;
    begin
      for i in 0 to count - 1 loop
        set_both(c_depth_base + i, x"8000");
      end loop;
      for i in 0 to count - 1 loop
        send(i, std_logic_vector(to_unsigned(16#8000# - to_integer(unsigned'("" & to_flag(i < kept))), 16)), x"1234");
        if i = 0 then
          start := clock_number;
        end if;
      end loop;
      -- The clock in which a pixel can be taken again.
      wait until rising_edge(clk) and busy = '0';
      check("depth_test: batch of " & to_string(count) & ", nearer pixels", kept, "number of clocks", clock_number - start,
        2 * count + kept + 4);
    end procedure;

    variable place  : natural;
    variable length : positive;
    variable step   : integer;
    variable first  : natural;
  begin
    for i in 0 to c_words - 1 loop
      set_both(i, c_farthest);
    end loop;
    wait_clocks(clk, 3);
    reset <= '0';
    wait until rising_edge(clk);

    for count in 1 to c_places loop
      for kept in 0 to count loop
        batch(count, kept);
      end loop;
    end loop;

    -- A long run of nearer pixels.
    for i in 0 to c_region - 1 loop
      set_both(c_depth_base + i, c_farthest);
    end loop;
    first := clock_number;
    for i in 0 to 12 * c_places - 1 loop
      send(i, x"4000", std_logic_vector(to_unsigned(i, 16)));
    end loop;
    drain;
    assert clock_number - first <= 12 * 52 + 2
      report "depth_test_tb: " & to_string(12 * c_places) & " pixels took " & to_string(clock_number - first) & " clocks"
      severity failure;

    for part in 0 to 3 loop
      slow <= part >= 2;
      back <= to_flag(part mod 2 = 1);
      drain;
      for n in 1 to 1500 loop
        random := next_random(random);
        length := to_integer(random(5 downto 0)) + 1;
        if random(7 downto 6) = "00" then
          length := 1;
        end if;
        place := to_integer(random(30 downto 8)) mod (c_region - 64) + 32;
        if random(31) = '1' then
          place := c_pixels - c_region + place;
        end if;
        random := next_random(random);
        step   := 1;
        if random(0) = '1' then
          step := -1;
        end if;
        for i in 0 to length - 1 loop
          random := next_random(random);
          exit when place = 0 or place = c_pixels - 1 or place = c_region or place = c_pixels - c_region;
          -- Depths from few values, so that equal ones occur.
          send(place, x"00" & std_logic_vector(random(7 downto 0)), std_logic_vector(random(23 downto 8)));
          place := place + step;
          if random(31 downto 26) = 0 then
            step := -step;
          elsif random(31 downto 26) = 1 then
            pause(clk, random, 2);
          end if;
        end loop;
        -- Make the pixels far again from time to time.
        if n mod 50 = 0 then
          drain;
          for i in 0 to c_region - 1 loop
            set_both(c_depth_base + i, c_farthest);
            set_both(c_words - 1 - i, c_farthest);
          end loop;
        end if;
      end loop;
      drain;
    end loop;
    for i in 0 to c_words - 1 loop
      check("depth_test: address", i, "word", sram.get(i), expected.get(i));
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "depth_test_tb");
end architecture;
