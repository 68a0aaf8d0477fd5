-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of seven pipelines against the golden model. The latencies of terms_pkg, which are measured,
-- must be those that the entity's header promises.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity unrolled_shading_processor_tb is
  generic (g_folder : string := "unrolled_shading_processor");
end entity;

architecture sim of unrolled_shading_processor_tb is
  type clocks_t is array (boolean) of positive; -- published, exact

  type promise_t is record
    directional, positional, spots : natural;
    specular, normalize            : boolean;
    kind                           : natural;
    clocks                         : clocks_t;
  end record;

  type promises_t is array (natural range <>) of promise_t;

  -- With specular, the ambient processor of preset exact computes the view vector.
  constant c_promises : promises_t := (
    (0, 0, 0, false, false, c_ambient, (5, 6)),
    (0, 0, 0, false, true, c_ambient, (10, 18)),
    (1, 0, 0, true, false, c_diffuse, (7, 9)),
    (1, 0, 0, true, false, c_specular, (13, 35)),
    (0, 1, 0, true, false, c_diffuse, (15, 27)),
    (0, 1, 0, true, false, c_specular, (21, 53)),
    (0, 0, 1, true, false, c_diffuse, (23, 35)),
    (0, 0, 1, true, false, c_specular, (23, 54)));
begin
  processors : for i in c_processors'range generate
    constant c_config : config_t := c_processors(i).config;
    constant c_kind   : natural  := c_processors(i).kind;
    constant c_light  : natural  := c_processors(i).light;
    constant c_file   : string   := g_folder & "/" & processor_name(c_processors(i));

    signal clk, reset, in_valid, in_ready, out_valid, out_ready, busy : std_logic;
    signal in_token, out_token : std_logic_vector(token_bits(c_config) - 1 downto 0);
  begin
    dut : entity work.unrolled_shading_processor
      generic map (
        g_exact       => c_config.exact,
        g_channels    => c_config.channels,
        g_directional => c_config.directional,
        g_positional  => c_config.positional,
        g_spots       => c_config.spots,
        g_diffuse     => c_config.diffuse,
        g_specular    => c_config.specular,
        g_normalize   => c_config.normalize,
        g_shadows     => c_config.shadows,
        g_kind        => c_kind,
        g_light       => c_light)
      port map (
        clk       => clk,
        reset     => reset,
        in_valid  => in_valid,
        in_ready  => in_ready,
        in_token  => in_token,
        out_valid => out_valid,
        out_ready => out_ready,
        out_token => out_token,
        busy      => busy);

    stream : entity work.stream_checker
      generic map (g_file => c_file, g_widths => (0 => out_token'length))
      port map (clk, reset, in_valid, in_ready, in_token, out_valid, out_ready, out_token, busy, '0');

      -- One token that loads no light is taken per clock, except in a stall and in the clock after it. The first token leaves
      -- after the promised time.
    pace : process (clk) is
      constant c_header  : pixel_header_t := pixel_header(c_config.exact);
      constant c_latency : positive       := times(c_config, c_kind, c_light).leave;

      variable clocks : natural := 0;
      variable taken  : boolean := false;
      variable left   : boolean := false;
      variable stalls : boolean := false; -- the output is stalled
      variable before : boolean := false; -- it was in the clock before
    begin
      if rising_edge(clk) and reset = '0' then
        before := stalls;
        stalls := out_valid = '1' and out_ready = '0';
        assert in_ready = '1' or in_valid = '0' or stalls or before
          or (unsigned(in_token(c_header.command.high downto c_header.command.low)) > c_new_frame
          and unsigned(in_token(c_header.command.high downto c_header.command.low)) /= c_shadow)
          report c_file & ": a token is not taken at once" severity failure;
        if taken and not left then
          clocks := clocks + 1;
          left   := out_valid = '1';
          assert not left or clocks = c_latency
            report c_file & ": the first token leaves after " & to_string(clocks) & " clocks, expected "
            & to_string(c_latency) severity failure;
        end if;
        taken := taken or (in_valid = '1' and in_ready = '1');
      end if;
    end process;
  end generate;

  promises : process is
  begin
    for exact in boolean loop
      for i in c_promises'range loop
        check("unrolled_shading_processor, preset " & preset_name(exact) & ", promise", i, "its number of clocks",
          times(config(exact, 3, c_promises(i).directional, c_promises(i).positional, c_promises(i).spots, true,
          c_promises(i).specular, c_promises(i).normalize, false), c_promises(i).kind,
          boolean'pos(c_promises(i).kind /= c_ambient)).leave, c_promises(i).clocks(exact));
      end loop;
    end loop;
    finish(finished);
  end process;

  report_end(finished, "unrolled_shading_processor_tb");
end architecture;
