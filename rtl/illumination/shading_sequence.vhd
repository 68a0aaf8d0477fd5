-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The folded processor's program counter. It counts the clocks of the token: `cycle` is the current step of
--             schedule_pkg. A token starts at its first step and does one step per clock; steps that it does not need
--             are skipped. It waits at the last step until it leaves.
-- Contract    take, with object, normalize and defined, is '1' in the clock in which a token is taken, while cycle is 0;
--             `lit` is read one clock later. normalize_token belongs to the token in the processor. above: the dot
--             product of this clock is positive. cycle is 0 without a token, and schedule's `leave` while it waits.
-- Formats     cycle: schedule_pkg
-- Latency     1 clock from take to the first step
-- Throughput  1 token per `leave` of schedule, plus 1 clock, or faster
-- Source      processors paper, table 4
-- Golden twin none; model/plan/processor_clocks.hpp has the clocks

library ieee;
use ieee.std_logic_1164.all;
use work.processors_pkg.all;
use work.schedule_pkg.all;
use work.terms_pkg.all;

entity shading_sequence is
  generic (
    g_config : config_t;
    g_kind   : natural range c_ambient to c_specular;
    g_light  : natural
  );
  port (
    clk             : in  std_logic;
    reset           : in  std_logic;
    take            : in  std_logic;
    object          : in  std_logic;
    normalize       : in  std_logic;
    defined         : in  std_logic;
    positional      : in  std_logic;
    spot            : in  std_logic;
    lit             : in  std_logic;
    normalize_token : in  std_logic;
    above           : in  std_logic;
    leave           : in  std_logic; -- the next processor takes the token that waits
    taken           : out std_logic; -- an object, in the clock before
    cycle           : out natural range 0 to schedule(g_config, g_kind, g_light).leave
  );
end entity;

architecture rtl of shading_sequence is

  constant c_exact : boolean    := g_config.exact;
  constant c_shape : shape_t    := shape(g_config, g_kind, g_light);
  constant c_at    : schedule_t := schedule(g_config, g_kind, g_light);

  subtype cycle_t is natural range 0 to c_at.leave;

  type reg_t is record
    cycle : cycle_t;
    taken : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal start : cycle_t; -- first step of the object that is taken

begin

  taken <= r.taken;
  cycle <= r.cycle;

  choose_start : process (all)
  begin
    start <= 1;
    if g_kind = c_ambient then
      if c_shape.first and normalize = '0' then
        start <= c_at.reflect;
        if c_shape.second then
          start <= c_at.shift_2;
        end if;
      end if;
    elsif positional = '0' then
      start <= c_at.cosine;
      if c_exact and c_shape.second then
        start <= c_at.sum_2;
      end if;
    elsif c_shape.first and c_shape.second and not c_exact and spot = '0' then
      start <= c_at.sum_2;
    end if;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v       := r;
    v.taken := '0';
    if r.cycle = 0 then
      -- Take a token; one without work waits to leave
      if take = '1' then
        v.taken := object;
        v.cycle := c_at.leave;
        if object = '1' and (g_kind = c_ambient or defined = '1') then
          v.cycle := start;
        end if;
      end if;
    elsif r.cycle = c_at.leave then
      -- Hand the token on
      if leave = '1' then
        v.cycle := 0;
      end if;
    else
      v.cycle := r.cycle + 1;
      -- Skip the cone of a light that is no spot
      if c_shape.spots and r.cycle = c_at.weigh_in - 1 and spot = '0' then
        v.cycle := c_at.weigh;
      end if;
      -- Skip the unit vector of an N that is not to be normalized
      if g_kind = c_ambient and not c_shape.second and r.cycle = c_at.add and normalize_token = '0' then
        v.cycle := c_at.leave;
      end if;
      -- Skip the highlight below the horizon
      if g_kind = c_specular and c_exact and r.cycle = c_at.horizon and above = '0' then
        v.cycle := c_at.leave;
      end if;
      -- Skip all of an object in the shadow
      if r.taken = '1' and lit = '0' then
        v.cycle := c_at.leave;
      end if;
    end if;
    if reset = '1' then
      v.cycle := 0;
      v.taken := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

end architecture;
