-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of seven pipelines against the golden model, by processor_checker, which also measures
-- the latencies of terms_pkg. These must be those that the entity's header promises.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.terms_pkg.all;
use work.tb_pkg.all;

entity unrolled_shading_processor_tb is
  generic (g_folder : string := "unrolled_shading_processor");
end entity;

architecture sim of unrolled_shading_processor_tb is
  type clocks_t is array (boolean) of positive; -- published, exact

  type promise_t is record
    directional, positional, spots : natural;
    specular, normalize            : boolean;
    kind                           : natural;
    clocks                         : clocks_t;
  end record;

  type promises_t is array (natural range <>) of promise_t;

  -- With specular, the ambient processor of preset exact computes the view vector.
  constant c_promises : promises_t := (
    (0, 0, 0, false, false, c_ambient, (5, 6)),
    (0, 0, 0, false, true, c_ambient, (10, 18)),
    (1, 0, 0, true, false, c_diffuse, (7, 9)),
    (1, 0, 0, true, false, c_specular, (13, 35)),
    (0, 1, 0, true, false, c_diffuse, (15, 27)),
    (0, 1, 0, true, false, c_specular, (21, 53)),
    (0, 0, 1, true, false, c_diffuse, (23, 35)),
    (0, 0, 1, true, false, c_specular, (23, 54)));
begin
  checker : entity work.processor_checker
    generic map (g_unrolled => true, g_folder => g_folder);

  promises : process is
  begin
    for exact in boolean loop
      for i in c_promises'range loop
        check("unrolled_shading_processor, preset " & preset_name(exact) & ", promise", i, "its number of clocks",
          times(config(exact, 3, c_promises(i).directional, c_promises(i).positional, c_promises(i).spots, true,
          c_promises(i).specular, c_promises(i).normalize, false), c_promises(i).kind,
          boolean'pos(c_promises(i).kind /= c_ambient)).leave, c_promises(i).clocks(exact));
      end loop;
    end loop;
    finish(finished);
  end process;

  report_end(finished, "unrolled_shading_processor_tb");
end architecture;
