-- SPDX-License-Identifier: Apache-2.0
-- Random strips. Until the first stall a fragment leaves 8 clocks after the token that ends its pixel, later at least 8. A
-- token is taken in each clock without a stall.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.filter_pkg.all;
use work.tb_pkg.all;

entity pixel_filter_tb is
  generic (g_folder : string := "pixel_filter");
end entity;

architecture sim of pixel_filter_tb is
  constant c_latency : positive := 8;
  constant c_steady  : positive := 20; -- clocks without a stall, after which a token is taken in each clock

  type case_t is record
    exact      : boolean;
    channels   : positive;
    subpixels  : positive;
    weights    : filter_weights_t;
    background : std_logic_vector(23 downto 0);
  end record;

  type cases_t is array (natural range <>) of case_t;

  -- tb/vectors/filter.cpp has the same list.
  constant c_cases : cases_t := (
    (true, 3, 16, c_filter_weights, x"FFC811"), (true, 3, 16, c_filter_weights, x"0037EE"),
    (true, 1, 4, c_filter_weights, x"0000FF"), (true, 3, 1, (1, 0, 0, 0), x"7F8000"), (true, 1, 16, (9, 3, 3, 1), x"00005A"),
    (false, 3, 16, c_filter_weights, x"FE3300"), (false, 1, 1, (1, 0, 0, 0), x"0000FF"),
    (false, 3, 4, (1, 0, 2, 1), x"8001FF"));
begin
  filters : for i in c_cases'range generate
    constant c_case    : case_t    := c_cases(i);
    constant c_config  : config_t  := config(c_case.exact, c_case.channels, 1, 0, 0, true, true, true, false);
    constant c_formats : formats_t := formats(c_case.exact);
    constant c_bits    : positive  := token_bits(c_config);
    constant c_file    : string    := g_folder & "/" & preset_name(c_case.exact) & "_"
      & joined((c_case.channels, c_case.subpixels, c_case.weights(c_itself), c_case.weights(c_left),
      c_case.weights(c_above), c_case.weights(c_above_left))) & "_" & to_hstring(c_case.background);

    signal clk, reset, in_valid, in_ready : std_logic;
    signal in_word                        : std_logic_vector(weight_bits(c_case.subpixels) + c_bits - 1 downto 0);
    signal fragment_valid, fragment_ready : std_logic;
    signal fragment_triangle              : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
    signal fragment_y                     : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
    signal fragment_x                     : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
    signal fragment_z                     : std_logic_vector(c_formats.depth.bits - 1 downto 0);
    signal fragment_red, fragment_green   : std_logic_vector(c_formats.colour.bits - 1 downto 0);
    signal fragment_blue                  : std_logic_vector(c_formats.colour.bits - 1 downto 0);
    signal fragment                       : std_logic_vector(fragment_triangle'length + fragment_y'length + fragment_x'length
      + fragment_z'length + 3 * fragment_red'length - 1 downto 0);
  begin
    dut : entity work.pixel_filter
      generic map (g_config => c_config, g_subpixels => c_case.subpixels, g_weights => c_case.weights, g_column_bits => 8)
      port map (
        clk               => clk,
        reset             => reset,
        background        => c_case.background,
        token_valid       => in_valid,
        token_ready       => in_ready,
        token             => in_word(c_bits - 1 downto 0),
        token_weight      => in_word(in_word'high downto c_bits),
        fragment_valid    => fragment_valid,
        fragment_ready    => fragment_ready,
        fragment_triangle => fragment_triangle,
        fragment_y        => fragment_y,
        fragment_x        => fragment_x,
        fragment_z        => fragment_z,
        fragment_red      => fragment_red,
        fragment_green    => fragment_green,
        fragment_blue     => fragment_blue);

    fragment <= fragment_blue & fragment_green & fragment_red & fragment_z & fragment_x & fragment_y & fragment_triangle;

    check : entity work.stream_checker
      generic map (
        g_file   => c_file,
        g_pace   => 150,
        g_widths => (fragment_triangle'length, fragment_y'length, fragment_x'length, fragment_z'length, fragment_red'length,
        fragment_green'length, fragment_blue'length))
      port map (clk, reset, in_valid, in_ready, in_word, fragment_valid, fragment_ready, fragment, fragment_valid, '0');

    pace : process is
      variable ends    : vectors_t; -- for each fragment, the number of the token that ends its pixel
      variable taken   : integer_vector(0 to 511); -- clocks of the last tokens
      variable tokens  : natural := 0;
      variable clock   : natural := 0;
      variable free    : natural := 0; -- clocks since the last stall
      variable stalled : boolean := false;
      variable waited  : integer;
    begin
      ends.open_file(c_file & "_ends.txt");
      loop
        wait until rising_edge(clk) and reset = '0';
        clock := clock + 1;
        free  := free + 1;
        if fragment_ready = '0' then
          free    := 0;
          stalled := stalled or fragment_valid = '1';
        end if;
        if free > c_steady and in_ready /= '1' then
          ends.fail("a token is not taken");
        end if;
        if fragment_valid = '1' and fragment_ready = '1' then
          ends.expect_vector("a fragment");
          waited := clock - taken(ends.read_number mod taken'length);
          if waited < c_latency or (waited > c_latency and not stalled) then
            ends.fail("the fragment comes after " & to_string(waited) & " clocks");
          end if;
        end if;
        if in_valid = '1' and in_ready = '1' then
          taken(tokens mod taken'length) := clock;
          tokens                         := tokens + 1;
        end if;
      end loop;
    end process;
  end generate;

  report_end(finished, "pixel_filter_tb");
end architecture;
