-- SPDX-License-Identifier: Apache-2.0
-- Objects with and without normalization of N, one per clock, then with pauses. A light is constant for 60 objects.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.token_pkg.all;
use work.tb_pkg.all;

entity ambient_term_tb is
  generic (g_folder : string := "ambient_term");
end entity;

architecture sim of ambient_term_tb is
begin
  presets : for exact in boolean generate
    constant c_config  : config_t := config(exact, 3, 1, 1, 1, true, true, true, true);
    constant c_latency : positive := times(c_config, c_ambient, 0).term;

    signal clk            : std_logic := '0';
    signal enable         : std_logic;
    signal light          : std_logic_vector(light_bits(c_config) - 1 downto 0);
    signal token, delayed : std_logic_vector(token_bits(c_config) - 1 downto 0);
    signal terms          : std_logic_vector(3 * product_bits(exact) - 1 downto 0);
    signal normal, view   : std_logic_vector(c_axes * formats(exact).direction.bits - 1 downto 0);
    begin
      dut : entity work.ambient_term
        generic map (g_config => c_config)
        port map (
          clk     => clk,
          enable  => enable,
          light   => light,
          token   => token,
          delayed => delayed,
          terms   => terms,
          normal  => normal,
          view    => view);

      late : entity work.delay_line
        generic map (token'length, c_latency)
        port map (clk, enable, token, delayed);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt", c_latency);
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(light);
          vectors.drive(token);
          settle;
          vectors.check("view, normal, terms", view & normal & terms);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "ambient_term_tb");
end architecture;
