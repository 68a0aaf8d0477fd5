-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     One place of a valid/ready stream: the buffer before the walker, which holds the next init vector while a
--             triangle is drawn, and the output register of a shader.
-- Contract    A word moves where valid and ready are both '1' at a rising edge. A word that waits does not change, at the
--             input (a simulation stops otherwise) and at the output. in_ready depends on out_ready in the same clock.
-- Formats     g_bits of any format
-- Latency     1 clock
-- Throughput  1 word per clock
-- Error       none: each word is output once, unchanged, in order
-- Source      quadratic paper, section 6 (the next triangle is initialized while this one is drawn); valid/ready is
--             ours
-- Golden twin model/golden/stream_register.hpp

library ieee;
use ieee.std_logic_1164.all;
use work.stream_pkg.all;

entity stream_register is
  generic (
    g_bits  : positive;
    g_eager : boolean := false -- load whenever the place is free, valid or not: the enable does not depend on in_valid
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
    v.valid := in_valid or not free; -- a place that is not free holds a word
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

  -- Report a broken contract in the user's simulation.
  check_input : process (clk)
    variable waiting : std_logic_vector(g_bits downto 0);
  begin
    if rising_edge(clk) then
      check_stream("stream_register: in", reset, free, in_valid & in_data, waiting);
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
