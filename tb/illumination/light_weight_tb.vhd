-- SPDX-License-Identifier: Apache-2.0
-- Spots and other lights, points inside and outside the cone: one per clock, then with pauses. The cosine follows its
-- direction after c_leads clocks: the cone is the last, or the cosine.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity light_weight_tb is
  generic (g_folder : string := "light_weight");
end entity;

architecture sim of light_weight_tb is
  constant c_leads : integer_vector := (2, 16);
begin
  presets : for exact in boolean generate
    leads : for i in c_leads'range generate
      subtype vector_t is std_logic_vector(3 * formats(exact).direction.bits - 1 downto 0);
      subtype weight_t is std_logic_vector(formats(exact).weight.bits - 1 downto 0);

      signal clk                         : std_logic := '0';
      signal enable, spot                : std_logic;
      signal axis                        : vector_t;
      signal outer                       : std_logic_vector(formats(exact).direction.bits - 1 downto 0);
      signal slope                       : std_logic_vector(formats(exact).spot_slope.bits - 1 downto 0);
      signal to_light                    : vector_t;
      signal cosine, cosine_late, weight : weight_t;
      begin
        dut : entity work.light_weight
          generic map (g_exact => exact, g_lead => c_leads(i))
          port map (
            clk      => clk,
            enable   => enable,
            spot     => spot,
            axis     => axis,
            outer    => outer,
            slope    => slope,
            to_light => to_light,
            cosine   => cosine_late,
            weight   => weight);

        late : entity work.delay_line
          generic map (cosine'length, c_leads(i))
          port map (clk, enable, cosine, cosine_late);

        run : process is
          variable vectors : vectors_t;
        begin
          vectors.open_file(g_folder & "/" & preset_name(exact) & "_" & to_string(c_leads(i)) & ".txt",
            c_leads(i) + light_weight_latency(true, c_leads(i)));
          while vectors.next_clock loop
            vectors.drive(enable);
            vectors.drive(spot);
            vectors.drive(axis);
            vectors.drive(outer);
            vectors.drive(slope);
            vectors.drive(to_light);
            vectors.drive(cosine);
            settle;
            vectors.check("weight", weight);
            tick(clk);
          end loop;
          finish(finished);
        end process;
    end generate;
  end generate;

  report_end(finished, "light_weight_tb");
end architecture;
