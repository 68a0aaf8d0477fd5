-- SPDX-License-Identifier: Apache-2.0
-- Spots and other lights, points inside and outside the cone, any exponents, in the clocks of the schedule. Dot product
-- and products are 'X' in the clocks in which the contract does not read them.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.tb_processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity shared_weight_tb is
  generic (g_folder : string := "shared_weight");
end entity;

architecture sim of shared_weight_tb is
begin
  processors : for i in c_processors'range generate
    constant c_config  : config_t   := c_processors(i).config;
    constant c_kind    : natural    := c_processors(i).kind;
    constant c_light   : natural    := c_processors(i).light;
    constant c_at      : schedule_t := schedule(c_config, c_kind, c_light);
    constant c_formats : formats_t  := formats(c_config.exact);
  begin
    needed : if c_kind /= c_ambient generate
      subtype dot_t    is std_logic_vector(2 * c_formats.direction.bits downto 0);
      subtype weight_t is std_logic_vector(c_formats.weight.bits - 1 downto 0);

      signal clk            : std_logic := '0';
      signal cycle          : natural range 0 to c_at.leave := 0;
      signal spot           : std_logic;
      signal outer          : std_logic_vector(c_formats.direction.bits - 1 downto 0);
      signal slope          : std_logic_vector(c_formats.spot_slope.bits - 1 downto 0);
      signal exponent       : std_logic_vector(c_formats.exponent.bits - 1 downto 0);
      signal dot            : dot_t;
      signal products       : std_logic_vector(c_axes * shared_product_bits(c_config, c_kind, c_light) - 1 downto 0);
      signal weight, factor : weight_t;
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

      run : process is
        variable vectors       : vectors_t;
        variable is_spot       : std_logic;
        variable dot_half      : dot_t; -- N and A
        variable dot_axis      : dot_t; -- L and the axis
        variable narrowed      : std_logic_vector(2 * weight'length - 1 downto 0);
        variable raised, share : weight_t;
      begin
        vectors.open_file(g_folder & "/" & processor_name(c_processors(i)) & ".txt");
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
            if step > c_at.angle then
              tick(clk);
            end if;
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
            settle;
            if step = c_at.narrow and is_spot = '1' and (weight /= raised or factor /= share) then
              vectors.fail("weight and factor are " & to_hstring(weight) & " " & to_hstring(factor) & ", expected "
                & to_hstring(raised) & " " & to_hstring(share));
            end if;
          end loop;
          vectors.check("weight", weight);
          tick(clk);
        end loop;
        finish(finished);
      end process;
    end generate;
  end generate;

  report_end(finished, "shared_weight_tb");
end architecture;
