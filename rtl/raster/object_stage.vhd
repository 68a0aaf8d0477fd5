-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Finds the nearest object at each pixel of a line before any object is shaded. The tokens of a line come in
--             three rounds. The command gives the round:
--               depth     all objects: the stage stores the nearest z of each column with its triangle, the first one if
--                         several are equal, and drops the token
--               shadow    shadow polygons: passed on where an object is stored and the polygon is strictly nearer
--               any other all objects again: passed on where z and triangle are the stored ones. This clears the column,
--                         so each pixel is shaded once and no column is in use when the next line starts.
-- Contract    valid/ready; tokens leave in order and do not change while they wait. clear is '1' only where idle = '1' and
--             in_valid = '0'; it clears all columns. After clear, in_ready and idle are '0' for one clock per column up to
--             the last stored one; after reset, for one clock per column of all.
--             busy: the stage holds a token. idle: it holds none, and no columns are being cleared.
-- Formats     formats_pkg: pixel (the token's header); the other bits are not read
-- Latency     1 clock
-- Throughput  1 token per clock, for any order of columns
-- Source      processors paper, section 2 (the z-buffer) and section 3.3 (shadow polygons open and close); that
--             only those nearer than the object count is our reading
-- Golden twin model/golden/object_stage.hpp

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
use work.processors_pkg.all;

entity object_stage is
  generic (
    g_exact : boolean := true;
    g_bits  : positive -- bits of a token
  );
  port (
    clk       : in  std_logic;
    reset     : in  std_logic;
    clear     : in  std_logic;
    in_valid  : in  std_logic;
    in_ready  : out std_logic;
    in_token  : in  std_logic_vector(g_bits - 1 downto 0);
    out_valid : out std_logic;
    out_ready : in  std_logic;
    out_token : out std_logic_vector(g_bits - 1 downto 0);
    busy      : out std_logic;
    idle      : out std_logic
  );
end entity;

architecture rtl of object_stage is

  constant c_formats : formats_t      := formats(g_exact);
  constant c_pixel   : pixel_header_t := pixel_header(g_exact);

  subtype command_t is std_logic_vector(c_formats.command.bits - 1 downto 0);
  subtype column_t is unsigned(c_formats.pixel_x.bits - 1 downto 0);

  -- An entry, from its highest bit: whether it holds an object, the depth, the triangle.
  constant c_entry_bits : positive := 1 + c_formats.depth.bits + c_formats.triangle.bits;

  subtype entry_t is std_logic_vector(c_entry_bits - 1 downto 0);

  constant c_nothing : entry_t := (others => '0');

  function command_word (command : natural) return command_t is
  begin
    return std_logic_vector(to_unsigned(command, command_t'length));
  end function;

  type reg_t is record
    clearing  : std_logic;
    last      : column_t; -- the highest column that was stored; while clearing, the column to clear
    valid     : std_logic;
    forwarded : std_logic; -- the previous token changed this column: use `forward`, the memory is not yet written
    forward   : entry_t;
  end record;

  signal r, r_next : reg_t;

  type memory_t is array (2 ** column_t'length - 1 downto 0) of entry_t;

  signal memory_entries : memory_t;

  attribute ram_style                   : string;
  attribute ram_style of memory_entries : signal is "block";

  signal token             : std_logic_vector(g_bits - 1 downto 0);
  signal in_column, column : column_t;
  signal command           : command_t;
  signal z, kept_z         : unsigned(c_formats.depth.bits - 1 downto 0);
  signal triangle          : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
  signal memory_q, kept    : entry_t;
  signal present           : std_logic;
  signal nearer            : std_logic;
  signal passes, keeps     : std_logic;
  signal takes_away        : std_logic;
  signal free, take        : std_logic;
  signal changes           : std_logic; -- write the token's column
  signal changed           : entry_t;
  signal write_enable      : std_logic;
  signal write_at          : column_t;
  signal written           : entry_t;

begin

  in_column <= unsigned(in_token(c_pixel.x.high downto c_pixel.x.low));
  column    <= unsigned(token(c_pixel.x.high downto c_pixel.x.low));
  command   <= token(c_pixel.command.high downto c_pixel.command.low);
  z         <= unsigned(token(c_pixel.z.high downto c_pixel.z.low));
  triangle  <= token(c_pixel.triangle.high downto c_pixel.triangle.low);

  kept    <= r.forward when r.forwarded = '1' else memory_q;
  present <= kept(kept'high);
  kept_z  <= unsigned(kept(kept'high - 1 downto triangle'length));
  nearer  <= '1' when z < kept_z else '0';

  decide : process (all)
  begin
    passes     <= '0';
    keeps      <= '0';
    takes_away <= '0';
    changed    <= '1' & std_logic_vector(z) & triangle;
    if command = command_word(c_depth) then
      keeps <= nearer or not present;
    elsif command = command_word(c_shadow) then
      passes <= nearer and present;
    else
      if kept = '1' & std_logic_vector(z) & triangle then
        passes     <= '1';
        takes_away <= '1';
      end if;
      changed <= c_nothing;
    end if;
  end process;

  free     <= not r.valid or not passes or out_ready;
  in_ready <= free and not r.clearing;
  take     <= in_valid and free and not r.clearing;
  -- While the token waits, its column is written again with the same entry.
  changes <= r.valid and (keeps or takes_away);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if free = '1' then
      v.valid := take;
    end if;
    if take = '1' then
      v.forwarded := '0';
      if changes = '1' and in_column = column then
        v.forwarded := '1';
      end if;
      v.forward := changed;
    end if;
    if r.clearing = '1' then
      if r.last = 0 then
        v.clearing := '0';
      else
        v.last := r.last - 1;
      end if;
    elsif clear = '1' then
      v.clearing := '1';
    elsif r.valid = '1' and keeps = '1' and column > r.last then
      v.last := column;
    end if;
    if reset = '1' then
      v.clearing := '1';
      v.last     := (others => '1');
      v.valid    := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  held : entity work.parameter_register
    generic map (
      g_bits => g_bits
      )
    port map (
      clk   => clk,
      load  => take,
      start => in_token,
      value => token
      );

  write_enable <= r.clearing or changes;
  write_at     <= r.last when r.clearing = '1' else column;
  written      <= c_nothing when r.clearing = '1' else changed;

  memory : process (clk)
  begin
    if rising_edge(clk) then
      if take = '1' then
        memory_q <= memory_entries(to_integer(in_column));
      end if;
      if write_enable = '1' then
        memory_entries(to_integer(write_at)) <= written;
      end if;
    end if;
  end process;

  out_valid <= r.valid and passes;
  out_token <= token;
  busy      <= r.valid;
  idle      <= not r.valid and not r.clearing;

end architecture;
