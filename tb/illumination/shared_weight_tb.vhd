-- SPDX-License-Identifier: Apache-2.0
-- Spots and other lights, points inside and outside the cone, any exponents, in the clocks of the schedule. Dot product and
-- products are 'X' in the clocks in which the contract does not read them.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;
use work.tb_processors_pkg.all;

entity shared_weight_run is
  generic (
    g_processor : processor_t;
    g_folder    : string
  );
  port (
    finished : buffer boolean := false
  );
end entity;

architecture sim of shared_weight_run is
  constant c_config : config_t   := g_processor.config;
  constant c_kind   : natural    := g_processor.kind;
  constant c_light  : natural    := g_processor.light;
  constant c_at     : schedule_t := schedule(c_config, c_kind, c_light);

  signal clk      : std_logic := '0';
  signal cycle    : natural range 0 to c_at.leave := 0;
  signal spot     : std_logic := '0';
  signal outer    : std_logic_vector(formats(c_config.exact).direction.bits - 1 downto 0) := (others => '0');
  signal slope    : std_logic_vector(formats(c_config.exact).spot_slope.bits - 1 downto 0) := (others => '0');
  signal exponent : std_logic_vector(formats(c_config.exact).exponent.bits - 1 downto 0) := (others => '0');
  signal dot      : std_logic_vector(2 * formats(c_config.exact).direction.bits downto 0) := (others => 'X');
  signal products : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
  signal weight   : std_logic_vector(formats(c_config.exact).weight.bits - 1 downto 0);
  signal factor   : std_logic_vector(weight'range);
begin
  dut : entity work.shared_weight
    generic map (g_config => c_config, g_kind => c_kind, g_light => c_light)
    port map (
      clk      => clk,
      cycle    => cycle,
      spot     => spot,
      outer    => outer,
      slope    => slope,
      exponent => exponent,
      dot      => dot,
      products => products,
      weight   => weight,
      factor   => factor);

  clk <= not clk after c_half_period when not finished;

  run : process is
    variable vectors  : vectors_t;
    variable is_spot  : std_logic;
    variable dot_half : std_logic_vector(dot'range); -- N and A
    variable dot_axis : std_logic_vector(dot'range); -- L and the axis
    variable narrowed : std_logic_vector(2 * weight'length - 1 downto 0);
    variable raised   : std_logic_vector(weight'range);
    variable share    : std_logic_vector(weight'range);
  begin
    vectors.open_file(g_folder & "/" & processor_name(g_processor) & ".txt");
    while vectors.next_vector loop
      vectors.read_flag(is_spot);
      spot <= is_spot;
      vectors.drive(outer);
      vectors.drive(slope);
      vectors.drive(exponent);
      vectors.read_word(dot_half);
      vectors.read_word(dot_axis);
      vectors.read_word(narrowed);
      vectors.read_word(raised);
      vectors.read_word(share);
      for step in c_at.angle to c_at.weigh loop
        -- A light that is no spot skips the cone
        next when is_spot = '0' and step >= c_at.weigh_in and step < c_at.weigh;
        cycle    <= step;
        dot      <= (others => 'X');
        products <= (others => 'X');
        if step = c_at.angle then
          dot <= dot_half;
        elsif step = c_at.cone and is_spot = '1' then
          dot <= dot_axis;
        end if;
        if step = c_at.narrowed then
          products(narrowed'range) <= narrowed;
        end if;
        wait until rising_edge(clk);
        if step = c_at.narrow and is_spot = '1' and (weight /= raised or factor /= share) then
          vectors.fail("weight and factor are " & to_hstring(weight) & " " & to_hstring(factor) & ", expected "
            & to_hstring(raised) & " " & to_hstring(share));
        end if;
      end loop;
      vectors.check("weight", weight);
    end loop;
    finished <= true;
    wait;
  end process;
end architecture;

use work.processors_pkg.all;
use work.tb_processors_pkg.all;

entity shared_weight_tb is
  generic (
    g_folder : string := "shared_weight"
  );
end entity;

architecture sim of shared_weight_tb is
  signal finished : boolean_vector(c_processors'range);
begin
  processors : for i in c_processors'range generate
    constant c_processor : processor_t := c_processors(i);
    begin
      unit : if c_processor.kind /= c_ambient generate
        checker : entity work.shared_weight_run
          generic map (c_processor, g_folder)
          port map (finished(i));
      else generate
        finished(i) <= true;
      end generate;
  end generate;

  done : process is
  begin
    wait until and finished;
    report "shared_weight_tb: passed" severity note;
    wait;
  end process;
end architecture;
