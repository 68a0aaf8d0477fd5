-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of six pipelines against the golden model (processors_checker).
entity shading_processor_tb is
  generic (
    g_folder : string := "shading_processor"
  );
end entity;

architecture sim of shading_processor_tb is
  signal finished : boolean;
begin
  checker : entity work.processors_checker
    generic map (false, g_folder)
    port map (finished);

  done : process is
  begin
    wait until finished;
    report "shading_processor_tb: passed" severity note;
    wait;
  end process;
end architecture;
