-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     The registers of halfway_core, behind register_port.
-- Contract    core_registers_pkg has the registers; docs/rtl/core.md describes them. write = '1': the register changes in
--             the next clock. write_error and read_data, read_error depend on the address only. An event in the clock of
--             a write that clears its bit sets the bit.
--             abort = '1' for one clock: a 1 was written to control.abort.
--             command_done = '1' for one clock: a command is done, with command_faults. ring_tail counts it in the next
--             clock. swap = '1' for one clock: picture becomes picture_base.
--             triangle, fragment, stalled = '1', and pixels: counted in each clock, 1 clock later; busy, too.
--             interrupt depends on registers only.
-- Formats     the words of g_shader, g_lights, g_objects and g_memory are those of the registers
-- Latency     1 clock from a write to the outputs; 2 clocks from an input to its counter and to status
-- Throughput  1 write and 1 read per clock
-- Error       none
-- Source      ours
-- Golden twin none: it stores and counts

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.line_pkg.flag;
use work.memory_pkg.all;
use work.core_registers_pkg.all;

entity core_registers is
  generic (
    g_shader  : std_logic_vector(31 downto 0) := (others => '0');
    g_lights  : std_logic_vector(31 downto 0) := (others => '0');
    g_objects : std_logic_vector(31 downto 0) := (others => '0');
    g_memory  : std_logic_vector(31 downto 0) := (others => '0')
  );
  port (
    clk            : in  std_logic;
    reset          : in  std_logic;
    write          : in  std_logic;
    write_address  : in  unsigned(5 downto 0);
    write_data     : in  std_logic_vector(31 downto 0);
    write_strobes  : in  std_logic_vector(3 downto 0);
    write_error    : out std_logic;
    read_address   : in  unsigned(5 downto 0);
    read_data      : out std_logic_vector(31 downto 0);
    read_error     : out std_logic;
    enable         : out std_logic;
    abort          : out std_logic;
    ring_base      : out address_t;
    ring_size      : out unsigned(c_ring_size_log2_bits - 1 downto 0);
    ring_head      : out unsigned(31 downto 0);
    ring_tail      : out unsigned(31 downto 0);
    busy           : in  std_logic;
    command_done   : in  std_logic;
    command_faults : in  std_logic_vector(7 downto 0); -- bits as of the register faults
    swap           : in  std_logic;
    picture_base   : in  address_t;
    picture        : out address_t;
    triangle       : in  std_logic;
    fragment       : in  std_logic;
    pixels         : in  pixel_count_t;
    stalled        : in  std_logic;
    interrupt      : out std_logic
  );
end entity;

architecture rtl of core_registers is

  subtype word_t is std_logic_vector(31 downto 0);

  constant c_version : word_t :=
    std_logic_vector(to_unsigned(c_version_major, c_version_major_bits))
    & std_logic_vector(to_unsigned(c_version_minor, c_version_minor_bits))
    & std_logic_vector(to_unsigned(c_version_patch, c_version_patch_bits));

  type reg_t is record
    enable           : std_logic;
    abort            : std_logic;
    faults           : std_logic_vector(command_faults'range);
    interrupt_enable : std_logic_vector(1 downto 0);
    interrupts       : std_logic_vector(1 downto 0);
    ring_base        : unsigned(31 downto c_ring_base_address_low);
    ring_size        : unsigned(ring_size'range);
    ring_head        : unsigned(31 downto 0);
    ring_tail        : unsigned(31 downto 0);
    picture          : address_t;
    busy             : std_logic; -- inputs of the clock before, as the next four
    triangle         : std_logic;
    fragment         : std_logic;
    pixels           : pixel_count_t;
    stalled          : std_logic;
    triangles        : unsigned(31 downto 0);
    fragments        : unsigned(31 downto 0);
    kept_pixels      : unsigned(31 downto 0);
    busy_clocks      : unsigned(31 downto 0);
    stalled_clocks   : unsigned(31 downto 0);
  end record;

  -- '1' if the word at this address has this access.
  function has_access (address : unsigned(5 downto 0); access_kind : access_t) return std_logic is
    variable found : std_logic := '0';
  begin
    for number in c_accesses'range loop
      if c_accesses(number) = access_kind and address = number then
        found := '1';
      end if;
    end loop;
    return found;
  end function;

  -- '1' if the address is that of the register at this offset.
  function is_at (address : unsigned(5 downto 0); offset : natural) return std_logic is
  begin
    return flag(address & "00" = offset);
  end function;

  -- The word if the address is that of the register at this offset, otherwise 0.
  function word_at (address : unsigned(5 downto 0); offset : natural; word : std_logic_vector) return word_t is
    variable padded : word_t := (others => '0');
  begin
    padded(word'length - 1 downto 0) := word;
    return padded and (padded'range => is_at(address, offset));
  end function;

  -- The register with those bytes of data that have a strobe.
  function written (old : unsigned(31 downto 0); data : word_t; strobes : std_logic_vector(3 downto 0))
    return unsigned is
    variable word : unsigned(31 downto 0) := old;
  begin
    for byte_number in strobes'range loop
      if strobes(byte_number) = '1' then
        word(8 * byte_number + 7 downto 8 * byte_number) := unsigned(data(8 * byte_number + 7 downto 8 * byte_number));
      end if;
    end loop;
    return word;
  end function;

  signal r, r_next : reg_t;

begin

  combinational : process (all)
    variable v      : reg_t;
    variable first  : std_logic; -- a write of the lowest byte
    variable base   : unsigned(31 downto 0);
    variable events : std_logic_vector(1 downto 0);
  begin
    v       := r;
    v.abort := '0';
    first   := write and write_strobes(0);
    base    := r.ring_base & (c_ring_base_address_low - 1 downto 0 => '0');

    -- Write a register; clear bits.
    if (first and is_at(write_address, c_address_control)) = '1' then
      v.enable := write_data(c_control_enable_low);
      v.abort  := write_data(c_control_abort_low);
    end if;
    if (first and is_at(write_address, c_address_faults)) = '1' then
      v.faults := r.faults and not write_data(r.faults'range);
    end if;
    if (first and is_at(write_address, c_address_interrupt_enable)) = '1' then
      v.interrupt_enable := write_data(r.interrupt_enable'range);
    end if;
    if (first and is_at(write_address, c_address_interrupts)) = '1' then
      v.interrupts := r.interrupts and not write_data(r.interrupts'range);
    end if;
    if (write and is_at(write_address, c_address_ring_base)) = '1' then
      base := written(base, write_data, write_strobes);
    end if;
    v.ring_base := base(r.ring_base'range);
    if (first and is_at(write_address, c_address_ring_size)) = '1' then
      v.ring_size := unsigned(write_data(r.ring_size'range));
    end if;
    if (write and is_at(write_address, c_address_ring_head)) = '1' then
      v.ring_head := written(r.ring_head, write_data, write_strobes);
    end if;

    -- The end of a command.
    events := "00";
    if command_done = '1' then
      events(c_interrupts_frame_low) := '1';
      events(c_interrupts_fault_low) := or command_faults;
      v.faults                       := v.faults or command_faults;
      v.ring_tail                    := r.ring_tail + 1;
    end if;
    v.interrupts := v.interrupts or events;
    if swap = '1' then
      v.picture := picture_base;
    end if;

    -- Count the inputs of the clock before.
    v.busy           := busy;
    v.triangle       := triangle;
    v.fragment       := fragment;
    v.pixels         := pixels;
    v.stalled        := stalled;
    v.triangles      := r.triangles + r.triangle;
    v.fragments      := r.fragments + r.fragment;
    v.kept_pixels    := r.kept_pixels + r.pixels;
    v.busy_clocks    := r.busy_clocks + r.busy;
    v.stalled_clocks := r.stalled_clocks + r.stalled;

    if reset = '1' then
      v.enable           := '0';
      v.abort            := '0';
      v.faults           := (others => '0');
      v.interrupt_enable := "00";
      v.interrupts       := "00";
      v.ring_base        := (others => '0');
      v.ring_size        := (others => '0');
      v.ring_head        := (others => '0');
      v.ring_tail        := (others => '0');
      v.picture          := (others => '0');
      v.busy             := '0';
      v.triangle         := '0';
      v.fragment         := '0';
      v.pixels           := (others => '0');
      v.stalled          := '0';
      v.triangles        := (others => '0');
      v.fragments        := (others => '0');
      v.kept_pixels      := (others => '0');
      v.busy_clocks      := (others => '0');
      v.stalled_clocks   := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  write_error <= not (has_access(write_address, rw) or has_access(write_address, w1c));
  read_error  <= has_access(read_address, unmapped);

  read_data <= word_at(read_address, c_address_identity, c_identity)
    or word_at(read_address, c_address_version, c_version)
    or word_at(read_address, c_address_shader, g_shader)
    or word_at(read_address, c_address_lights, g_lights)
    or word_at(read_address, c_address_objects, g_objects)
    or word_at(read_address, c_address_memory, g_memory)
    or word_at(read_address, c_address_control, "" & r.enable)
    or word_at(read_address, c_address_status, "" & r.busy)
    or word_at(read_address, c_address_faults, r.faults)
    or word_at(read_address, c_address_interrupt_enable, r.interrupt_enable)
    or word_at(read_address, c_address_interrupts, r.interrupts)
    or word_at(read_address, c_address_ring_base, std_logic_vector(ring_base))
    or word_at(read_address, c_address_ring_size, std_logic_vector(r.ring_size))
    or word_at(read_address, c_address_ring_head, std_logic_vector(r.ring_head))
    or word_at(read_address, c_address_ring_tail, std_logic_vector(r.ring_tail))
    or word_at(read_address, c_address_picture, std_logic_vector(r.picture))
    or word_at(read_address, c_address_triangles, std_logic_vector(r.triangles))
    or word_at(read_address, c_address_fragments, std_logic_vector(r.fragments))
    or word_at(read_address, c_address_pixels, std_logic_vector(r.kept_pixels))
    or word_at(read_address, c_address_busy_clocks, std_logic_vector(r.busy_clocks))
    or word_at(read_address, c_address_stalled_clocks, std_logic_vector(r.stalled_clocks));

  enable    <= r.enable;
  abort     <= r.abort;
  ring_base <= r.ring_base & (c_ring_base_address_low - 1 downto 0 => '0');
  ring_size <= r.ring_size;
  ring_head <= r.ring_head;
  ring_tail <= r.ring_tail;
  picture   <= r.picture;
  interrupt <= or (r.interrupts and r.interrupt_enable);

end architecture;
