-- SPDX-License-Identifier: Apache-2.0
-- Shaded objects of scenes: at full speed, with a slow source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity fragment_output_run is
  generic (
    g_exact       : boolean;
    g_channels    : positive;
    g_directional : natural;
    g_positional  : natural;
    g_spots       : natural;
    g_specular    : boolean;
    g_normalize   : boolean;
    g_shadows     : boolean;
    g_file        : string -- file name, or its start
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of fragment_output_run is
  constant c_config : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, true, g_specular,
    g_normalize, g_shadows);
  -- Number of words between changes of the pace.
  constant c_pace : positive := 60;

  constant c_formats : formats_t := formats(g_exact);

  signal clk               : std_logic := '0';
  signal reset             : std_logic := '1';
  signal token_valid       : std_logic := '0';
  signal token_ready       : std_logic;
  signal token             : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
  signal fragment_valid    : std_logic;
  signal fragment_ready    : std_logic := '0';
  signal fragment_triangle : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal fragment_y        : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
  signal fragment_x        : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
  signal fragment_z        : std_logic_vector(c_formats.depth.bits - 1 downto 0);
  signal fragment_red      : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment_green    : std_logic_vector(c_formats.colour.bits - 1 downto 0);
  signal fragment_blue     : std_logic_vector(c_formats.colour.bits - 1 downto 0);

  impure function slow (part, count : natural) return boolean is
  begin
    return (count / c_pace / part) mod 2 = 1;
  end function;
begin
  dut : entity work.fragment_output
    generic map (g_config => c_config)
    port map (
      clk               => clk,
      reset             => reset,
      token_valid       => token_valid,
      token_ready       => token_ready,
      token             => token,
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => fragment_triangle,
      fragment_y        => fragment_y,
      fragment_x        => fragment_x,
      fragment_z        => fragment_z,
      fragment_red      => fragment_red,
      fragment_green    => fragment_green,
      fragment_blue     => fragment_blue);

  clk <= not clk after c_half_period when not finished;

  source : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(token'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(token_bits(c_config), 32);
    variable count   : natural := 0;
  begin
    vectors.open_file(g_file & ".txt");
    wait until rising_edge(clk);
    reset <= '0';
    while vectors.next_vector loop
      vectors.read_word(word);
      if slow(1, count) then
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 1);
          wait until rising_edge(clk);
        end loop;
      end if;
      token       <= word;
      token_valid <= '1';
      wait until rising_edge(clk) and token_ready = '1';
      token_valid <= '0';
      token       <= (others => 'X');
      count       := count + 1;
    end loop;
    wait;
  end process;

  sink : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(token'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(3 * token_bits(c_config), 32);
    variable count   : natural := 0;
  begin
    vectors.open_file(g_file & ".txt");
    while vectors.next_vector loop
      vectors.read_word(word);
      if slow(2, count) then
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 1);
          wait until rising_edge(clk);
        end loop;
      end if;
      fragment_ready <= '1';
      wait until rising_edge(clk) and fragment_valid = '1' and reset = '0';
      fragment_ready <= '0';
      vectors.check_word("triangle", fragment_triangle);
      vectors.check_word("y", fragment_y);
      vectors.check_word("x", fragment_x);
      vectors.check_word("z", fragment_z);
      vectors.check_word("red", fragment_red);
      vectors.check_word("green", fragment_green);
      vectors.check_word("blue", fragment_blue);
      count := count + 1;
    end loop;
    fragment_ready <= '1';
    for i in 1 to 10 loop
      wait until rising_edge(clk);
      if fragment_valid /= '0' then
        vectors.fail("a fragment more than there are");
      end if;
    end loop;
    finished <= true;
    wait;
  end process;

  -- A fragment is output one clock after its token. A token is accepted whenever the output register is free.
  pace : process (clk) is
    variable taken : boolean := false;
  begin
    if rising_edge(clk) and reset = '0' then
      assert not taken or fragment_valid = '1' report g_file & ": a fragment is late" severity failure;
      assert token_ready = '1' or (fragment_valid = '1' and fragment_ready = '0')
        report g_file & ": a token is not taken" severity failure;
      taken := token_valid = '1' and token_ready = '1';
    end if;
  end process;
end architecture;

entity fragment_output_tb is
  generic (
    g_folder : string := "fragment_output"
  );
end entity;

-- The configurations are those of write_parts in tb/vectors/processors_shader.cpp.
architecture sim of fragment_output_tb is
  signal finished : boolean_vector(0 to 3);
begin
  directional : entity work.fragment_output_run
    generic map (true, 3, 1, 0, 0, true, true, false, g_folder & "/directional")
    port map (finished(0));

  grey : entity work.fragment_output_run
    generic map (true, 1, 2, 0, 0, false, false, false, g_folder & "/grey")
    port map (finished(1));

  shadows : entity work.fragment_output_run
    generic map (true, 3, 1, 1, 0, true, true, true, g_folder & "/shadows")
    port map (finished(2));

  published : entity work.fragment_output_run
    generic map (false, 3, 1, 1, 1, true, true, false, g_folder & "/published")
    port map (finished(3));

  done : process is
  begin
    wait until and finished;
    report "fragment_output_tb: passed" severity note;
    wait;
  end process;
end architecture;
