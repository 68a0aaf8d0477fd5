-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Merges loads and objects into one stream for the processors. A load is the host's vector, unchanged. An
--             object gets a command by its position:
--               new_scanline  on another line than the previous object, or the first object of a frame
--               new_object    at the same pixel
--               new_pixel     at another pixel of the line
--             A shadow polygon keeps its command.
-- Contract    All streams are valid/ready. Objects and loads are not offered at the same time. frame_start is '1' in
--             the clock in which a new_frame load is accepted.
-- Formats     load: processors_pkg, a vector of the host; object, token: token_pkg
-- Latency     0
-- Throughput  1 token per clock
-- Source      processors paper, section 3.2: the commands of the pixel mode
-- Golden twin model/golden/token_order.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.token_pkg.all;

entity token_order is
  generic (
    g_config : config_t := c_default_config
  );
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    load_valid   : in  std_logic;
    load_ready   : out std_logic;
    load         : in  std_logic_vector(load_bits(g_config) - 1 downto 0);
    object_valid : in  std_logic;
    object_ready : out std_logic;
    object       : in  std_logic_vector(token_bits(g_config) - 1 downto 0);
    token_valid  : out std_logic;
    token_ready  : in  std_logic;
    token        : out std_logic_vector(token_bits(g_config) - 1 downto 0);
    frame_start  : out std_logic
  );
end entity;

architecture rtl of token_order is

  constant c_exact : boolean        := g_config.exact;
  constant c_pixel : pixel_header_t := pixel_header(c_exact);

  subtype word_t is std_logic_vector(c_pixel.command.high downto c_pixel.command.low);

  -- Position of the last object.
  type reg_t is record
    drawn : std_logic; -- the frame has an object
    y     : std_logic_vector(formats(c_exact).pixel_y.bits - 1 downto 0);
    x     : std_logic_vector(formats(c_exact).pixel_x.bits - 1 downto 0);
  end record;

  signal r, r_next : reg_t;

  signal shadow  : std_logic; -- the object is a shadow polygon
  signal command : command_t; -- of the object

begin

  token_valid  <= object_valid or load_valid;
  load_ready   <= token_ready;
  object_ready <= token_ready;
  frame_start  <= '1' when load_valid = '1' and token_ready = '1' and command_of(c_exact, load) = c_new_frame else '0';

  shadow  <= '1' when command_of(c_exact, object) = c_shadow else '0';
  command <= c_shadow when shadow = '1' else
    c_new_scanline when r.drawn = '0' or field_of(object, c_pixel.y) /= r.y else
    c_new_object when field_of(object, c_pixel.x) = r.x else
    c_new_pixel;

  choose : process (all)
  begin
    if load_valid = '1' then
      token                          <= (others => '0');
      token(load_bits(g_config) - 1 downto 0) <= load;
    else
      token                <= object;
      token(word_t'range)  <= std_logic_vector(to_unsigned(command, word_t'length));
    end if;
  end process;

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if object_valid = '1' and token_ready = '1' and shadow = '0' then
      v.drawn := '1';
      v.y     := field_of(object, c_pixel.y);
      v.x     := field_of(object, c_pixel.x);
    end if;
    if reset = '1' or frame_start = '1' then
      v.drawn := '0';
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
