-- SPDX-License-Identifier: Apache-2.0
-- Both presets, every processor of five pipelines against the golden twin (processors_checker).
entity unrolled_shading_processor_tb is
  generic (
    g_folder : string := "unrolled_shading_processor"
  );
end entity;

architecture sim of unrolled_shading_processor_tb is
  signal finished : boolean;
begin
  checker : entity work.processors_checker
    generic map (true, g_folder)
    port map (finished);

  done : process is
  begin
    wait until finished;
    report "unrolled_shading_processor_tb: passed" severity note;
    wait;
  end process;
end architecture;
