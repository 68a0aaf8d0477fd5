-- SPDX-License-Identifier: Apache-2.0
-- Every clock is compared with the golden model: at full speed, with stalls at the input, at the output and at both,
-- and with resets. A second check does not use the golden model: every word comes out once, in order, and is stable
-- while it waits.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity stream_queue_tb is
  generic (g_folder : string := "stream_queue");
end entity;

architecture sim of stream_queue_tb is
  type sizes_t is array (natural range <>) of integer_vector(0 to 1);

  -- bits, bits of the index; the last two: fragments of processors_shader
  constant c_sizes : sizes_t := ((1, 2), (32, 3), (97, 3), (98, 4));
begin
  sizes : for i in c_sizes'range generate
    subtype word_t is std_logic_vector(c_sizes(i)(0) - 1 downto 0);

    signal clk                         : std_logic := '0';
    signal reset, claim, room, pending : std_logic;
    signal in_valid                    : std_logic;
    signal in_data                     : word_t;
    signal out_valid, out_ready        : std_logic;
    signal out_data                    : word_t;
    begin
      dut : entity work.stream_queue
        generic map (g_bits => c_sizes(i)(0), g_index_bits => c_sizes(i)(1))
        port map (
          clk       => clk,
          reset     => reset,
          claim     => claim,
          room      => room,
          pending   => pending,
          in_valid  => in_valid,
          in_data   => in_data,
          out_valid => out_valid,
          out_ready => out_ready,
          out_data  => out_data);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_sizes(i)(0)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(reset);
          vectors.drive(claim);
          vectors.drive(in_valid);
          vectors.drive(in_data);
          vectors.drive(out_ready);
          settle;
          vectors.check("room", room);
          vectors.check("pending", pending);
          vectors.check("out_valid", out_valid);
          vectors.check_if(out_valid, "out_data", out_data);
          tick(clk);
        end loop;
        finish(finished);
      end process;

      contract : process (clk) is
        type words_t is array (0 to 2 ** c_sizes(i)(1) - 1) of word_t;

        variable words   : words_t;
        variable count   : natural := 0;
        variable waiting : boolean := false;
        variable held    : word_t;
      begin
        if rising_edge(clk) then
          assert not waiting or (out_valid = '1' and out_data = held)
            report "stream_queue: a word that waits changes" severity failure;
          if reset = '1' then
            count   := 0;
            waiting := false;
          else
            if out_valid = '1' then
              assert count > 0 and out_data = words(0)
                report "stream_queue: out_data is " & to_hstring(out_data) & ", not the oldest word" severity failure;
            end if;
            waiting := out_valid = '1' and out_ready = '0';
            held    := out_data;
            if out_valid = '1' and out_ready = '1' then
              words(0 to words'high - 1) := words(1 to words'high);
              count := count - 1;
            end if;
            if in_valid = '1' then
              words(count) := in_data;
              count := count + 1;
            end if;
          end if;
        end if;
      end process;
  end generate;

  report_end(finished, "stream_queue_tb");
end architecture;
