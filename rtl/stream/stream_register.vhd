-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One place of a valid/ready stream: the buffer in front of the walker, so that the next init vector
--             waits while this triangle is drawn, and the register behind the shader.
-- Contract    A word moves where valid and ready are both '1' at a rising edge. out_data does not change while
--             out_valid = '1' and out_ready = '0'. in_ready follows out_ready in the same clock.
-- Formats     g_bits of anything
-- Latency     1 clock
-- Throughput  1 word a clock
-- Error       none: words come out as they went in, each once, in their order
-- Source      quadratic paper, section 5 (the next triangle is initialized while this one is drawn); valid/ready is
--             ours
-- Golden twin model/golden/stream_register.hpp

library ieee;
use ieee.std_logic_1164.all;

entity stream_register is
  generic (
    g_bits  : positive;
    g_eager : boolean := false -- while it is free it takes what is offered, valid or not: the enable does not wait for that
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_data   : in  std_logic_vector(g_bits - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_data  : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of stream_register is

  type reg_t is record
    valid : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal free, take : std_logic;

begin

  free     <= out_ready or not r.valid;
  take     <= free when g_eager else in_valid and free;
  in_ready <= free;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.valid := in_valid or not free; -- what is not free holds a word
    if reset = '1' then
      v.valid := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  payload : entity work.parameter_register
    generic map (
      g_bits => g_bits
      )
    port map (
      clk   => clk,
      load  => take,
      start => in_data,
      value => out_data
      );

  out_valid <= r.valid;

end architecture;
