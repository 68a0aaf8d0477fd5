-- SPDX-License-Identifier: Apache-2.0
-- Shaded objects of scenes: at full speed, with a slow source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity fragment_output_tb is
  generic (g_folder : string := "fragment_output");
end entity;

architecture sim of fragment_output_tb is
  constant c_pace : positive := 60; -- number of words between changes of the pace
begin
  shaders : for i in c_shaders'range generate
    constant c_config  : config_t  := c_shaders(i);
    constant c_file    : string    := g_folder & "/" & config_name(c_config) & ".txt";
    constant c_formats : formats_t := formats(c_config.exact);

    signal ended                           : boolean := false;
    signal clk                             : std_logic := '0';
    signal reset, token_valid, token_ready : std_logic;
    signal token                           : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal fragment_valid, fragment_ready  : std_logic;
    signal fragment_triangle               : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
    signal fragment_y                      : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
    signal fragment_x                      : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
    signal fragment_z                      : std_logic_vector(c_formats.depth.bits - 1 downto 0);
    signal fragment_red, fragment_green    : std_logic_vector(c_formats.colour.bits - 1 downto 0);
    signal fragment_blue                   : std_logic_vector(c_formats.colour.bits - 1 downto 0);
    signal fragment                        : std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length
      + fragment_z'length + 3 * fragment_red'length - 1 downto 0);
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

    fragment <= fragment_triangle & fragment_y & fragment_x & fragment_z & fragment_red & fragment_green & fragment_blue;

    clk <= not clk after c_half_period when not ended;

    source : entity work.stream_source
      generic map (g_file => c_file, g_pace => c_pace, g_pause => 1)
      port map (clk => clk, reset => reset, valid => token_valid, ready => token_ready, word => token, fed => open);

    sink : entity work.stream_sink
      generic map (g_name => c_file, g_pace => 2 * c_pace, g_pause => 1)
      port map (clk => clk, reset => reset, valid => fragment_valid, ready => fragment_ready, word => fragment);

    check : process is
      variable vectors : vectors_t;
      variable word    : std_logic_vector(token'range);
    begin
      vectors.open_file(c_file);
      while vectors.next_vector loop
        vectors.read_word(word);
        wait until rising_edge(clk) and fragment_valid = '1' and fragment_ready = '1' and reset = '0';
        vectors.check("triangle", fragment_triangle);
        vectors.check("y", fragment_y);
        vectors.check("x", fragment_x);
        vectors.check("z", fragment_z);
        vectors.check("red", fragment_red);
        vectors.check("green", fragment_green);
        vectors.check("blue", fragment_blue);
      end loop;
      for clock in 1 to 10 loop
        wait until rising_edge(clk);
        if fragment_valid /= '0' then
          vectors.fail("a fragment more than there are");
        end if;
      end loop;
      ended <= true;
      finish(finished);
    end process;

    -- A fragment is output one clock after its token. A token is accepted whenever the output register is free.
    pace : process (clk) is
      variable taken : boolean := false;
    begin
      if rising_edge(clk) and reset = '0' then
        assert not taken or fragment_valid = '1' report c_file & ": a fragment is late" severity failure;
        assert token_ready = '1' or (fragment_valid = '1' and fragment_ready = '0')
          report c_file & ": a token is not taken" severity failure;
        taken := token_valid = '1' and token_ready = '1';
      end if;
    end process;
  end generate;

  report_end(finished, "fragment_output_tb");
end architecture;
