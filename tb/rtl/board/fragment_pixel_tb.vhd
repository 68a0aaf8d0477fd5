-- SPDX-License-Identifier: Apache-2.0
-- Fragments inside and outside the frame, at full speed and with random stalls at both ends. The pixels equal the
-- golden model's, in order, one clock later; each fragment outside is reported once.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.tb_pkg.all;

entity fragment_pixel_tb is
  generic (g_folder : string := "fragment_pixel");
end entity;

architecture sim of fragment_pixel_tb is
  signal ended                        : boolean := false;
  signal clk                          : std_logic := '0';
  signal reset                        : std_logic := '1';
  signal fragment_valid               : std_logic := '0';
  signal fragment_ready               : std_logic;
  signal fragment_y, fragment_x       : std_logic_vector(11 downto 0) := (others => '0');
  signal fragment_z                   : std_logic_vector(23 downto 0) := (others => '0');
  signal fragment_red, fragment_green : std_logic_vector(7 downto 0) := (others => '0');
  signal fragment_blue                : std_logic_vector(7 downto 0) := (others => '0');
  signal pixel_valid                  : std_logic;
  signal pixel_ready                  : std_logic := '1';
  signal pixel_place                  : place_t;
  signal pixel_depth, pixel_colour    : word_t;
  signal outside                      : std_logic;

  signal stalls, fed      : boolean := false;
  signal dropped, reports : natural := 0;
begin
  dut : entity work.fragment_pixel
    port map (
      clk            => clk,
      reset          => reset,
      fragment_valid => fragment_valid,
      fragment_ready => fragment_ready,
      fragment_y     => fragment_y,
      fragment_x     => fragment_x,
      fragment_z     => fragment_z,
      fragment_red   => fragment_red,
      fragment_green => fragment_green,
      fragment_blue  => fragment_blue,
      pixel_valid    => pixel_valid,
      pixel_ready    => pixel_ready,
      pixel_place    => pixel_place,
      pixel_depth    => pixel_depth,
      pixel_colour   => pixel_colour,
      outside        => outside);

  clk <= not clk after c_half_period when not ended;

  feed : process is
    variable vectors : vectors_t;
    variable random  : unsigned(31 downto 0) := to_unsigned(1, 32);
  begin
    wait_clocks(clk, 3);
    reset <= '0';
    for pass in 0 to 1 loop
      stalls <= pass = 1;
      vectors.open_file(g_folder & "/fragments.txt");
      while vectors.next_vector loop
        if stalls then
          pause(clk, random, 1);
        end if;
        vectors.drive(fragment_y);
        vectors.drive(fragment_x);
        vectors.drive(fragment_z);
        vectors.drive(fragment_red);
        vectors.drive(fragment_green);
        vectors.drive(fragment_blue);
        fragment_valid <= '1';
        wait until rising_edge(clk) and fragment_ready = '1';
        fragment_valid <= '0';
      end loop;
      vectors.close_file;
      wait_clocks(clk, 40);
    end loop;
    fed <= true;
    wait;
  end process;

  stall : process (clk) is
    variable random : unsigned(31 downto 0) := to_unsigned(2, 32);
  begin
    if rising_edge(clk) then
      random      := next_random(random);
      pixel_ready <= to_flag(not stalls or random(30) = '1');
    end if;
  end process;

  compare : process is
    variable vectors         : vectors_t;
    variable inside          : std_logic;
    variable word            : std_logic_vector(23 downto 0);
  begin
    for pass in 0 to 1 loop
      vectors.open_file(g_folder & "/fragments.txt");
      while vectors.next_vector loop
        for i in 1 to 2 loop
          vectors.read_word(word(11 downto 0)); -- y, x
        end loop;
        vectors.read_word(word); -- z
        for i in 1 to 3 loop
          vectors.read_word(word(7 downto 0)); -- red, green, blue
        end loop;
        vectors.read_flag(inside);
        if inside = '0' then
          dropped <= dropped + 1;
          wait for 0 ns;
          next;
        end if;
        wait until rising_edge(clk) and pixel_valid = '1' and pixel_ready = '1';
        vectors.check("place", pixel_place);
        vectors.check("depth", pixel_depth);
        vectors.check("colour", pixel_colour);
      end loop;
      vectors.close_file;
    end loop;
    wait until fed;
    check("fragment_pixel: pass", 1, "number of fragments reported as outside", reports, dropped);
    assert dropped > 0 report "fragment_pixel_tb: no fragment is outside" severity failure;
    ended <= true;
    finish(finished);
  end process;

  -- Latency, throughput, stability, and the count of reports.
  watch : process (clk) is
    variable taken   : boolean := false;
    variable waiting : boolean := false;
    variable held    : std_logic_vector(48 downto 0);
  begin
    if rising_edge(clk) and reset = '0' then
      assert not taken or pixel_valid = '1' or outside = '1'
        report "fragment_pixel_tb: no pixel one clock after a fragment" severity failure;
      assert fragment_ready = '1' or (stalls and pixel_valid = '1')
        report "fragment_pixel_tb: a fragment waits without need" severity failure;
      assert not waiting or (pixel_valid = '1' and std_logic_vector(pixel_place) & pixel_depth & pixel_colour = held)
        report "fragment_pixel_tb: a pixel that waits changes" severity failure;
      taken   := fragment_valid = '1' and fragment_ready = '1';
      waiting := pixel_valid = '1' and pixel_ready = '0';
      held    := std_logic_vector(pixel_place) & pixel_depth & pixel_colour;
      if outside = '1' then
        reports <= reports + 1;
      end if;
    end if;
  end process;

  report_end(finished, "fragment_pixel_tb");
end architecture;
