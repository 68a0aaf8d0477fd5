-- SPDX-License-Identifier: Apache-2.0
-- Cosines of random and extreme dot products. The testbenches of the entities that round and clamp test these functions.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.shading_pkg.all;
use work.tb_pkg.all;

entity shading_pkg_tb is
  generic (g_folder : string := "shading_pkg");
end entity;

architecture sim of shading_pkg_tb is
begin
  presets : for exact in boolean generate
    run : process is
      variable vectors : vectors_t;
      variable dot     : std_logic_vector(2 * formats(exact).direction.bits downto 0);
    begin
      vectors.open_file(g_folder & "/" & preset_name(exact) & ".txt");
      while vectors.next_vector loop
        vectors.read_word(dot);
        vectors.check("cosine", cosine(exact, signed(dot)));
        vectors.check("positive", is_positive(signed(dot)));
      end loop;
      finish(finished);
    end process;
  end generate;

  report_end(finished, "shading_pkg_tb");
end architecture;
