-- SPDX-License-Identifier: Apache-2.0
-- Both forms in both presets, several lights. Light definitions, shadow polygons and new frames are mixed with the
-- objects. Every output object is compared with the golden model's: at full speed, with a slow source, with a slow
-- sink.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.processors_pkg.all;
use work.tb_pkg.all;

entity shading_pipeline_run is
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

architecture sim of shading_pipeline_run is
  constant c_bits : positive := token_bits(config(g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse,
    g_specular, g_normalize, g_shadows));
  -- Number of tokens, or objects, between changes of the pace.
  constant c_pace : positive := 60;

  function digit (flag : boolean) return string is
  begin
    return to_string(boolean'pos(flag));
  end function;

  constant c_file : string := g_folder & "/" & preset_name(g_exact) & "_" & to_string(g_channels)
    & to_string(g_directional) & to_string(g_positional) & to_string(g_spots) & digit(g_diffuse) & digit(g_specular)
    & digit(g_normalize) & digit(g_shadows) & ".txt";

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
begin
  dut : entity work.shading_pipeline
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
      g_unrolled    => g_unrolled)
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

  source : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(in_token'range);
    variable random  : unsigned(31 downto 0) := to_unsigned(c_bits, 32);
    variable count   : natural               := 0;
  begin
    vectors.open_file(c_file);
    for i in 1 to 3 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    while vectors.next_vector loop
      vectors.read_word(word);
      if (count / c_pace) mod 2 = 1 then
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
      count := count + 1;
    end loop;
    fed <= true;
    wait;
  end process;

  sink : process is
    variable vectors : vectors_t;
    variable word    : std_logic_vector(in_token'range);
    variable comes   : std_logic;
    variable faulty  : std_logic;
    variable random  : unsigned(31 downto 0) := to_unsigned(3 * c_bits, 32);
    variable count   : natural               := 0;
  begin
    vectors.open_file(c_file);
    while vectors.next_vector loop
      vectors.read_word(word);
      vectors.read_flag(comes);
      if comes = '1' then
        if (count / c_pace) mod 3 = 1 then
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
          vectors.fail("an object leaves, but busy is " & to_string(busy));
        end if;
        vectors.check_word("object", out_token);
        count := count + 1;
      else
        vectors.read_word(word);
      end if;
      vectors.read_flag(faulty);
    end loop;
    out_ready <= '1';
    if not fed then
      wait until fed;
    end if;
    wait until rising_edge(clk) and busy = '0';
    for i in 1 to 10 loop
      wait until rising_edge(clk);
      if out_valid /= '0' or busy /= '0' then
        vectors.fail("an object more than there are, or busy without one");
      end if;
    end loop;
    if fault /= faulty then
      vectors.fail("fault is " & to_string(fault) & " in the end, expected " & to_string(faulty));
    end if;
    ended    <= true;
    finished <= true;
    wait;
  end process;

  -- After the last object only tokens that are discarded may follow.
  dropped : process (clk) is
  begin
    if rising_edge(clk) and out_valid = '1' then
      assert unsigned(out_token(2 downto 0)) <= c_new_scanline
        report c_file & ": a token leaves that is no object" severity failure;
    end if;
  end process;
end architecture;

entity shading_pipeline_tb is
  generic (
    g_folder : string := "shading_pipeline"
  );
end entity;

architecture sim of shading_pipeline_tb is
  signal finished : boolean_vector(0 to 15);
begin
  forms : for form in 0 to 1 generate
    presets : for preset in 0 to 1 generate
      constant c_first : natural := 8 * form + 4 * preset;
      begin
        all_effects : entity work.shading_pipeline_run
          generic map (form = 1, preset = 0, 3, 1, 1, 1, true, true, true, true, g_folder)
          port map (finished => finished(c_first));

        version_1 : entity work.shading_pipeline_run
          generic map (form = 1, preset = 0, 3, 2, 0, 0, true, true, false, false, g_folder)
          port map (finished => finished(c_first + 1));

        specular_alone : entity work.shading_pipeline_run
          generic map (form = 1, preset = 0, 1, 0, 1, 1, false, true, true, false, g_folder)
          port map (finished => finished(c_first + 2));

        ambient_alone : entity work.shading_pipeline_run
          generic map (form = 1, preset = 0, 3, 0, 0, 0, false, false, true, false, g_folder)
          port map (finished => finished(c_first + 3));
    end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shading_pipeline_tb: passed" severity note;
    wait;
  end process;
end architecture;
