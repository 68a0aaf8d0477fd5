-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of five pipelines against the golden twin: everything that there can be, the paper's
-- version I, a positional light alone, and single effects. The same list as tb/vectors/processors.cpp.
library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;

entity unrolled_shading_processor_run is
  generic (
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

architecture sim of unrolled_shading_processor_run is
  constant c_lights : natural := g_directional + g_positional + g_spots;

  signal ambient_finished : boolean;
  signal diffuse_finished, specular_finished : boolean_vector(1 to c_lights) := (others => false);
begin
  ambient : entity work.processor_checker
    generic map (true, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
      g_shadows, c_ambient, 0, g_folder)
    port map (ambient_finished);

  lights : for light in 1 to c_lights generate
    diffuse : if g_diffuse generate
      checker : entity work.processor_checker
        generic map (true, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
          g_shadows, c_diffuse, light, g_folder)
        port map (diffuse_finished(light));
    else generate
      diffuse_finished(light) <= true;
    end generate;

    specular : if g_specular generate
      checker : entity work.processor_checker
        generic map (true, g_exact, g_channels, g_directional, g_positional, g_spots, g_diffuse, g_specular, g_normalize,
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

entity unrolled_shading_processor_tb is
  generic (
    g_folder : string := "unrolled_shading_processor"
  );
end entity;

architecture sim of unrolled_shading_processor_tb is
  signal finished : boolean_vector(0 to 9);
begin
  presets : for preset in 0 to 1 generate
    all_effects : entity work.unrolled_shading_processor_run
      generic map (preset = 0, 3, 1, 1, 1, true, true, true, true, g_folder)
      port map (finished(5 * preset));

    version_1 : entity work.unrolled_shading_processor_run
      generic map (preset = 0, 3, 1, 0, 0, true, true, false, false, g_folder)
      port map (finished(5 * preset + 1));

    version_2 : entity work.unrolled_shading_processor_run
      generic map (preset = 0, 3, 0, 1, 0, true, true, true, false, g_folder)
      port map (finished(5 * preset + 2));

    diffuse_alone : entity work.unrolled_shading_processor_run
      generic map (preset = 0, 1, 1, 0, 0, true, false, false, false, g_folder)
      port map (finished(5 * preset + 3));

    specular_alone : entity work.unrolled_shading_processor_run
      generic map (preset = 0, 1, 0, 1, 1, false, true, false, false, g_folder)
      port map (finished(5 * preset + 4));
  end generate;

  done : process is
  begin
    wait until and finished;
    report "unrolled_shading_processor_tb: passed" severity note;
    wait;
  end process;
end architecture;
