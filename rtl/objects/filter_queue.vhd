-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Leads what only the filter needs past the shading pipeline: the heads of pixels, the weights of objects, the ends of
--             strips and the background. Each token of the front goes to the pipeline, to a queue, or to both; at the end
--             of the pipeline the queue says what comes next:
--
--               front --+--> objects, loads; heads with shadows --> pipeline --> shaded --+--> filter
--                       +--> heads, weights, ends, new_frame --> stream_queue ------------+
--
-- Contract    All streams are valid/ready; a token to the filter does not change while it waits. front_ready does not depend on
--             the other ports in the same clock if pipeline_ready does not. The pipeline keeps the order of objects, and
--             outputs nothing but them. front_mask and front_ends: as token_mask and token_ends of object_output.
--             filter_token: an object as the pipeline outputs it; a head with y and x; new_frame. filter_weight: the
--             number of an object's subpixels, else 0. background: of the last new_frame, for each channel its
--             light_intensity as a colour; black after a reset. It changes while filter_busy = '0'. busy: an entry is in the queue.
-- Formats     front_token, pipeline_token, shaded_token, filter_token: token_pkg; background: three colours, red lowest
-- Latency     3 clocks for a head
-- Throughput  1 token per clock, if the pipeline holds at most 2**g_index_bits - 5 heads and objects
-- Source      ours
-- Golden twin model/golden/objects_shader.hpp: its order is that of the front

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.line_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;
use work.filter_pkg.all;

entity filter_queue is
  generic (
    g_config     : config_t := c_default_config;
    g_subpixels  : positive := 4; -- 4 or 16
    g_index_bits : positive := 8
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    front_valid    : in  std_logic;
    front_ready    : out std_logic;
    front_token    : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    front_mask     : in  std_logic_vector(g_subpixels - 1 downto 0);
    front_ends     : in  std_logic;
    pipeline_valid : out std_logic;
    pipeline_ready : in  std_logic;
    pipeline_token : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    shaded_valid   : in  std_logic;
    shaded_ready   : out std_logic;
    shaded_token   : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    filter_valid   : out std_logic;
    filter_ready   : in  std_logic;
    filter_token   : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    filter_weight  : out std_logic_vector(weight_bits(g_subpixels) - 1 downto 0);
    filter_busy    : in  std_logic;
    background     : out std_logic_vector(3 * formats(g_config.exact).colour.bits - 1 downto 0);
    busy           : out std_logic
  );
end entity;

architecture rtl of filter_queue is

  constant c_exact     : boolean        := g_config.exact;
  constant c_pixel     : pixel_header_t := pixel_header(c_exact);
  constant c_intensity : format_t       := formats(c_exact).light_intensity;
  constant c_colour    : positive       := formats(c_exact).colour.bits;
  constant c_colours   : positive       := 3 * c_colour;

  -- An entry: of a head y and x, of an object its mask, then its weight, of new_frame the background; the command; the end
  -- of a strip.
  constant c_data : positive := formats(c_exact).pixel_y.bits + formats(c_exact).pixel_x.bits;
  constant c_ends : positive := c_data + formats(c_exact).command.bits;

  subtype entry_t is std_logic_vector(c_ends downto 0);
  subtype weight_t is unsigned(filter_weight'range);
  subtype colours_t is std_logic_vector(c_colours - 1 downto 0);

  type reg_t is record
    entered    : std_logic;
    object     : std_logic; -- the entry is one of an object
    entry      : entry_t;
    background : colours_t;
  end record;

  signal r, r_next : reg_t;

  signal command                 : command_t; -- of the front's token
  signal object, head, frame     : std_logic; -- what it is
  signal to_pipeline, to_filter  : std_logic;
  signal enters, claims, room    : std_logic;
  signal entry, weighed          : entry_t; -- of a front's token, and one clock later
  signal next_entry              : entry_t;
  signal next_valid, taken       : std_logic;
  signal next_command            : command_t;
  signal next_object, next_frame : std_logic; -- the entry is an object; a new_frame that is no end of a strip
  signal colours                 : colours_t; -- of the front's new_frame

  -- Add pairs, then pairs of sums: one bit after the other would be a chain of adders.
  function weight_of (mask : std_logic_vector(g_subpixels - 1 downto 0)) return weight_t is
    type sums_t is array (mask'range) of weight_t;

    variable sums : sums_t;
  begin
    for i in mask'range loop
      sums(i)    := (others => '0');
      sums(i)(0) := mask(i);
    end loop;
    for level in 1 to log2(g_subpixels) loop
      for i in 0 to g_subpixels / 2 ** level - 1 loop -- evaluated at elaboration
        sums(i) := sums(2 * i) + sums(2 * i + 1);
      end loop;
    end loop;
    return sums(0);
  end function;

begin

  assert c_colours <= c_data and g_subpixels <= c_data
    report "filter_queue: an entry has " & integer'image(c_data) & " bits, a background " & integer'image(c_colours)
    & ", a mask " & integer'image(g_subpixels)
    severity failure;

  command <= command_of(c_exact, front_token);
  object  <= is_object(command);
  head    <= is_head(command);
  frame   <= flag(command = c_new_frame);

  to_filter   <= object or head or frame;
  to_pipeline <= not front_ends and (not head or flag(g_config.shadows));

  front_ready    <= room and pipeline_ready;
  enters         <= front_valid and room and pipeline_ready;
  pipeline_valid <= front_valid and room and to_pipeline;
  pipeline_token <= front_token;

  take_background : process (all)
    constant c_low : natural := light_colour_low(g_config);
  begin
    colours <= (others => '0');
    for channel in 0 to g_config.channels - 1 loop
      colours((channel + 1) * c_colour - 1 downto channel * c_colour) <=
        front_token(c_low + channel * c_intensity.bits + c_intensity.fraction + c_colour - 1
        downto c_low + channel * c_intensity.bits + c_intensity.fraction);
    end loop;
  end process;

  make_entry : process (all)
    variable v : entry_t;
  begin
    v := (others => '0');
    v(c_ends)                   := front_ends;
    v(c_ends - 1 downto c_data) := field_of(front_token, c_pixel.command);
    if object = '1' then
      v(front_mask'range) := front_mask;
    elsif frame = '1' then
      v(colours_t'range) := colours;
    else
      v(c_data - 1 downto 0) := field_of(front_token, c_pixel.x) & field_of(front_token, c_pixel.y);
    end if;
    entry <= v;
  end process;

  -- Claim a place, and count the subpixels in a clock of their own.
  claims <= enters and to_filter;

  weigh : process (all)
    variable v : entry_t;
  begin
    v := r.entry;
    if r.object = '1' then
      v(c_data - 1 downto 0) := std_logic_vector(resize(weight_of(r.entry(front_mask'range)), c_data));
    end if;
    weighed <= v;
  end process;

  entries : entity work.stream_queue
    generic map (
      g_bits       => entry_t'length,
      g_index_bits => g_index_bits
      )
    port map (
      clk       => clk,
      reset     => reset,
      claim     => claims,
      room      => room,
      pending   => busy,
      in_valid  => r.entered,
      in_data   => weighed,
      out_valid => next_valid,
      out_ready => taken,
      out_data  => next_entry
      );

  next_command <= to_integer(unsigned(next_entry(c_ends - 1 downto c_data)));
  next_object  <= is_object(next_command);
  next_frame   <= flag(next_command = c_new_frame) and not next_entry(c_ends);

  -- Join. new_frame, and with it the next background, waits until the filter is empty.
  filter_valid  <= next_valid and (shaded_valid or not next_object) and not (next_frame and filter_busy);
  shaded_ready  <= next_valid and next_object and filter_ready;
  taken         <= (shaded_valid or not next_object) and filter_ready and not (next_frame and filter_busy);
  filter_weight <= next_entry(filter_weight'range) when next_object = '1' else (others => '0');

  make_token : process (all)
    variable v : std_logic_vector(filter_token'range);
  begin
    v := (others => '0');
    v(c_pixel.command.high downto c_pixel.command.low) := next_entry(c_ends - 1 downto c_data);
    if next_command /= c_new_frame then
      v(c_pixel.x.high downto c_pixel.y.low) := next_entry(c_data - 1 downto 0);
    end if;
    if next_object = '1' then
      v := shaded_token;
    end if;
    filter_token <= v;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.entered := claims;
    v.object  := object;
    v.entry   := entry;
    if next_valid = '1' and next_frame = '1' and taken = '1' then
      v.background := next_entry(colours_t'range);
    end if;
    if reset = '1' then
      v.entered    := '0';
      v.background := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  background <= r.background;

end architecture;
