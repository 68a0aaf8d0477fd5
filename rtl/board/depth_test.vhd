-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Writes the pixels that are nearer than the stored depth. Works on batches: the depths of up to c_places
--             neighbours are read one after the other, then their depths and colours are written. A batch costs one
--             change of direction of the SRAM's data pins instead of one per pixel.
--
--             pixels --> batch memory (depth, colour) --> write: depth, colour of the pixels to keep
--               |                      |
--               +--> read depth ... compare --> keep
--
-- Contract    The pixels' places are below c_pixels. A batch has pixels at consecutive places, ascending or
--             descending, so that no place occurs twice: a depth is never read before an earlier write to it. A pixel
--             that does not continue the batch, or a clock without a pixel, ends it. Of equal depths the first pixel
--             stays. back does not change while busy = '1'.
-- Formats     board_pkg: place, word
-- Latency     a batch of n pixels, k of them nearer, alone on the SRAM: 2n + k + 4 clocks from its first pixel to the
--             next batch's first pixel
-- Throughput  16 nearer pixels in 52 clocks: 15.4 million per second at 50 MHz, less what scan-out takes
-- Error       none
-- Source      ours
-- Golden twin none: it compares and moves words

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.board_pkg.all;
use work.line_pkg.flag;

entity depth_test is
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    back         : in  std_logic; -- the colour buffer to write
    pixel_valid  : in  std_logic;
    pixel_ready  : out std_logic;
    pixel_place  : in  place_t;
    pixel_depth  : in  word_t;
    pixel_colour : in  word_t;
    -- The SRAM.
    access_valid : out std_logic;
    access_ready : in  std_logic;
    access_write : out std_logic;
    access_addr  : out address_t;
    access_data  : out word_t;
    data_valid   : in  std_logic;
    data         : in  word_t;
    busy         : out std_logic -- a batch is not written yet
  );
end entity;

architecture rtl of depth_test is

  constant c_index_bits : positive := 4;
  constant c_places     : positive := 2 ** c_index_bits; -- pixels in a batch

  subtype index_t is unsigned(c_index_bits - 1 downto 0);
  subtype count_t is unsigned(c_index_bits downto 0);

  type phase_t is (
    collect,      -- take pixels and read their depths
    await,        -- wait for the last depths
    write_depth,  -- of the pixel at index; or skip it
    write_colour
    );

  type reg_t is record
    phase      : phase_t;
    count      : count_t; -- pixels in the batch
    index      : count_t; -- collect, await: depths that came back; then the pixel to write
    keep       : std_logic_vector(c_places - 1 downto 0); -- the pixel is nearer
    first      : place_t; -- of the batch
    place      : place_t; -- collect: of its last pixel; then of the pixel to write
    descending : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal follows            : std_logic; -- the pixel continues the batch
  signal ascends, descends  : std_logic;
  signal take               : std_logic; -- a pixel enters the batch
  signal word               : std_logic_vector(31 downto 0); -- of the batch memory at r.index
  signal nearer, kept       : std_logic;

  type memory_t is array (0 to c_places - 1) of std_logic_vector(word'range);

  signal memory : memory_t;

  attribute ram_style           : string;
  attribute ram_style of memory : signal is "block";

begin

  ascends  <= flag(pixel_place = r.place + 1);
  descends <= flag(pixel_place = r.place - 1);
  -- The second pixel gives the direction.
  follows <= '1' when r.count = 0 else
    ascends or descends when r.count = 1 else
    descends when r.descending = '1' else
    ascends;
  take   <= flag(r.phase = collect) and pixel_valid and follows and access_ready;
  nearer <= flag(unsigned(word(31 downto 16)) < unsigned(data));
  kept   <= r.keep(to_integer(r.index(index_t'range)));

  combinational : process (all)
    variable v       : reg_t;
    variable written : std_logic; -- the pixel at index is done
  begin
    v := r;
    written := '0';

    -- Compare the depths that come back.
    if data_valid = '1' then
      v.keep(to_integer(r.index(index_t'range))) := nearer;
      v.index := r.index + 1;
    end if;

    case r.phase is
      when collect =>
        if take = '1' then
          v.count := r.count + 1;
          v.place := pixel_place;
          if r.count = 0 then
            v.first := pixel_place;
          elsif r.count = 1 then
            v.descending := descends;
          end if;
        end if;
        -- End the batch if it is full, or if no pixel continues it.
        if v.count = c_places or (r.count /= 0 and (pixel_valid = '0' or follows = '0')) then
          v.phase := await;
        end if;
      when await =>
        if r.index = r.count then
          v.phase := write_depth;
          v.index := (others => '0');
          v.place := r.first;
        end if;
      when write_depth =>
        if kept = '0' then
          written := '1';
        elsif access_ready = '1' then
          v.phase := write_colour;
        end if;
      when write_colour =>
        if access_ready = '1' then
          v.phase := write_depth;
          written := '1';
        end if;
    end case;

    -- Step to the next pixel to write, or to the next batch.
    if written = '1' then
      v.index := r.index + 1;
      v.place := r.place + 1;
      if r.descending = '1' then
        v.place := r.place - 1;
      end if;
      if v.index = r.count then
        v.phase      := collect;
        v.count      := (others => '0');
        v.index      := (others => '0');
        v.descending := '0';
      end if;
    end if;

    if reset = '1' then
      v.phase      := collect;
      v.count      := (others => '0');
      v.index      := (others => '0');
      v.descending := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  batch : process (clk)
  begin
    if rising_edge(clk) then
      word <= memory(to_integer(r_next.index(index_t'range)));
      if take = '1' then
        memory(to_integer(r.count(index_t'range))) <= pixel_depth & pixel_colour;
      end if;
    end if;
  end process;

  pixel_ready <= take;

  -- Read the depth of the pixel that enters; write depth and colour of a pixel to keep.
  access_valid <= (pixel_valid and follows) when r.phase = collect else
    kept when r.phase = write_depth else
    '1' when r.phase = write_colour else
    '0';
  access_write <= '0' when r.phase = collect else '1';
  access_addr <= resize(pixel_place, address_t'length) + c_depth_base when r.phase = collect else
    resize(r.place, address_t'length) + c_depth_base when r.phase = write_depth else
    resize(r.place, address_t'length) + colour_base(back);
  access_data <= word(31 downto 16) when r.phase = write_depth else word(15 downto 0);

  busy <= '0' when r.phase = collect and r.count = 0 else '1';

end architecture;
