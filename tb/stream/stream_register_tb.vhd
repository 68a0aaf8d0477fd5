-- SPDX-License-Identifier: Apache-2.0
-- Every clock is compared with the golden model: at full speed, with stalls at the input, at the output and at both,
-- and with resets. A second check does not use the golden model: every word comes out once, in order, one clock later,
-- and is stable while it waits.
library ieee;
use ieee.std_logic_1164.all;
use work.tb_pkg.all;

entity stream_register_tb is
  generic (g_folder : string := "stream_register");
end entity;

architecture sim of stream_register_tb is
  -- one bit, a triangle's number, an init vector; the last one is eager
  constant c_bits : integer_vector := (1, 32, 497, 32);
begin
  widths : for i in c_bits'range generate
    subtype word_t is std_logic_vector(c_bits(i) - 1 downto 0);

    signal clk                       : std_logic := '0';
    signal reset, in_valid, in_ready : std_logic;
    signal in_data                   : word_t;
    signal out_valid, out_ready      : std_logic;
    signal out_data                  : word_t;
    begin
      dut : entity work.stream_register
        generic map (g_bits => c_bits(i), g_eager => i = c_bits'right)
        port map (
          clk       => clk,
          reset     => reset,
          in_valid  => in_valid,
          in_ready  => in_ready,
          in_data   => in_data,
          out_valid => out_valid,
          out_ready => out_ready,
          out_data  => out_data);

      run : process is
        variable vectors : vectors_t;
      begin
        vectors.open_file(g_folder & "/" & to_string(c_bits(i)) & ".txt");
        while vectors.next_clock loop
          vectors.drive(reset);
          vectors.drive(in_valid);
          vectors.drive(in_data);
          vectors.drive(out_ready);
          settle;
          vectors.check("in_ready", in_ready);
          vectors.check("out_valid", out_valid);
          vectors.check_if(out_valid, "out_data", out_data);
          tick(clk);
        end loop;
        finish(finished);
      end process;

      contract : process (clk) is
        variable full : boolean := false;
        variable held : word_t;
      begin
        if rising_edge(clk) then
          if reset = '1' then
            full := false;
          else
            assert (out_valid = '1') = full
              report "stream_register: out_valid is " & to_string(out_valid) & ", words held: " & boolean'image(full)
              severity failure;
            assert not full or out_data = held
              report "stream_register: out_data is " & to_hstring(out_data) & ", expected " & to_hstring(held)
              severity failure;
            if in_valid = '1' and in_ready = '1' then
              assert not full or out_ready = '1'
                report "stream_register: loads a word before the last one is taken" severity failure;
              full := true;
              held := in_data;
            elsif out_ready = '1' then
              full := false;
            end if;
          end if;
        end if;
      end process;
  end generate;

  report_end(finished, "stream_register_tb");
end architecture;
