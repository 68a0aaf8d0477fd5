-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Inserts an object processor's own element into the list of a pixel, in order, and removes what is hidden.
--             Elements before the own one pass. Each object loses the subpixels of the objects before it; an object
--             without subpixels is dropped, and so is a shadow polygon behind a pixel that is covered. The own element
--             is output before the first word that follows it in the order: an element behind it, or the next head.
-- Contract    All streams are valid/ready; out_word does not change while it waits. Elements come in order of key_of
--             (objects_pkg), after their head. own and own_word belong to the last head that was taken, from the clock
--             after it, and do not change until the next one is taken.
-- Formats     objects_pkg
-- Latency     0
-- Throughput  1 word per clock: one passed, dropped, or inserted
-- Source      processors paper, section 2: a distributed z-buffer; list and masks are ours
-- Golden twin model/golden/object_merge.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.objects_pkg.all;

entity object_merge is
  generic (
    g_config    : config_t := c_default_config;
    g_subpixels : positive := 1
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_word   : in  std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    own       : in  std_logic; -- the pixel has an own element
    own_word  : in  std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_word  : out std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0)
  );
end entity;

architecture rtl of object_merge is

  constant c_exact : boolean := g_config.exact;

  subtype mask_t is std_logic_vector(g_subpixels - 1 downto 0);

  constant c_empty : mask_t := (others => '0');
  constant c_full  : mask_t := (others => '1');

  type reg_t is record
    pending : std_logic; -- the own element of this pixel is not output
    covered : mask_t; -- subpixels of the objects that were output
  end record;

  signal r, r_next : reg_t;

  signal element, head     : std_logic; -- kind of in_word
  signal own_now           : std_logic; -- the own element is output now
  signal in_mask, own_mask : mask_t; -- without the covered subpixels
  signal dropped, taken    : std_logic;
  signal offered           : std_logic;

  -- The subpixels that are left of a word's mask.
  function left_of (word : std_logic_vector; covered : mask_t) return mask_t is
  begin
    return mask_of(word, g_subpixels) and not covered;
  end function;

  function is_shadow (word : std_logic_vector) return boolean is
  begin
    return command_of(c_exact, word) = c_shadow;
  end function;

  function is_hidden (word : std_logic_vector; covered : mask_t) return std_logic is
  begin
    if (is_shadow(word) and covered = c_full) or (not is_shadow(word) and left_of(word, covered) = c_empty) then
      return '1';
    end if;
    return '0';
  end function;

begin

  element <= is_element(c_exact, in_word);
  head    <= flag(kind_of(in_word) = kind_word(c_item)) and is_head(command_of(c_exact, in_word));

  in_mask  <= left_of(in_word, r.covered);
  own_mask <= left_of(own_word, r.covered);

  own_now <= '1' when r.pending = '1' and own = '1' and is_hidden(own_word, r.covered) = '0'
    and (element = '0' or key_of(c_exact, own_word) < key_of(c_exact, in_word)) else '0';
  dropped <= element and is_hidden(in_word, r.covered);

  offered   <= in_valid and (own_now or not dropped);
  out_valid <= offered;
  taken     <= in_valid and not own_now and (dropped or out_ready);
  in_ready  <= not own_now and (dropped or out_ready);

  choose : process (all)
  begin
    out_word <= in_word;
    if own_now = '1' then
      out_word <= with_mask(own_word, own_mask);
    elsif element = '1' then
      out_word <= with_mask(in_word, in_mask);
    end if;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if offered = '1' and out_ready = '1' then
      -- The mask of a shadow polygon is empty.
      if own_now = '1' then
        v.pending := '0';
        v.covered := r.covered or own_mask;
      elsif element = '1' then
        v.covered := r.covered or in_mask;
      end if;
    end if;
    if taken = '1' and element = '0' then
      v.pending := head;
      v.covered := c_empty;
    end if;
    if reset = '1' then
      v.pending := '0';
      v.covered := c_empty;
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
