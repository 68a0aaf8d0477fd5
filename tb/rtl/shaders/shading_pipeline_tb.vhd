-- SPDX-License-Identifier: Apache-2.0
-- Both forms in both presets, several lights. Light definitions, shadow polygons, heads and new frames are mixed with the
-- objects; the last token is for a light that does not exist. Every output object is compared with the golden model's: at
-- full speed, with a slow source, with a slow sink.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.tb_processors_pkg.all;
use work.tb_pkg.all;

entity shading_pipeline_tb is
  generic (g_folder : string := "shading_pipeline");
end entity;

architecture sim of shading_pipeline_tb is
  -- The configurations are those of write_pipelines in tb/vectors/processors.cpp: all effects, the paper's version I,
  -- highlights alone, the ambient term alone.
  function configs (exact : boolean) return configs_t is
  begin
    return (config(exact, 3, 1, 1, 1, true, true, true, true), config(exact, 3, 2, 0, 0, true, true, false, false),
      config(exact, 1, 0, 1, 1, false, true, true, false), config(exact, 3, 0, 0, 0, false, false, true, false));
  end function;

  constant c_configs : configs_t := configs(true) & configs(false);
  constant c_pace    : positive  := 60; -- number of tokens, or objects, between changes of the pace
begin
  pipelines : for i in 0 to 2 * c_configs'length - 1 generate
    constant c_config   : config_t := c_configs(i / 2);
    constant c_unrolled : boolean  := i mod 2 = 1;
    constant c_file     : string   := g_folder & "/" & config_name(c_config) & ".txt";

    signal ended                     : boolean := false;
    signal clk                       : std_logic := '0';
    signal reset, in_valid, in_ready : std_logic;
    signal in_token                  : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal out_valid, out_ready      : std_logic;
    signal out_token                 : std_logic_vector(in_token'range);
    signal busy, fault               : std_logic;
    signal fed                       : boolean;
  begin
    dut : entity work.shading_pipeline
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
        g_unrolled    => c_unrolled)
      port map (
        clk       => clk,
        reset     => reset,
        in_valid  => in_valid,
        in_ready  => in_ready,
        in_token  => in_token,
        out_valid => out_valid,
        out_ready => out_ready,
        out_token => out_token,
        busy      => busy,
        fault     => fault);

    clk <= not clk after c_half_period when not ended;

    source : entity work.stream_source
      generic map (g_file => c_file, g_pace => c_pace, g_pause => 2)
      port map (clk => clk, reset => reset, valid => in_valid, ready => in_ready, word => in_token, fed => fed);

    sink : entity work.stream_sink
      generic map (g_name => c_file, g_pace => 2 * c_pace, g_pause => 3)
      port map (clk => clk, reset => reset, valid => out_valid, ready => out_ready, word => out_token);

    check : process is
      variable vectors : vectors_t;
      variable word    : std_logic_vector(in_token'range);
      variable comes   : std_logic;
      variable faulty  : std_logic := '0'; -- after the token
    begin
      vectors.open_file(c_file);
      while vectors.next_vector loop
        vectors.read_word(word);
        vectors.read_flag(comes);
        if comes = '1' then
          wait until rising_edge(clk) and out_valid = '1' and out_ready = '1' and reset = '0';
          if busy /= '1' then
            vectors.fail("an object leaves, but busy is " & to_string(busy));
          end if;
          vectors.check("object", out_token);
        else
          vectors.read_word(word);
        end if;
        vectors.read_flag(faulty);
      end loop;
      if not fed then
        wait until fed;
      end if;
      wait until rising_edge(clk) and busy = '0';
      for clock in 1 to 10 loop
        wait until rising_edge(clk);
        if out_valid /= '0' or busy /= '0' then
          vectors.fail("an object more than there are, or busy without one");
        end if;
      end loop;
      if fault /= faulty then
        vectors.fail("fault is " & to_string(fault) & " in the end, expected " & to_string(faulty));
      end if;
      ended <= true;
      finish(finished);
    end process;

    -- fault is '1' after a token for a light that does not exist was offered, and only then.
    missing_light : process (clk) is
      variable expected : std_logic := '0';
    begin
      if rising_edge(clk) then
        assert fault = expected or reset = '1'
          report c_file & ": fault is " & to_string(fault) & ", expected " & to_string(expected) severity failure;
        if in_valid = '1' and unsigned(in_token(2 downto 0)) >= c_define
          and unsigned(field_of(in_token, pixel_header(c_config.exact).light)) > lights(c_config) then
          expected := '1';
        end if;
        if reset = '1' then
          expected := '0';
        end if;
      end if;
    end process;

    -- After the last object only tokens that are discarded may follow.
    dropped : process (clk) is
    begin
      if rising_edge(clk) and out_valid = '1' then
        assert unsigned(out_token(2 downto 0)) = c_new_object
          report c_file & ": a token leaves that is no object" severity failure;
      end if;
    end process;
  end generate;

  report_end(finished, "shading_pipeline_tb");
end architecture;
