-- SPDX-License-Identifier: Apache-2.0
-- Each axis and shift, zero, opposite and random vectors: one per clock, then with pauses.
library ieee;
use ieee.std_logic_1164.all;
use work.formats_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity unit_vector_tb is
  generic (g_folder : string := "unit_vector");
end entity;

architecture sim of unit_vector_tb is
  type form_t is record
    exact       : boolean;
    vector_bits : positive;
  end record;

  type forms_t is array (natural range <>) of form_t;

  -- Preset exact: N and the view ray, then L and H. Preset published: N and L.
  constant c_forms : forms_t := ((true, 30), (true, 31), (true, 25), (false, 16), (false, 17));
begin
  forms : for i in c_forms'range generate
    constant c_form : form_t := c_forms(i);

    signal clk        : std_logic := '0';
    signal enable     : std_logic;
    signal components : std_logic_vector(3 * c_form.vector_bits - 1 downto 0);
    signal unit       : std_logic_vector(3 * formats(c_form.exact).direction.bits - 1 downto 0);
    begin
      dut : entity work.unit_vector
        generic map (g_exact => c_form.exact, g_vector_bits => c_form.vector_bits)
        port map (clk => clk, enable => enable, components => components, unit => unit);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & preset_name(c_form.exact) & "_" & to_string(c_form.vector_bits) & ".txt",
          unit_vector_latency(c_form.exact));
        while vectors.next_clock loop
          vectors.drive(enable);
          vectors.drive(components);
          settle;
          vectors.check("unit", unit);
          tick(clk);
        end loop;
        finish(finished);
      end process;
  end generate;

  report_end(finished, "unit_vector_tb");
end architecture;
