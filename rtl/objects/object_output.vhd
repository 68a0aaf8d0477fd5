-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The end of the chain of object processors: converts the sorted lists to tokens of the shading processors. An
--             element becomes a token with its pixel; an object has command new_object, a shadow polygon shadow. With
--             shadows, a token new_scanline or new_pixel with the pixel comes before a list: new_scanline in the
--             first list of a line. Heads without elements are dropped. Loads pass. A shadow polygon comes before the
--             objects that it is nearer than. For the filter (has_filter of objects_pkg), each head is a token, and the
--             end of a strip is one.
-- Contract    Both streams are valid/ready; the token's ports do not change while it waits. in_ready does not depend
--             on token_ready in the same clock. token_mask: the subpixels of an object that are not hidden, empty for
--             other tokens. token_ends: the strip has ended; the command is new_frame, but it is no load. fault stays
--             '1' after a part of an object: no processor was free.
--             busy: a word is in the queue.
-- Formats     in_word: objects_pkg; token: token_pkg
-- Latency     2 clocks
-- Throughput  1 word per clock; with shadows, without the filter, one clock more per pixel with elements
-- Source      processors paper, section 3.2: the commands of the pixel mode
-- Golden twin model/golden/object_output.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.objects_pkg.all;

entity object_output is
  generic (
    g_config    : config_t := c_default_config;
    g_subpixels : positive := 1 -- 1, 4 or 16
  );
  port (
    clk         : in  std_logic;
    reset       : in  std_logic;
    in_valid    : in  std_logic;
    in_ready    : out std_logic;
    in_word     : in  std_logic_vector(word_bits(g_config, g_subpixels) - 1 downto 0);
    token_valid : out std_logic;
    token_ready : in  std_logic;
    token       : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    token_mask  : out std_logic_vector(g_subpixels - 1 downto 0);
    token_ends  : out std_logic;
    busy        : out std_logic;
    fault       : out std_logic
  );
end entity;

architecture rtl of object_output is

  constant c_exact  : boolean        := g_config.exact;
  constant c_pixel  : pixel_header_t := pixel_header(c_exact);
  constant c_filter : boolean        := has_filter(g_subpixels);

  subtype place_t is std_logic_vector(c_pixel.x.high downto c_pixel.y.low); -- y and x

  type reg_t is record
    pixel : std_logic; -- no token of this pixel was output
    line  : std_logic; -- no token of this line was output
    place : place_t;
    fault : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal enters, room          : std_logic;
  signal next_valid            : std_logic;
  signal word                  : std_logic_vector(in_word'range);
  signal command               : command_t;
  signal item, element, head   : std_logic; -- kind of the word
  signal ends                  : std_logic; -- the word is the end of a strip
  signal sends_head            : std_logic; -- the list's head is output before its first element
  signal outputs, taken        : std_logic;

begin

  assert c_pixel.x.low = c_pixel.y.high + 1
    report "object_output: x starts at bit " & integer'image(c_pixel.x.low) & " of a token, y ends at bit "
    & integer'image(c_pixel.y.high)
    severity failure;

  enters   <= in_valid and room;
  in_ready <= room;

  words : entity work.stream_queue
    generic map (
      g_bits       => in_word'length,
      g_index_bits => 2
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => enters,
      room      => room,
      pending   => busy,
      in_valid  => enters,
      in_data   => in_word,
      out_valid => next_valid,
      out_ready => taken,
      out_data  => word
      );

  command <= command_of(c_exact, word);
  item    <= flag(kind_of(word) = kind_word(c_item));
  element <= is_element(c_exact, word);
  head    <= item and is_head(command);
  ends    <= flag(kind_of(word) = kind_word(c_strip_end));

  sends_head  <= element and r.pixel when g_config.shadows and not c_filter else '0';
  outputs     <= item or ends when c_filter else item and not head;
  token_ends  <= ends;
  token_valid <= next_valid and outputs;
  taken       <= next_valid and not sends_head and (token_ready or not outputs);

  make_token : process (all)
    variable v     : std_logic_vector(token'range);
    variable first : natural;
  begin
    v := (others => '0');
    v(item_bits(g_config) - 1 downto 0) := word(item_bits(g_config) - 1 downto 0);
    token_mask <= mask_of(word, g_subpixels);
    if sends_head = '1' or ends = '1' then
      first := c_new_pixel;
      if ends = '1' then
        first := c_new_frame;
      elsif r.line = '1' then
        first := c_new_scanline;
      end if;
      v := (others => '0');
      v(c_pixel.command.high downto c_pixel.command.low) :=
        std_logic_vector(to_unsigned(first, formats(c_exact).command.bits));
      token_mask <= (others => '0');
    end if;
    if element = '1' then
      v(place_t'range) := r.place;
    end if;
    token <= v;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if next_valid = '1' and head = '1' then
      v.pixel := '1';
      v.line  := r.line or flag(command = c_new_scanline);
      v.place := word(place_t'range);
    elsif next_valid = '1' and sends_head = '1' and token_ready = '1' then
      v.pixel := '0';
      v.line  := '0';
    end if;
    v.fault := r.fault or (next_valid and flag(kind_of(word) = kind_word(c_part)));
    if reset = '1' then
      v.pixel := '0';
      v.line  := '0';
      v.fault := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  fault <= r.fault;

end architecture;
