-- SPDX-License-Identifier: Apache-2.0
-- Common parts of the testbenches: files of vectors (format: sim/files/vector_file.hpp), comparisons that stop
-- the run with vector number, actual and expected value, clocks, random stalls, and the end of a testbench.
--
-- The shape of a testbench: one process per instance reads the rows of a file, drives the instance's inputs, compares
-- its outputs and gives its clock. Testbenches of this shape alone are written from tb/vectors/rows.toml.
--
--   vectors.open_file(g_folder & "/16.txt", c_latency);
--   while vectors.next_clock loop
--     vectors.drive(enable);
--     vectors.drive(a);
--     settle;
--     vectors.check("sum", sum);
--     tick(clk);
--   end loop;
--   finish(finished);
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;
use work.formats_pkg.all;
use work.line_pkg.all;

package tb_pkg is

  constant c_half_period : time := 5 ns;

  -- A file of vectors, read one by one.
  type vectors_t is protected
    -- With `latency`: the only word of the file's first vector must be this latency of the hardware.
    procedure open_file (name : in string; latency : in integer := -1);
    procedure close_file;
    -- Advances to the next vector. Returns false at the end of a complete file with at least one vector.
    impure function next_vector return boolean;
    -- As next_vector. The first word of the vector is a flag: '0': the hardware's outputs are not compared.
    impure function next_clock return boolean;
    -- As next_vector, but fails at the end of the file: the hardware gave `what`, and the file expects no more.
    procedure expect_vector (what : in string);
    -- Reads the next word of this vector.
    procedure read_word (word : out std_logic_vector);
    procedure read_flag (flag : out std_logic);
    -- Reads the next word as a number below 2**31.
    impure function read_number return natural;
    -- Drives `target` with the next word of this vector; a line with one word per field.
    procedure drive (signal target : out std_logic);
    procedure drive (signal target : out std_logic_vector);
    procedure drive (signal target : out unsigned);
    procedure drive (signal target : out signed);
    procedure drive (signal target : out line_t);
    -- Compares `got` with the next word of this vector.
    procedure check (name : in string; got : in std_logic_vector);
    procedure check (name : in string; got : in unsigned);
    procedure check (name : in string; got : in signed);
    procedure check (name : in string; got : in std_logic);
    -- As check if `condition` is '1'; otherwise skips the word.
    procedure check_if (condition : in std_logic; name : in string; got : in std_logic_vector);
    procedure check_if (condition : in std_logic; name : in string; got : in unsigned);
    procedure check_if (condition : in std_logic; name : in string; got : in signed);
    procedure check_if (condition : in std_logic; name : in string; got : in std_logic);
    -- As check_if, with the condition as a word before the expected one.
    procedure check_known (name : in string; got : in std_logic_vector);
    -- As check for each of the `number` words of `got`, the lowest first. A failure names it "NAME INDEX". Without words
    -- `got` must be 0.
    procedure check_words (name : in string; number : in natural; got : in std_logic_vector);
    -- Goes on with the rest of the row of `clocks` clocks before, which is not checked if there was none. Call it once
    -- per row.
    procedure look_back (clocks : in natural);
    -- Fails if this vector has words that were not read.
    procedure expect_end;
    -- Stops the run. The message gives the file and the number of the vector.
    procedure fail (message : in string);
  end protected;

  -- True when every process that drives it has set it: the testbench has ended.
  function all_true (values : boolean_vector) return boolean;
  signal finished : all_true boolean;

  -- Sets `done` and ends the process.
  procedure finish (signal done : out boolean);

  -- Waits until no other process has the turn, and takes it. Of the instances of a testbench one runs after the other: all
  -- at once would not fit into a processor's cache.
  procedure take_turn;
  -- Ends the turn, then as `finish`.
  procedure end_turn (signal done : out boolean);

  -- Waits for `done` and reports that the testbench passed.
  procedure report_end (signal done : in boolean; testbench : in string);

  -- Stops the run if `got` is not as expected. The message starts with `place` and `number`, such as "frame 7".
  procedure check (place : in string; number : in integer; name : in string; got, expected : in std_logic);
  procedure check (place : in string; number : in integer; name : in string; got, expected : in std_logic_vector);
  procedure check (place : in string; number : in integer; name : in string; got, expected : in integer);

  -- The second half of a clock period: inputs that were driven reach the outputs.
  procedure settle;
  -- A rising edge of the clock and the first half of its period.
  procedure tick (signal clk : out std_logic);
  -- Waits for `count` rising edges.
  procedure wait_clocks (signal clk : in std_logic; count : in natural);

  function to_flag (value : boolean) return std_logic;

  function preset_name (exact : boolean) return string;

  -- The files of a set of vectors, or of the one that causes a fault.
  function set_name (name : string; wrong : boolean; fault : string) return string;

  -- Numbers in a file's name, such as 3_24_14_8.
  function joined (numbers : integer_vector) return string;

  -- The word of this number, from 0, of words separated by one character.
  function nth_word (words : string; number : natural; separator : character := ' ') return string;

  -- xorshift32 (Marsaglia 2003, shifts 13, 17, 5)
  function next_random (state : unsigned(31 downto 0)) return unsigned;

  -- True with probability 1 / 2**exponent.
  function chance (random : unsigned(7 downto 0); exponent : natural range 0 to 8) return boolean;

  -- Waits for a random number of clocks, also none. A clock is the last with probability 1 / 2**exponent.
  procedure pause (signal clk : in std_logic; random : inout unsigned(31 downto 0); exponent : in natural range 0 to 8);

end package;

package body tb_pkg is

  type nibbles_t is array (0 to 15) of std_logic_vector(3 downto 0);

  constant c_nibbles : nibbles_t := (x"0", x"1", x"2", x"3", x"4", x"5", x"6", x"7", x"8", x"9", x"A", x"B", x"C", x"D",
    x"E", x"F");

  -- Hexadecimal. If a digit has metavalues, append all bits.
  function to_text (word : std_logic_vector) return string is
  begin
    if is_x(word) then
      return to_hstring(word) & " (" & to_string(word) & ")";
    end if;
    return to_hstring(word);
  end function;

  type vectors_t is protected body
    file vectors       : text;
    variable file_name : line;
    variable text_in   : line;
    variable position  : positive;
    variable count     : natural;
    variable checked   : std_logic;

    -- For look_back: the rests of this row and of those before.
    type lines_t is array (0 to 3) of line;
    variable rests         : lines_t;
    variable rests_checked : std_logic_vector(lines_t'range) := (others => '0');

    procedure fail (message : in string) is
    begin
      report file_name.all & ": vector " & to_string(count - 1) & ": " & message severity failure;
    end procedure;

    procedure open_file (name : in string; latency : in integer := -1) is
      variable status   : file_open_status;
      variable expected : natural;
    begin
      deallocate(file_name);
      file_name := new string'(name);
      count     := 0;
      file_open(status, vectors, name, read_mode);
      if status /= open_ok then
        report name & ": cannot open; halfway_vectors writes it" severity failure;
      end if;
      if latency >= 0 then
        expect_vector("the latency");
        expected := read_number;
        if latency /= expected then
          fail("the latency is " & to_string(latency) & ", expected " & to_string(expected));
        end if;
      end if;
    end procedure;

    procedure close_file is
    begin
      file_close(vectors);
    end procedure;

    impure function next_vector return boolean is
    begin
      if endfile(vectors) then
        report file_name.all & ": ends without its last line, end <count>" severity failure;
      end if;
      readline(vectors, text_in);
      position := text_in'low;
      if text_in'length > 4 and text_in(text_in'low to text_in'low + 3) = "end " then
        if count = 0 or text_in(text_in'low + 4 to text_in'high) /= to_string(count) then
          report file_name.all & ": holds " & to_string(count) & " vectors, its last line is " & text_in.all
            severity failure;
        end if;
        return false;
      end if;
      count   := count + 1;
      checked := '1';
      return true;
    end function;

    impure function next_clock return boolean is
      variable found : boolean;
    begin
      found := next_vector;
      if found then
        read_flag(checked);
      end if;
      return found;
    end function;

    procedure expect_vector (what : in string) is
    begin
      if not next_vector then
        report file_name.all & ": " & what & " came after all " & to_string(count) & " expected" severity failure;
      end if;
    end procedure;

    procedure read_word (word : out std_logic_vector) is
      constant c_digits : positive := (word'length + 3) / 4;

      variable digits : std_logic_vector(4 * c_digits - 1 downto 0);
      variable digit  : natural;
    begin
      for i in c_digits - 1 downto 0 loop
        if position > text_in'high then
          fail("ends too early");
        end if;
        case text_in(position) is
          when '0' to '9' => digit := character'pos(text_in(position)) - character'pos('0');
          when 'A' to 'F' => digit := character'pos(text_in(position)) - character'pos('A') + 10;
          when others =>
            digit := 0;
            fail("has a word of another width than " & to_string(word'length) & " bits");
        end case;
        digits(4 * i + 3 downto 4 * i) := c_nibbles(digit);
        position := position + 1;
      end loop;
      if position <= text_in'high and text_in(position) /= ' ' then
        fail("has a word of another width than " & to_string(word'length) & " bits");
      end if;
      position := position + 1;
      word := digits(word'length - 1 downto 0);
    end procedure;

    procedure read_flag (flag : out std_logic) is
      variable word : std_logic_vector(0 downto 0);
    begin
      read_word(word);
      flag := word(0);
    end procedure;

    impure function read_number return natural is
      variable word : std_logic_vector(31 downto 0);
    begin
      read_word(word);
      return to_integer(unsigned(word));
    end function;

    procedure drive (signal target : out std_logic) is
      variable flag : std_logic;
    begin
      read_flag(flag);
      target <= flag;
    end procedure;

    procedure drive (signal target : out std_logic_vector) is
      variable word : std_logic_vector(target'range);
    begin
      read_word(word);
      target <= word;
    end procedure;

    procedure drive (signal target : out unsigned) is
      variable word : std_logic_vector(target'range);
    begin
      read_word(word);
      target <= unsigned(word);
    end procedure;

    procedure drive (signal target : out signed) is
      variable word : std_logic_vector(target'range);
    begin
      read_word(word);
      target <= signed(word);
    end procedure;

    procedure drive (signal target : out line_t) is
    begin
      drive(target.triangle);
      drive(target.y);
      drive(target.start);
      drive(target.stop);
      drive(target.remaining);
      drive(target.empty);
      drive(target.backward);
      drive(target.carry);
    end procedure;

    procedure check_if (condition : in std_logic; name : in string; got : in std_logic_vector) is
      variable expected : std_logic_vector(got'range);
    begin
      read_word(expected);
      if checked = '1' and condition = '1' and got /= expected then
        fail(name & " is " & to_text(got) & ", expected " & to_text(expected));
      end if;
    end procedure;

    procedure check_if (condition : in std_logic; name : in string; got : in unsigned) is
    begin
      check_if(condition, name, std_logic_vector(got));
    end procedure;

    procedure check_if (condition : in std_logic; name : in string; got : in signed) is
    begin
      check_if(condition, name, std_logic_vector(got));
    end procedure;

    procedure check_if (condition : in std_logic; name : in string; got : in std_logic) is
      variable word : std_logic_vector(0 downto 0) := (others => got);
    begin
      check_if(condition, name, word);
    end procedure;

    procedure check (name : in string; got : in std_logic_vector) is
    begin
      check_if('1', name, got);
    end procedure;

    procedure check (name : in string; got : in unsigned) is
    begin
      check_if('1', name, got);
    end procedure;

    procedure check (name : in string; got : in signed) is
    begin
      check_if('1', name, got);
    end procedure;

    procedure check (name : in string; got : in std_logic) is
    begin
      check_if('1', name, got);
    end procedure;

    procedure check_known (name : in string; got : in std_logic_vector) is
      variable known : std_logic;
    begin
      read_flag(known);
      check_if(known, name, got);
    end procedure;

    procedure check_words (name : in string; number : in natural; got : in std_logic_vector) is
      constant c_bits : positive := got'length / maximum(number, 1);

      alias words : std_logic_vector(got'length - 1 downto 0) is got;
    begin
      for index in 0 to number - 1 loop
        check(name & " " & to_string(index), words((index + 1) * c_bits - 1 downto index * c_bits));
      end loop;
      if number = 0 and words /= (words'range => '0') then
        fail(name & " is " & to_text(got) & ", though it has no words");
      end if;
    end procedure;

    procedure expect_end is
    begin
      if position <= text_in'high then
        fail("has words that the testbench does not read");
      end if;
    end procedure;

    procedure look_back (clocks : in natural) is
    begin
      deallocate(rests(rests'high));
      rests(1 to rests'high)         := rests(0 to rests'high - 1);
      rests_checked(1 to rests'high) := rests_checked(0 to rests'high - 1);
      rests(0)                       := new string'(text_in(position to text_in'high));
      rests_checked(0)               := checked;
      checked                        := rests_checked(clocks);
      if checked = '1' then
        deallocate(text_in);
        text_in  := new string'(rests(clocks).all);
        position := text_in'low;
      end if;
    end procedure;
  end protected body;

  function all_true (values : boolean_vector) return boolean is
  begin
    return and values;
  end function;

  procedure finish (signal done : out boolean) is
  begin
    done <= true;
    wait;
  end procedure;

  procedure fail (place : in string; number : in integer; name, got, expected : in string) is
  begin
    report place & " " & to_string(number) & ": " & name & " is " & got & ", expected " & expected severity failure;
  end procedure;

  procedure check (place : in string; number : in integer; name : in string; got, expected : in std_logic) is
  begin
    if got /= expected then
      fail(place, number, name, to_string(got), to_string(expected));
    end if;
  end procedure;

  procedure check (place : in string; number : in integer; name : in string; got, expected : in std_logic_vector) is
  begin
    if got /= expected then
      fail(place, number, name, to_text(got), to_text(expected));
    end if;
  end procedure;

  procedure check (place : in string; number : in integer; name : in string; got, expected : in integer) is
  begin
    if got /= expected then
      fail(place, number, name, to_string(got), to_string(expected));
    end if;
  end procedure;

  type turn_t is protected
    -- Takes the turn, if no process has it, and returns true.
    impure function take return boolean;
    procedure give;
  end protected;

  type turn_t is protected body
    variable taken : boolean := false;

    impure function take return boolean is
    begin
      if taken then
        return false;
      end if;
      taken := true;
      return true;
    end function;

    procedure give is
    begin
      taken := false;
    end procedure;
  end protected body;

  shared variable turn : turn_t;

  procedure take_turn is
  begin
    while not turn.take loop
      wait for 1000 * c_half_period;
    end loop;
  end procedure;

  procedure end_turn (signal done : out boolean) is
  begin
    turn.give;
    finish(done);
  end procedure;

  procedure report_end (signal done : in boolean; testbench : in string) is
  begin
    wait until done;
    report testbench & ": passed" severity note;
    wait;
  end procedure;

  procedure settle is
  begin
    wait for c_half_period;
  end procedure;

  procedure tick (signal clk : out std_logic) is
  begin
    clk <= '1';
    wait for c_half_period;
    clk <= '0';
  end procedure;

  procedure wait_clocks (signal clk : in std_logic; count : in natural) is
  begin
    for i in 1 to count loop
      wait until rising_edge(clk);
    end loop;
  end procedure;

  function to_flag (value : boolean) return std_logic is
  begin
    if value then
      return '1';
    end if;
    return '0';
  end function;

  function preset_name (exact : boolean) return string is
  begin
    if exact then
      return "exact";
    end if;
    return "published";
  end function;

  function set_name (name : string; wrong : boolean; fault : string) return string is
  begin
    if wrong then
      return name & "_" & fault;
    end if;
    return name;
  end function;

  function joined (numbers : integer_vector) return string is
    alias list : integer_vector(0 to numbers'length - 1) is numbers;
  begin
    if list'length = 1 then
      return to_string(list(0));
    end if;
    return to_string(list(0)) & "_" & joined(list(1 to list'right));
  end function;

  function nth_word (words : string; number : natural; separator : character := ' ') return string is
    variable first : positive := words'low;
    variable last  : natural  := words'low - 1;
  begin
    for word in 0 to number loop
      first := last + 1 + boolean'pos(word > 0);
      last  := first;
      while last < words'high and words(last + 1) /= separator loop
        last := last + 1;
      end loop;
    end loop;
    return words(first to last);
  end function;

  function next_random (state : unsigned(31 downto 0)) return unsigned is
    variable x : unsigned(31 downto 0) := state;
  begin
    x := x xor shift_left(x, 13);
    x := x xor shift_right(x, 17);
    x := x xor shift_left(x, 5);
    return x;
  end function;

  function chance (random : unsigned(7 downto 0); exponent : natural range 0 to 8) return boolean is
  begin
    return to_integer(random) mod 2 ** exponent = 0;
  end function;

  procedure pause (signal clk : in std_logic; random : inout unsigned(31 downto 0); exponent : in natural range 0 to 8) is
  begin
    loop
      random := next_random(random);
      exit when chance(random(31 downto 24), exponent);
      wait until rising_edge(clk);
    end loop;
  end procedure;

end package body;
