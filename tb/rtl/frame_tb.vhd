-- SPDX-License-Identifier: Apache-2.0
-- Drives a shader with the vectors of an init file and writes its fragments to a trace (formats:
-- sim/files/init_file.hpp and trace.hpp). At each rising edge at most one vector and one fragment are
-- transferred. Inputs change after the edge. Outputs are sampled at the next edge, as by a register.
--
-- Cycles are numbered from 0, the edge at which the first vector is taken. If g_stall_seed is not 0, both streams stall
-- at random. sim/engines/verilator/verilator_harness.cpp uses the same pattern, so both simulators give the same cycles.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use std.textio.all;

entity frame_tb is
  generic (
    -- Generics of the shader. Each shader has some of them.
    g_exact              : boolean  := true;
    g_channels           : positive := 3;
    g_degree             : positive := 2;
    g_lights             : natural  := 1;
    g_diffuse            : boolean  := true;
    g_specular           : boolean  := true;
    g_highlight_channels : positive := 1;
    g_powers             : natural  := 2;
    g_cosine             : work.cosine_pkg.cosine_t := work.cosine_pkg.default_cosine(true);
    g_directional        : natural  := 1;
    g_positional         : natural  := 0;
    g_spots              : natural  := 0;
    g_normalize          : boolean  := true;
    g_shadows            : boolean  := false;
    g_unrolled           : boolean  := true;
    g_objects            : positive := 1;
    g_subpixels          : positive := 1;

    g_init_file     : string   := "init.txt";
    g_trace_file    : string   := "trace.txt";
    g_max_fragments : natural  := natural'high;  -- a run with more fragments fails
    g_idle_limit    : positive := 100_000;       -- cycles without a transfer that count as a hang
    g_stall_seed    : natural  := 0              -- 0: full speed
  );
end entity;

architecture sim of frame_tb is
  constant c_init_bits : positive := work.formats_pkg.init_bits(g_exact, g_channels);

  constant c_late_cycles : positive := 8; -- by which fault may be late

  signal clk               : std_logic := '0';
  signal reset             : std_logic := '1';
  signal init_valid        : std_logic := '0';
  signal init_ready        : std_logic;
  signal init_data         : std_logic_vector(c_init_bits - 1 downto 0) := (others => '0');
  signal fragment_valid    : std_logic;
  signal fragment_ready    : std_logic := '0';
  signal fragment_triangle : std_logic_vector(31 downto 0);
  signal fragment_y        : std_logic_vector(11 downto 0);
  signal fragment_x        : std_logic_vector(11 downto 0);
  signal fragment_z        : std_logic_vector(23 downto 0);
  signal fragment_red      : std_logic_vector(7 downto 0);
  signal fragment_green    : std_logic_vector(7 downto 0);
  signal fragment_blue     : std_logic_vector(7 downto 0);
  signal busy              : std_logic;
  signal fault             : std_logic;
  signal finished          : boolean := false;

  -- A line of text. These procedures build it in the time that textio's write and hread take for one digit.
  type text_t is record
    letters : string(1 to 80); -- a fragment's seven fields need at most 42
    length  : natural;
  end record;

  procedure put (word : inout text_t; letter : in character) is
  begin
    word.length               := word.length + 1;
    word.letters(word.length) := letter;
  end procedure;

  -- Append an unsigned number of up to 32 bits in decimal. A natural has only 31 bits.
  procedure put_decimal (word : inout text_t; value : in std_logic_vector) is
    alias bits      : std_logic_vector(value'length - 1 downto 0) is value;
    variable digits : string(1 to 10);
    variable first  : positive := digits'right;
    variable high   : natural  := 0; -- value / 2**16
    variable low    : natural  := 0;
    variable tens   : natural;
  begin
    for i in bits'range loop
      if i >= 16 then
        high := high + high;
        if bits(i) = '1' then
          high := high + 1;
        end if;
      else
        low := low + low;
        if bits(i) = '1' then
          low := low + 1;
        end if;
      end if;
    end loop;
    low           := low + 6 * high; -- 2**16 = 6553 * 10 + 6
    tens          := 6553 * high + low / 10;
    digits(first) := character'val(character'pos('0') + low mod 10);
    while tens > 0 loop
      first         := first - 1;
      digits(first) := character'val(character'pos('0') + tens mod 10);
      tens          := tens / 10;
    end loop;
    word.letters(word.length + 1 to word.length + digits'right - first + 1) := digits(first to digits'right);
    word.length                                                             := word.length + digits'right - first + 1;
  end procedure;

  -- Read a value. It has as many hexadecimal digits as its width needs. `good`: all of them are hexadecimal digits.
  procedure get_hexadecimal (text : inout line; value : out std_logic_vector; good : out boolean) is
    alias bits     : std_logic_vector(value'length - 1 downto 0) is value;
    variable digit : natural;
    variable low   : natural := 0;
  begin
    good := true;
    for i in text'reverse_range loop
      case text(i) is
        when '0' to '9' =>
          digit := character'pos(text(i)) - character'pos('0');
        when 'a' to 'f' =>
          digit := character'pos(text(i)) - character'pos('a') + 10;
        when 'A' to 'F' =>
          digit := character'pos(text(i)) - character'pos('A') + 10;
        when others =>
          good := false;
          return;
      end case;
      for place in 0 to 3 loop
        if low < bits'length then
          if digit mod 2 = 1 then
            bits(low) := '1';
          else
            bits(low) := '0';
          end if;
        elsif digit mod 2 = 1 then
          good := false; -- a bit beyond the value's width is set
        end if;
        digit := digit / 2;
        low   := low + 1;
      end loop;
    end loop;
  end procedure;

  -- xorshift32 (Marsaglia 2003, shifts 13, 17, 5)
  function next_random(state : unsigned(31 downto 0)) return unsigned is
    variable x : unsigned(31 downto 0) := state;
  begin
    x := x xor shift_left(x, 13);
    x := x xor shift_right(x, 17);
    x := x xor shift_left(x, 5);
    return x;
  end function;
begin
  dut : entity work.quadratic_shader
    generic map (g_exact => g_exact, g_channels => g_channels)
    port map (
      clk               => clk,
      reset             => reset,
      init_valid        => init_valid,
      init_ready        => init_ready,
      init_data         => init_data,
      fragment_valid    => fragment_valid,
      fragment_ready    => fragment_ready,
      fragment_triangle => fragment_triangle,
      fragment_y        => fragment_y,
      fragment_x        => fragment_x,
      fragment_z        => fragment_z,
      fragment_red      => fragment_red,
      fragment_green    => fragment_green,
      fragment_blue     => fragment_blue,
      busy              => busy,
      fault             => fault);

  clock : process is
  begin
    while not finished loop
      wait for 5 ns;
      clk <= '1';
      wait for 5 ns;
      clk <= '0';
    end loop;
    wait;
  end process;

  run : process is
    file init_file  : text;
    file trace_file : text;

    variable status      : file_open_status;
    variable text_in     : line;
    variable text_out    : line;
    variable fragment    : text_t;
    variable field       : string(1 to 13);
    variable number      : integer;
    variable letter      : character;
    variable good        : boolean;
    variable vector      : std_logic_vector(c_init_bits - 1 downto 0);
    variable at_end      : boolean := false;   -- of the init file
    variable offered     : boolean := false;   -- init_valid stays until the vector is taken
    variable started     : boolean := false;
    variable vectors     : natural := 0;
    variable fragments   : natural := 0;
    variable cycle       : natural := 0;
    variable last_cycle  : natural := 0;
    variable idle        : natural := 0;
    variable moved       : boolean;
    variable random      : unsigned(31 downto 0) := to_unsigned(g_stall_seed, 32);
    variable payload     : std_logic_vector(103 downto 0);
    variable held        : std_logic_vector(103 downto 0);
    variable holding     : boolean := false;   -- the fragment at the last edge was not taken

    procedure check_fault is
    begin
      if fault /= '0' then
        report "the hardware refused a vector, by cycle " & to_string(cycle) & ": fault is " & to_string(fault)
          severity failure;
      end if;
    end procedure;

    procedure next_vector is
    begin
      if endfile(init_file) then
        report g_init_file & ": ends without its last line, end <count>" severity failure;
      end if;
      readline(init_file, text_in);
      if text_in'length > 4 and text_in(text_in'left to text_in'left + 3) = "end " then
        read(text_in, field(1 to 4));
        read(text_in, number, good);
        if not good or number /= vectors then
          report g_init_file & ": the last line does not give the number of vectors, " & to_string(vectors)
            severity failure;
        end if;
        at_end := true;
      else
        if text_in'length /= (c_init_bits + 3) / 4 then
          report g_init_file & ": vector " & to_string(vectors) & " has not " & to_string((c_init_bits + 3) / 4)
            & " digits" severity failure;
        end if;
        get_hexadecimal(text_in, vector, good);
        if not good then
          report g_init_file & ": vector " & to_string(vectors) & " is no hexadecimal number of "
            & to_string(c_init_bits) & " bits" severity failure;
        end if;
        vectors := vectors + 1;
        -- Assign once per vector, not once per clock: the simulator's time grows with every bit assigned.
        init_data <= vector;
      end if;
    end procedure;

    procedure drive is
    begin
      if g_stall_seed /= 0 then
        random := next_random(random);
        if random(0) = '1' then
          fragment_ready <= '1';
        else
          fragment_ready <= '0';
        end if;
        offered := not at_end and (offered or random(1) = '1');
      else
        fragment_ready <= '1';
        offered        := not at_end;
      end if;
      if offered then
        init_valid <= '1';
      else
        init_valid <= '0';
      end if;
    end procedure;
  begin
    -- Read the header: halfway-init 1 <key name> <bits>. The trace gets the same key name.
    file_open(status, init_file, g_init_file, read_mode);
    if status /= open_ok then
      report g_init_file & ": cannot open" severity failure;
    end if;
    if endfile(init_file) then
      report g_init_file & ": is empty" severity failure;
    end if;
    readline(init_file, text_in);
    read(text_in, field(1 to 13), good);
    if not good or field /= "halfway-init " then
      report g_init_file & ": is no init file" severity failure;
    end if;
    read(text_in, number, good);
    if not good or number /= 1 or text_in'length < 2 then
      report g_init_file & ": is an init file of another version" severity failure;
    end if;
    file_open(status, trace_file, g_trace_file, write_mode);
    if status /= open_ok then
      report g_trace_file & ": cannot write" severity failure;
    end if;
    write(text_out, string'("halfway-trace 1"));
    read(text_in, letter, good);  -- the space before the name
    loop
      write(text_out, letter);
      read(text_in, letter, good);
      exit when not good or letter = ' ';
    end loop;
    writeline(trace_file, text_out);
    read(text_in, number, good);
    if not good or number /= c_init_bits then
      report g_init_file & ": its vectors are not of " & to_string(c_init_bits) & " bits" severity failure;
    end if;

    reset <= '1';
    for i in 1 to 4 loop
      wait until rising_edge(clk);
    end loop;
    reset <= '0';
    next_vector;
    drive;

    loop
      wait until rising_edge(clk);
      moved := false;
      if is_x(init_ready) or is_x(fragment_valid) or is_x(busy) then
        report "metavalue in init_ready, fragment_valid or busy in cycle " & to_string(cycle) severity failure;
      end if;
      check_fault;
      if init_valid = '1' and init_ready = '1' then
        moved   := true;
        started := true;
        offered := false;
        next_vector;
      end if;
      if fragment_valid = '1' then
        payload := fragment_triangle & fragment_y & fragment_x & fragment_z & fragment_red & fragment_green
          & fragment_blue;
        if is_x(payload) then
          report "metavalue in fragment " & to_string(fragments) & " in cycle " & to_string(cycle) & ": "
            & to_string(payload) severity failure;
        end if;
        if holding and payload /= held then
          report "fragment " & to_string(fragments) & " changed while it was not taken, in cycle "
            & to_string(cycle) severity failure;
        end if;
        held := payload;
        if fragment_ready = '1' then
          if fragments = g_max_fragments then
            report "more than " & to_string(g_max_fragments) & " fragments" severity failure;
          end if;
          moved     := true;
          fragments := fragments + 1;
          fragment.length := 0;
          put_decimal(fragment, fragment_triangle);
          put(fragment, ' ');
          put_decimal(fragment, fragment_y);
          put(fragment, ' ');
          put_decimal(fragment, fragment_x);
          put(fragment, ' ');
          put_decimal(fragment, fragment_z);
          put(fragment, ' ');
          put_decimal(fragment, fragment_red);
          put(fragment, ' ');
          put_decimal(fragment, fragment_green);
          put(fragment, ' ');
          put_decimal(fragment, fragment_blue);
          put(fragment, LF);
          write(trace_file, fragment.letters(1 to fragment.length));
        end if;
      elsif holding then
        report "fragment " & to_string(fragments) & " was withdrawn in cycle " & to_string(cycle) severity failure;
      end if;
      holding := fragment_valid = '1' and fragment_ready = '0';

      if moved then
        last_cycle := cycle;
        idle       := 0;
      else
        idle := idle + 1;
      end if;
      exit when at_end and not offered and busy = '0' and fragment_valid = '0' and not moved;
      if idle >= g_idle_limit then
        report "hang: nothing moved for " & to_string(g_idle_limit) & " cycles after " & to_string(fragments)
          & " fragments; the vectors were " & boolean'image(at_end and not offered) & " all taken, busy is "
          & to_string(busy) severity failure;
      end if;
      if started then
        cycle := cycle + 1;
      end if;
      drive;
    end loop;

    -- Wait for fault: the hardware may set it some clocks after the vector that causes it.
    for i in 1 to c_late_cycles loop
      wait until rising_edge(clk);
      check_fault;
    end loop;

    if started then
      write(text_out, string'("cycles "));
      write(text_out, last_cycle + 1);
    else
      write(text_out, string'("cycles 0"));
    end if;
    writeline(trace_file, text_out);
    write(text_out, string'("end "));
    write(text_out, fragments);
    writeline(trace_file, text_out);
    file_close(trace_file);
    file_close(init_file);
    finished <= true;
    wait;
  end process;
end architecture;
