-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of six pipelines against the golden model, by processor_checker. Also checks the
-- latency in clocks from an accepted token to the same token at the output, as the entity's header promises.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
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
    (0, 0, 0, false, false, c_ambient, (2, 2)),
    (0, 0, 0, false, true, c_ambient, (6, 9)),
    (1, 0, 0, true, false, c_diffuse, (4, 4)),
    (1, 0, 0, true, false, c_specular, (5, 18)),
    (0, 1, 0, true, false, c_diffuse, (10, 14)),
    (0, 1, 0, true, false, c_specular, (11, 28)),
    (0, 0, 1, true, false, c_diffuse, (14, 18)),
    (0, 0, 1, true, false, c_specular, (14, 29)));
begin
  checker : entity work.processor_checker
    generic map (g_unrolled => true, g_folder => g_folder);

  presets : for exact in boolean generate
    promises : for i in c_promises'range generate
      constant c_promise : promise_t := c_promises(i);
      constant c_config  : config_t  := config(exact, 3, c_promise.directional, c_promise.positional, c_promise.spots, true,
        c_promise.specular, c_promise.normalize, false);
      constant c_command : slice_t := pixel_header(exact).command;

      signal clk       : std_logic := '0';
      signal reset     : std_logic := '1';
      signal in_valid  : std_logic := '0';
      signal in_ready  : std_logic;
      signal in_token  : std_logic_vector(token_bits(c_config) - 1 downto 0) := (others => '0');
      signal out_valid : std_logic;
      signal out_token : std_logic_vector(in_token'range);
      begin
        dut : entity work.unrolled_shading_processor
          generic map (
            g_exact       => exact,
            g_channels    => 3,
            g_directional => c_promise.directional,
            g_positional  => c_promise.positional,
            g_spots       => c_promise.spots,
            g_diffuse     => true,
            g_specular    => c_promise.specular,
            g_normalize   => c_promise.normalize,
            g_shadows     => false,
            g_kind        => c_promise.kind,
            g_light       => boolean'pos(c_promise.kind /= c_ambient))
          port map (
            clk       => clk,
            reset     => reset,
            in_valid  => in_valid,
            in_ready  => in_ready,
            in_token  => in_token,
            out_valid => out_valid,
            out_ready => '1',
            out_token => out_token,
            busy      => open,
            fault     => open);

        run : process is
          variable clocks : natural := 0;
        begin
          for clock in 1 to 3 loop
            settle;
            tick(clk);
          end loop;
          reset    <= '0';
          in_valid <= '1';
          in_token(c_command.high downto c_command.low) <= std_logic_vector(to_unsigned(c_new_pixel, 3));
          loop
            settle;
            exit when in_ready = '1';
            tick(clk);
          end loop;
          tick(clk);
          in_valid <= '0';
          loop
            settle;
            clocks := clocks + 1;
            exit when out_valid = '1' or clocks > c_promise.clocks(exact);
            tick(clk);
          end loop;
          check("unrolled_shading_processor, preset " & preset_name(exact) & ", promise", i, "its number of clocks", clocks,
            c_promise.clocks(exact));
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "unrolled_shading_processor_tb");
end architecture;
