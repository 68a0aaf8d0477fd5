-- SPDX-License-Identifier: Apache-2.0
-- Feeds one shading processor, folded or unrolled, from a file and compares every output token with the golden model's:
-- at full speed, with a slow source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity processor_checker is
  generic (
    g_unrolled    : boolean;
    g_exact       : boolean;
    g_channels    : positive;
    g_directional : natural;
    g_positional  : natural;
    g_spots       : natural;
    g_diffuse     : boolean;
    g_specular    : boolean;
    g_normalize   : boolean;
    g_shadows     : boolean;
    g_kind        : natural;
    g_light       : natural;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of processor_checker is
  constant c_config : config_t := config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows);
  constant c_bits : positive := token_bits(c_config);
  -- Number of tokens between changes of the pace.
  constant c_pace : positive := 50;

  function digit (flag : boolean) return string is
  begin
    return to_string(boolean'pos(flag));
  end function;

  constant c_file : string := g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels)
    & to_string(g_directional) & to_string(g_positional) & to_string(g_spots) & digit(g_diffuse) & digit(g_specular)
    & digit(g_normalize) & digit(g_shadows) & "_" & to_string(g_kind) & to_string(g_light) & ".txt";

  signal clk       : std_logic := '0';
  signal reset     : std_logic := '1';
  signal in_valid  : std_logic := '0';
  signal in_ready  : std_logic;
  signal in_token  : std_logic_vector(c_bits - 1 downto 0) := (others => '0');
  signal out_valid : std_logic;
  signal out_ready : std_logic := '0';
  signal out_token : std_logic_vector(c_bits - 1 downto 0);
  signal busy      : std_logic;
  signal fault     : std_logic;
  signal fed       : boolean := false;
  signal ended     : boolean := false;

  impure function slow (part : natural; count : natural) return boolean is
  begin
    return (count / c_pace / part) mod 2 = 1;
  end function;
begin
  folded : if not g_unrolled generate
    dut : entity work.shading_processor
      generic map (
        g_exact       => g_exact,
        g_channels    => g_channels,
        g_directional => g_directional,
        g_positional  => g_positional,
        g_spots       => g_spots,
        g_diffuse     => g_diffuse,
        g_specular    => g_specular,
        g_normalize   => g_normalize,
        g_shadows     => g_shadows,
        g_kind        => g_kind,
        g_light       => g_light)
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
  else generate
    dut : entity work.unrolled_shading_processor
      generic map (
        g_exact       => g_exact,
        g_channels    => g_channels,
        g_directional => g_directional,
        g_positional  => g_positional,
        g_spots       => g_spots,
        g_diffuse     => g_diffuse,
        g_specular    => g_specular,
        g_normalize   => g_normalize,
        g_shadows     => g_shadows,
        g_kind        => g_kind,
        g_light       => g_light)
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
  end generate;

  clk <= not clk after c_half_period when not ended;

  source : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(in_token'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(c_bits + 8 * g_kind + g_light, 32);
    variable count   : natural               := 0;
  begin
    vectors.open_file(c_file);
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    while vectors.next_vector loop
      vectors.read_word(word);
      if slow(1, count) then
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 2);
          wait until rising_edge(clk);
        end loop;
      end if;
      in_token <= word;
      in_valid <= '1';
      wait until rising_edge(clk) and in_ready = '1';
      in_valid <= '0';
      in_token <= (others => 'X');
      count := count + 1;
    end loop;
    fed <= true;
    wait;
  end process;

  sink : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(in_token'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(3 * c_bits + 8 * g_kind + g_light, 32);
    variable count   : natural               := 0;
    variable faulty  : std_logic             := '0'; -- expected fault after the previous token
  begin
    vectors.open_file(c_file);
    while vectors.next_vector loop
      vectors.read_word(word);
      if slow(2, count) then
        loop
          random := next_random(random);
          exit when chance(random(31 downto 24), 3);
          wait until rising_edge(clk);
        end loop;
      end if;
      out_ready <= '1';
      wait until rising_edge(clk) and out_valid = '1' and reset = '0';
      out_ready <= '0';
      if busy /= '1' then
        vectors.fail("a token leaves, but busy is " & to_string(busy));
      end if;
      vectors.check_word("token", out_token);
      if faulty = '1' and fault /= '1' then
        vectors.fail("no fault after the token before");
      end if;
      vectors.read_flag(faulty);
      count := count + 1;
    end loop;
    out_ready <= '1';
    for i in 1 to 100 loop
      wait until rising_edge(clk);
      if out_valid /= '0' or busy /= '0' then
        vectors.fail("a token more than there are, or busy without one");
      end if;
    end loop;
    if fault /= faulty then
      vectors.fail("fault is " & to_string(fault) & " in the end, expected " & to_string(faulty));
    end if;
    if not fed then
      vectors.fail("not all tokens were taken");
    end if;
    ended    <= true;
    finished <= true;
    wait;
  end process;

  -- Check the throughput and latency of the unrolled form: one object per clock, and the first token after the promised
  -- time.
  unrolled : if g_unrolled generate
    pace : process (clk) is
      constant c_header  : pixel_header_t := pixel_header(g_exact);
      constant c_latency : positive       := times(c_config, g_kind, g_light).leave;
      variable clocks    : natural        := 0;
      variable taken     : boolean        := false;
      variable left      : boolean        := false;
    begin
      if rising_edge(clk) and reset = '0' then
        assert in_ready = '1' or in_valid = '0' or (out_valid = '1' and out_ready = '0') or g_shadows
          or unsigned(in_token(c_header.command.high downto c_header.command.low)) > c_new_scanline
          report c_file & ": an object is not taken at once" severity failure;
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

  steady : process (clk) is
    variable waiting : boolean := false;
    variable held    : std_logic_vector(out_token'range);
  begin
    if rising_edge(clk) then
      assert not waiting or (out_valid = '1' and out_token = held)
        report c_file & ": a token changes while it waits" severity failure;
      waiting := out_valid = '1' and out_ready = '0' and reset = '0';
      held    := out_token;
    end if;
  end process;
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;

entity pipeline_checker is
  generic (
    g_unrolled    : boolean;
    g_exact       : boolean;
    g_channels    : positive;
    g_directional : natural;
    g_positional  : natural;
    g_spots       : natural;
    g_diffuse     : boolean;
    g_specular    : boolean;
    g_normalize   : boolean;
    g_shadows     : boolean;
    g_folder      : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of pipeline_checker is
  constant c_lights : natural := g_directional + g_positional + g_spots;

  signal ambient_finished : boolean;
  signal diffuse_finished, specular_finished : boolean_vector(1 to c_lights) := (others => false);
begin
  ambient : entity work.processor_checker
    generic map (g_unrolled, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
      g_shadows, c_ambient, 0, g_folder)
    port map (ambient_finished);

  lights : for light in 1 to c_lights generate
    diffuse : if g_diffuse generate
      checker : entity work.processor_checker
        generic map (g_unrolled, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
          g_shadows, c_diffuse, light, g_folder)
        port map (diffuse_finished(light));
    else generate
      diffuse_finished(light) <= true;
    end generate;

    specular : if g_specular generate
      checker : entity work.processor_checker
        generic map (g_unrolled, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
          g_shadows, c_specular, light, g_folder)
        port map (specular_finished(light));
    else generate
      specular_finished(light) <= true;
    end generate;
  end generate;

  finished <= ambient_finished and (and diffuse_finished) and (and specular_finished);
end architecture;

library ieee;
use ieee.std_logic_1164.all;

-- Both presets, every processor of five pipelines: one with all effects, the paper's version I, one with only a
-- positional light, and two with single effects. tb/vectors/processors.cpp has the same list.
entity processors_checker is
  generic (
    g_unrolled : boolean;
    g_folder   : string
  );
  port (
    finished : out boolean := false
  );
end entity;

architecture sim of processors_checker is
  signal checked : boolean_vector(0 to 9);
begin
  presets : for preset in 0 to 1 generate
    all_effects : entity work.pipeline_checker
      generic map (g_unrolled, preset = 0, 3, 1, 1, 1, true, true, true, true, g_folder)
      port map (checked(5 * preset));

    version_1 : entity work.pipeline_checker
      generic map (g_unrolled, preset = 0, 3, 1, 0, 0, true, true, false, false, g_folder)
      port map (checked(5 * preset + 1));

    version_2 : entity work.pipeline_checker
      generic map (g_unrolled, preset = 0, 3, 0, 1, 0, true, true, true, false, g_folder)
      port map (checked(5 * preset + 2));

    diffuse_alone : entity work.pipeline_checker
      generic map (g_unrolled, preset = 0, 1, 1, 0, 0, true, false, false, false, g_folder)
      port map (checked(5 * preset + 3));

    specular_alone : entity work.pipeline_checker
      generic map (g_unrolled, preset = 0, 1, 0, 1, 1, false, true, false, false, g_folder)
      port map (checked(5 * preset + 4));
  end generate;

  finished <= and checked;
end architecture;
