-- SPDX-License-Identifier: Apache-2.0
-- AXI4 in testbenches: signals of a manager and of a subordinate, for buses of up to 64 bits; the words of memories, each
-- with a number; and a memory at the bus.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.tb_pkg.all;

package axi_words_pkg is

  -- The window of the address space that the memories have.
  constant c_memory_origin : natural  := 16#7FFC0000#;
  constant c_memory_words  : positive := 2 ** 15; -- of 32 bits
  constant c_memories      : positive := 14;

  subtype word_t is std_logic_vector(31 downto 0);

  type request_t is record
    valid : std_logic;
    addr  : unsigned(31 downto 0);
    len   : unsigned(7 downto 0);
    size  : std_logic_vector(2 downto 0);
    burst : std_logic_vector(1 downto 0);
  end record;

  type manager_t is record
    ar     : request_t;
    aw     : request_t;
    wvalid : std_logic;
    wdata  : std_logic_vector(63 downto 0);
    wstrb  : std_logic_vector(7 downto 0);
    wlast  : std_logic;
    rready : std_logic;
    bready : std_logic;
  end record;

  type subordinate_t is record
    arready : std_logic;
    awready : std_logic;
    wready  : std_logic;
    rvalid  : std_logic;
    rdata   : std_logic_vector(63 downto 0);
    rresp   : std_logic_vector(1 downto 0);
    rlast   : std_logic;
    bvalid  : std_logic;
    bresp   : std_logic_vector(1 downto 0);
  end record;

  constant c_quiet : subordinate_t := (rdata => (others => '0'), rresp | bresp => "00", others => '0');

  type memory_words_t is protected
    procedure randomize (memory : natural); -- as the vectors' memory
    procedure fill (memory : natural; word : word_t);
    procedure copy (from, target : natural);
    procedure set (memory, index : natural; word : word_t);
    impure function get (memory, index : natural) return word_t;
    -- A byte of a write at this address, which must be in the window.
    procedure set_byte (memory, address : natural; value : std_logic_vector(7 downto 0));
    -- All of the memory must be as the other one. The message starts with `place` and `number`.
    procedure compare (place : string; number : integer; memory, expected : natural);
  end protected;

end package;

package body axi_words_pkg is

  type memory_words_t is protected body
    type words_t is array (0 to c_memory_words - 1) of word_t;
    type memories_t is array (0 to c_memories - 1) of words_t;

    variable words : memories_t;

    procedure randomize (memory : natural) is
      variable random : unsigned(31 downto 0) := to_unsigned(7, 32);
    begin
      for index in words_t'range loop
        random := next_random(random);
        words(memory)(index) := std_logic_vector(random);
      end loop;
    end procedure;

    procedure fill (memory : natural; word : word_t) is
    begin
      words(memory) := (others => word);
    end procedure;

    procedure copy (from, target : natural) is
    begin
      words(target) := words(from);
    end procedure;

    procedure set (memory, index : natural; word : word_t) is
    begin
      words(memory)(index) := word;
    end procedure;

    impure function get (memory, index : natural) return word_t is
    begin
      return words(memory)(index);
    end function;

    procedure set_byte (memory, address : natural; value : std_logic_vector(7 downto 0)) is
      constant c_offset : integer := address - c_memory_origin;
      constant c_low    : natural := 8 * (address mod 4);
    begin
      if c_offset < 0 or c_offset >= 4 * c_memory_words then
        report "axi_memory: write at " & to_hstring(to_unsigned(address, 32)) severity failure;
      end if;
      words(memory)(c_offset / 4)(c_low + 7 downto c_low) := value;
    end procedure;

    procedure compare (place : string; number : integer; memory, expected : natural) is
    begin
      for index in words_t'range loop
        if words(memory)(index) /= words(expected)(index) then
          check(place, number, "word " & to_string(index) & " of memory", words(memory)(index), words(expected)(index));
        end if;
      end loop;
    end procedure;
  end protected body;

end package body;

use work.axi_words_pkg.all;

-- A package of its own: the body of the type is before the variable.
package axi_memory_pkg is

  shared variable memories : memory_words_t;

end package;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_words_pkg.all;
use work.axi_memory_pkg.all;
use work.tb_pkg.all;

-- An AXI4 memory that takes what the rules allow: a read sees the memory at the clock in which its address is taken, and
-- a write changes it only in the clock of its response. The channels are independent. latency: clocks from an address to
-- the first word, and from a write's last word to its response. pause: a ready or a valid is '1' in one of 2**pause
-- clocks; if it is not 0, each burst has a random latency up to this one. errors: one of 2**errors words and responses is
-- an error, if it is not 0.
entity axi_memory is
  generic (
    g_memory    : natural; -- its number
    g_data_bits : positive
  );
  port (
    clk     : in  std_logic;
    reset   : in  std_logic; -- discards what is on its way
    latency : in  positive;
    pause   : in  natural;
    errors  : in  natural;
    m       : in  manager_t;
    s       : out subordinate_t := c_quiet
  );
end entity;

architecture sim of axi_memory is
  constant c_bytes    : positive := g_data_bits / 8;
  constant c_requests : positive := 64;
  constant c_beats    : positive := 8192;

  type request_state_t is record
    addr : natural;
    len  : natural;
    due  : natural; -- clock of the first word, or of the response
  end record;

  type requests_t is array (0 to c_requests - 1) of request_state_t;

  type beat_t is record
    data : std_logic_vector(63 downto 0);
    strb : std_logic_vector(7 downto 0);
    last : std_logic;
    due  : natural;
  end record;

  type beats_t is array (0 to c_beats - 1) of beat_t;

  signal answers : subordinate_t := c_quiet;
begin
  s <= answers;

  serve : process (clk) is
    variable random              : unsigned(31 downto 0) := to_unsigned(99, 32);
    variable clock               : natural := 0;
    variable reads               : beats_t; -- words to come
    variable read_in, read_out   : natural := 0;
    variable writes              : requests_t; -- addresses, and when their bursts ended
    variable write_in, write_out : natural := 0;
    variable bursts              : natural := 0; -- that ended
    variable beats               : beats_t; -- that were taken
    variable beat_in, beat_out   : natural := 0;
    variable address             : natural;
    variable place               : natural;
    variable first_word          : natural; -- clock of it

    impure function now_and_then return boolean is
    begin
      random := next_random(random);
      return chance(random(30 downto 23), pause);
    end function;

    -- The clock of a burst's first word, or of its response.
    impure function due return natural is
    begin
      if pause = 0 then
        return clock + latency - 1;
      end if;
      random := next_random(random);
      return clock + to_integer(random(30 downto 15)) mod latency;
    end function;

    impure function response return std_logic_vector is
    begin
      random := next_random(random);
      if errors > 0 and chance(random(30 downto 23), errors) then
        return "1" & random(0); -- SLVERR, DECERR
      end if;
      return "00";
    end function;
  begin
    if rising_edge(clk) then
      clock := clock + 1;

      -- Take addresses and words.
      if m.ar.valid = '1' and answers.arready = '1' then
        first_word := due;
        for beat in 0 to to_integer(m.ar.len) loop
          address := to_integer(m.ar.addr) + beat * c_bytes;
          assert address >= c_memory_origin and address < c_memory_origin + 4 * c_memory_words
            report "axi_memory: read at " & to_hstring(to_unsigned(address, 32)) severity failure;
          place := (address - c_memory_origin) / 4;
          reads(read_in mod c_beats) := (data => (others => 'X'), strb => (others => '0'),
            last => to_flag(beat = to_integer(m.ar.len)), due => first_word);
          for word in 0 to g_data_bits / 32 - 1 loop
            reads(read_in mod c_beats).data(32 * word + 31 downto 32 * word) := memories.get(g_memory, place + word);
          end loop;
          read_in := read_in + 1;
        end loop;
      end if;
      if m.aw.valid = '1' and answers.awready = '1' then
        writes(write_in mod c_requests).addr := to_integer(m.aw.addr);
        writes(write_in mod c_requests).len  := to_integer(m.aw.len);
        write_in := write_in + 1;
      end if;
      if m.wvalid = '1' and answers.wready = '1' then
        beats(beat_in mod c_beats) := (m.wdata, m.wstrb, m.wlast, 0);
        beat_in := beat_in + 1;
        if m.wlast = '1' then
          writes(bursts mod c_requests).due := due;
          bursts := bursts + 1;
        end if;
      end if;

      -- Give words and responses.
      if answers.rvalid = '0' or m.rready = '1' then
        answers.rvalid <= '0';
        answers.rdata  <= (others => 'X');
        if read_out < read_in and clock >= reads(read_out mod c_beats).due and now_and_then then
          answers.rvalid <= '1';
          answers.rdata  <= reads(read_out mod c_beats).data;
          answers.rlast  <= reads(read_out mod c_beats).last;
          answers.rresp  <= response;
          read_out := read_out + 1;
        end if;
      end if;
      if answers.bvalid = '0' or m.bready = '1' then
        answers.bvalid <= '0';
        if write_out < write_in and write_out < bursts and clock >= writes(write_out mod c_requests).due
          and now_and_then then
          for beat in 0 to writes(write_out mod c_requests).len loop
            for lane in 0 to c_bytes - 1 loop
              if beats(beat_out mod c_beats).strb(lane) = '1' then
                memories.set_byte(g_memory, writes(write_out mod c_requests).addr + beat * c_bytes + lane,
                  beats(beat_out mod c_beats).data(8 * lane + 7 downto 8 * lane));
              end if;
            end loop;
            beat_out := beat_out + 1;
          end loop;
          answers.bvalid <= '1';
          answers.bresp  <= response;
          write_out := write_out + 1;
        end if;
      end if;
      if reset = '1' then
        read_out  := read_in;
        write_in  := 0;
        write_out := 0;
        bursts    := 0;
        beat_out  := beat_in;
        answers   <= c_quiet;
      end if;
      answers.arready <= to_flag(read_in - read_out < c_beats - 256 and now_and_then);
      answers.awready <= to_flag(write_in - write_out < c_requests - 2 and now_and_then);
      answers.wready  <= to_flag(bursts - write_out < c_requests - 2 and now_and_then);
    end if;
  end process;
end architecture;

-- The same memory at memory_port: a word is read g_clocks clocks after it is requested.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_words_pkg.all;
use work.axi_memory_pkg.all;

entity port_memory is
  generic (
    g_memory    : natural;
    g_data_bits : positive;
    g_clocks    : positive
  );
  port (
    clk   : in  std_logic;
    reset : in  std_logic;
    m     : in  manager_t;
    s     : out subordinate_t := c_quiet
  );
end entity;

architecture sim of port_memory is
  constant c_bytes : positive := g_data_bits / 8;

  type words_t is array (1 to g_clocks) of std_logic_vector(g_data_bits - 1 downto 0);

  signal enable     : std_logic;
  signal strobes    : std_logic_vector(c_bytes - 1 downto 0);
  signal address    : unsigned(31 - 2 - g_data_bits / 64 downto 0);
  signal data, word : std_logic_vector(g_data_bits - 1 downto 0);
begin
  dut : entity work.memory_port
    generic map (g_data_bits => g_data_bits, g_clocks => g_clocks)
    port map (
      clk            => clk,
      reset          => reset,
      s_axi_arvalid  => m.ar.valid,
      s_axi_arready  => s.arready,
      s_axi_araddr   => m.ar.addr,
      s_axi_arlen    => m.ar.len,
      s_axi_rvalid   => s.rvalid,
      s_axi_rready   => m.rready,
      s_axi_rdata    => s.rdata(g_data_bits - 1 downto 0),
      s_axi_rlast    => s.rlast,
      s_axi_awvalid  => m.aw.valid,
      s_axi_awready  => s.awready,
      s_axi_awaddr   => m.aw.addr,
      s_axi_wvalid   => m.wvalid,
      s_axi_wready   => s.wready,
      s_axi_wdata    => m.wdata(g_data_bits - 1 downto 0),
      s_axi_wstrb    => m.wstrb(c_bytes - 1 downto 0),
      s_axi_wlast    => m.wlast,
      s_axi_bvalid   => s.bvalid,
      s_axi_bready   => m.bready,
      memory_enable  => enable,
      memory_strobes => strobes,
      memory_address => address,
      memory_data    => data,
      memory_word    => word);

  s.rresp <= "00";
  s.bresp <= "00";

  serve : process (clk) is
    variable words : words_t;
    variable first : natural; -- address of the first byte
  begin
    if rising_edge(clk) then
      words(2 to g_clocks) := words(1 to g_clocks - 1);
      words(1) := (others => 'X');
      if enable = '1' then
        first := to_integer(address) * c_bytes;
        for lane in 0 to c_bytes - 1 loop
          if strobes(lane) = '1' then
            memories.set_byte(g_memory, first + lane, data(8 * lane + 7 downto 8 * lane));
          end if;
        end loop;
        if strobes = (strobes'range => '0') then
          for half in 0 to g_data_bits / 32 - 1 loop
            words(1)(32 * half + 31 downto 32 * half) := memories.get(g_memory, (first - c_memory_origin) / 4 + half);
          end loop;
        end if;
      end if;
      word <= words(g_clocks);
    end if;
  end process;
end architecture;
