-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Takes commands from a ring in memory, one after the other, and draws a frame for each: reads the command,
--             checks it, starts the memory unit, passes the packets to the shader, ends the frame, and reports it.
--
--               idle --> receive --> check --> draw --> close --> finish --> drain --> done --> idle
--                                      |        +---------+---------+--> cut --^       ^
--                                      +-----------------------------------------------+
--
-- Contract    ring_head, ring_tail: numbers of commands written and done. A command is taken if they differ while
--             enable = '1'; at most 2**ring_size may wait (a simulation stops otherwise). ring_tail is counted up in the clock
--             after command_done = '1'. faults, in this clock: bits of register faults. swap = '1' in this clock: the picture
--             at colour_base is the one to show.
--             abort = '1' ends the frame that is drawn.
--             read: the ports of burst_reader; words: its stream. packets: words for words_to_fragments, valid/ready. A word
--             that waits is taken back only together with shader_reset = '1'. shader_reset = '1' before each frame: it
--             begins without a light and without a packet. The last word of the command's packets, and the packet of
--             kind 0 after it, have packet_last = '1'.
--             frame, frame_start, frame_done, memory_fault: the ports of fragments_to_memory, whose tuser is "000".
--             last_taken = '1': the memory unit takes the frame's last fragment, with its cause. passes = '1' up to then: later ones do
--             not go to the memory unit. force_last = '1': end the frame
--             without the shader, by a transfer with tlast and without a fragment. It does not begin while a fragment waits,
--             stalled = '1'.
--             Outputs depend on registers, except packet_valid, packet_data, packet_last and words_ready, which pass the
--             stream on.
-- Formats     core_registers_pkg: fields of a command, bits of faults
-- Latency     5 clocks and that of a read from ring_head to frame_start
-- Throughput  1 word per clock
-- Error       none: a frame without a fault is drawn from all words of the command's packets up to a packet of kind 0
-- Source      ours
-- Golden twin none: it computes nothing

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.memory_pkg.all;
use work.core_registers_pkg.all;
use work.line_pkg.flag;

entity ring_control is
  generic (
    g_data_bits   : positive; -- 32 or 64
    g_block_shift : positive  -- log2 of a block's bytes
  );
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    enable       : in  std_logic;
    abort        : in  std_logic;
    ring_base    : in  address_t;
    ring_size    : in  unsigned(3 downto 0);
    ring_head    : in  unsigned(31 downto 0);
    ring_tail    : in  unsigned(31 downto 0);
    busy         : out std_logic;
    command_done : out std_logic;
    faults       : out std_logic_vector(7 downto 0);
    swap         : out std_logic;
    read_start   : out std_logic;
    read_address : out address_t;
    read_count   : out unsigned(28 downto 0);
    read_stop    : out std_logic;
    read_busy    : in  std_logic;
    read_fault   : in  std_logic;
    words_valid  : in  std_logic;
    words_ready  : out std_logic;
    words_data   : in  std_logic_vector(g_data_bits - 1 downto 0);
    words_last   : in  std_logic;
    shader_reset : out std_logic;
    packet_valid : out std_logic;
    packet_ready : in  std_logic;
    packet_data  : out std_logic_vector(g_data_bits - 1 downto 0);
    packet_last  : out std_logic;
    stalled      : in  std_logic;
    last_taken   : in  std_logic;
    cause        : in  cause_t;
    passes       : out std_logic;
    force_last   : out std_logic;
    frame        : out frame_t;
    frame_start  : out std_logic;
    frame_done   : in  std_logic;
    memory_fault : in  std_logic
  );
end entity;

architecture rtl of ring_control is

  constant c_used_words    : positive := 10; -- of a command: up to its last field, and whole units
  constant c_used_bits     : positive := c_used_words * c_word_bits;
  constant c_close_words   : positive := 2 * c_word_bits / g_data_bits; -- evaluated at elaboration
  constant c_ring_bits     : positive := 2 ** ring_size'length - 1; -- of a command's place
  constant c_command_shift : positive := log2(4 * c_command_words); -- of a command's bytes
  constant c_command_units : unsigned(read_count'range) := to_unsigned(c_command_words / 2, read_count'length); -- evaluated at elaboration

  subtype faults_t is std_logic_vector(7 downto 0);

  type phase_t is (
    idle,
    receive, -- a command
    check,
    draw,    -- pass the packets
    close,   -- pass a packet of kind 0
    finish,  -- wait for the frame's end
    cut,     -- end the frame without the shader, and wait for its end
    drain,   -- discard words on their way
    done
    );

  type reg_t is record
    phase       : phase_t;
    place       : unsigned(4 downto 0); -- of the next word of the command, or of the packet of kind 0
    command     : std_logic_vector(c_used_bits - 1 downto 0);
    faults      : faults_t;
    cut         : std_logic; -- the frame is to end at once
    passes      : std_logic;
    read_start  : std_logic;
    frame_start : std_logic;
  end record;

  signal r, r_next : reg_t;

  signal draws        : std_logic; -- the shader works
  signal moves        : std_logic; -- a packet's word is taken
  signal read_fails   : std_logic;
  signal is_bad       : std_logic; -- the command
  signal ring_place   : address_t;
  signal packets      : address_t;
  signal packet_words : unsigned(31 downto 0);
  signal asked        : frame_t; -- by the command

  -- A field of the command.
  function field (words : std_logic_vector; place : command_field_t) return unsigned is
    constant c_low : natural := place.word * c_word_bits + place.low;
  begin
    return unsigned(words(c_low + place.bits - 1 downto c_low));
  end function;

  function channel (words : std_logic_vector; place : command_field_t) return channel_t is
  begin
    return std_logic_vector(field(words, place));
  end function;

  -- The number has a one in the lower bits.
  function unaligned (number : unsigned; bits : natural) return std_logic is
  begin
    return flag(number(bits - 1 downto 0) /= 0);
  end function;

  function wrong_side (side : side_t) return std_logic is
  begin
    return flag(side = 0 or side > 2 ** c_place_bits);
  end function;

  -- The bit of register faults for each cause.
  function faults_of (number : cause_t) return std_logic_vector is
    variable bits : faults_t;
  begin
    bits := (others => '0');
    if number = c_wrong_kind then
      bits(c_faults_wrong_kind_low) := '1';
    elsif number = c_wrong_length then
      bits(c_faults_wrong_length_low) := '1';
    elsif number = c_shader_fault then
      bits(c_faults_shader_low) := '1';
    elsif number = c_limit_reached then
      bits(c_faults_limit_low) := '1';
    end if;
    return bits;
  end function;

begin

  draws        <= flag(r.phase = draw or r.phase = close or r.phase = finish);
  moves        <= words_valid and packet_ready;
  read_fails   <= read_fault and not r.read_start and flag(r.phase /= idle); -- the fault is that of the read before, until it begins
  packets      <= field(r.command, c_command_packets);
  packet_words <= field(r.command, c_command_packet_words);
  asked        <= (
    colour_base   => field(r.command, c_command_colour_base),
    colour_stride => field(r.command, c_command_colour_stride),
    depth_base    => field(r.command, c_command_depth_base),
    depth_stride  => field(r.command, c_command_depth_stride),
    width         => field(r.command, c_command_width),
    height        => field(r.command, c_command_height),
    left          => field(r.command, c_command_left),
    right         => field(r.command, c_command_right),
    top           => field(r.command, c_command_top),
    bottom        => field(r.command, c_command_bottom),
    clear         => or field(r.command, c_command_clear),
    red           => channel(r.command, c_command_red),
    green         => channel(r.command, c_command_green),
    blue          => channel(r.command, c_command_blue)
    );
  is_bad <= flag(field(r.command, c_command_kind) /= c_command_kind_draw)
    or unaligned(packets, 3) or packet_words(0) or packet_words(30) or packet_words(31)
    or unaligned(asked.colour_base, g_block_shift) or unaligned(asked.colour_stride, g_block_shift)
    or unaligned(asked.depth_base, g_block_shift) or unaligned(asked.depth_stride, g_block_shift)
    or wrong_side(asked.width) or wrong_side(asked.height);

  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    v.read_start  := '0';
    v.frame_start := '0';
    case r.phase is

      -- Read the next command.
      when idle =>
        v.faults := (others => '0');
        v.place  := (others => '0');
        v.cut    := '0';
        v.passes := '1';
        if enable = '1' and ring_head /= ring_tail then
          v.phase      := receive;
          v.read_start := '1';
        end if;

        -- Keep the words of the command that are used.
      when receive =>
        if words_valid = '1' then
          v.place := r.place + 1;
          if r.place < c_used_bits / g_data_bits then -- evaluated at elaboration
            v.command := words_data & r.command(c_used_bits - 1 downto g_data_bits);
          end if;
          if words_last = '1' then
            v.phase := check;
          end if;
        end if;

        -- Begin the frame, or refuse it.
      when check =>
        v.place := (others => '0');
        if is_bad = '1' or r.cut = '1' then
          v.phase := done;
          v.faults(c_faults_command_low) := is_bad and not r.cut;
        else
          v.phase       := draw;
          v.read_start  := '1';
          v.frame_start := '1';
          if packet_words = 0 then
            v.phase      := close;
            v.read_start := '0';
          end if;
        end if;

        -- Pass the packets, then a packet of kind 0.
      when draw =>
        if moves = '1' and words_last = '1' then
          v.phase := close;
        end if;

      when close =>
        if packet_ready = '1' then
          v.place := r.place + 1;
          if r.place = c_close_words - 1 then
            v.phase := finish;
          end if;
        end if;

      when drain =>
        if read_busy = '0' then
          v.phase := done;
        end if;

      when done =>
        v.phase := idle;

      when finish | cut =>
        null;

    end case;

    -- Collect faults. After an abort or an error of a read the frame ends at once.
    if last_taken = '1' then
      v.passes := '0';
      v.faults := v.faults or faults_of(cause);
    end if;
    if read_fails = '1' then
      v.faults(c_faults_read_low) := '1';
      v.cut := '1';
    end if;
    if abort = '1' and r.phase /= idle then
      v.faults(c_faults_aborted_low) := '1';
      v.cut := '1';
    end if;
    if draws = '1' and r.cut = '1' and stalled = '0' then
      v.phase := cut;
    end if;

    -- Leave the frame when it is in memory.
    if frame_done = '1' then
      v.phase := drain;
    end if;
    if r.phase = drain and memory_fault = '1' then
      v.faults(c_faults_memory_low) := '1';
    end if;
    if reset = '1' then
      v.phase       := idle;
      v.read_start  := '0';
      v.frame_start := '0';
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
  check_ring : process (clk)
  begin
    if rising_edge(clk) then
      assert enable /= '1' or reset /= '0' or ring_head - ring_tail <= shift_left(to_unsigned(1, 32), to_integer(ring_size))
        report "ring_control: more than 2**ring_size commands wait"
        severity failure;
    end if;
  end process;

  place_in_ring : process (all)
    variable place : unsigned(c_ring_bits - 1 downto 0);
  begin
    for i in place'range loop
      place(i) := ring_tail(i) and flag(i < ring_size);
    end loop;
    ring_place <= ring_base + (place & to_unsigned(0, c_command_shift));
  end process;

  busy         <= flag(r.phase /= idle);
  command_done <= flag(r.phase = done);
  faults       <= r.faults;
  swap         <= flag(r.phase = done) and (or field(r.command, c_command_swap)) and not (or r.faults);
  read_start   <= r.read_start;
  read_address <= packets when draws = '1' else ring_place;
  read_count   <= packet_words(read_count'high + 1 downto 1) when draws = '1' else c_command_units;
  read_stop    <= flag(r.phase = cut or r.phase = drain);
  words_ready  <= packet_ready or not flag(r.phase = draw);
  shader_reset <= not draws;
  packet_valid <= (words_valid and flag(r.phase = draw)) or flag(r.phase = close);
  packet_data  <= words_data when r.phase = draw else (others => '0');
  packet_last  <= words_last when r.phase = draw else flag(r.place = c_close_words - 1);
  passes       <= r.passes;
  force_last   <= flag(r.phase = cut) and r.passes;
  frame        <= asked;
  frame_start  <= r.frame_start;

end architecture;
