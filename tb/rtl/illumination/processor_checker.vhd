-- SPDX-License-Identifier: Apache-2.0
-- Feeds each shading processor of the list, folded or unrolled, from a file and compares every output token with the
-- golden model's: at full speed, with a slow source, with a slow sink, and with both.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;
use work.tb_processors_pkg.all;

entity processor_checker is
  generic (
    g_unrolled : boolean;
    g_folder   : string
  );
end entity;

architecture sim of processor_checker is
  constant c_pace : positive := 50; -- number of tokens between changes of the pace
begin
  processors : for i in c_processors'range generate
    constant c_config : config_t := c_processors(i).config;
    constant c_kind   : natural  := c_processors(i).kind;
    constant c_light  : natural  := c_processors(i).light;
    constant c_file   : string   := g_folder & "/" & processor_name(c_processors(i)) & ".txt";

    signal ended                     : boolean := false;
    signal clk                       : std_logic := '0';
    signal reset, in_valid, in_ready : std_logic;
    signal in_token                  : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal out_valid, out_ready      : std_logic;
    signal out_token                 : std_logic_vector(in_token'range);
    signal busy                      : std_logic;
    signal fed                       : boolean;
  begin
    folded : if not g_unrolled generate
      dut : entity work.shading_processor
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
    else generate
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
    end generate;

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
    begin
      vectors.open_file(c_file);
      while vectors.next_vector loop
        vectors.read_word(word);
        wait until rising_edge(clk) and out_valid = '1' and out_ready = '1' and reset = '0';
        if busy /= '1' then
          vectors.fail("a token leaves, but busy is " & to_string(busy));
        end if;
        vectors.check("token", out_token);
      end loop;
      for clock in 1 to 100 loop
        wait until rising_edge(clk);
        if out_valid /= '0' or busy /= '0' then
          vectors.fail("a token more than there are, or busy without one");
        end if;
      end loop;
      if not fed then
        vectors.fail("not all tokens were taken");
      end if;
      ended <= true;
      finish(finished);
    end process;

    -- Check the throughput and latency of the unrolled form: one token that loads no light per clock, except in a stall and in the clock after
    -- it, and the first token after the promised time.
    unrolled : if g_unrolled generate
      pace : process (clk) is
        constant c_header  : pixel_header_t := pixel_header(c_config.exact);
        constant c_latency : positive       := times(c_config, c_kind, c_light).leave;
        variable clocks : natural        := 0;
        variable taken  : boolean        := false;
        variable left   : boolean        := false;
        variable stalls : boolean        := false; -- the output is stalled
        variable before : boolean        := false; -- it was in the clock before
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
  end generate;
end architecture;
