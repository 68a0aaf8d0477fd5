-- SPDX-License-Identifier: Apache-2.0
-- Every construct that the RTL uses, once each. Each result has a lane of 80 bits. GHDL simulates this text and
-- Verilator GHDL's netlist of it, with the same random stimuli. Every lane must be equal bit for bit. Add a lane here
-- before the RTL uses a new construct.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

package netlist_constructs_pkg is
  constant c_lane     : positive := 80;
  constant c_lanes    : positive := 42;
  constant c_stimulus : positive := 160;

  subtype lane_t is std_logic_vector(c_lane - 1 downto 0);
  type lanes_t is array (0 to c_lanes - 1) of lane_t;

  type format_t is record
    bits     : natural;
    fraction : natural;
  end record;

  type formats_t is record
    narrow : format_t;
    wide   : format_t;
  end record;

  type rom_t is array (0 to 63) of std_logic_vector(8 downto 0);
  type wide_rom_t is array (0 to 15) of std_logic_vector(71 downto 0);
  type table_t is array (natural range <>) of natural;

  function formats (exact : boolean) return formats_t;
  function squares return rom_t;
  function wide_table return wide_rom_t;
  -- Table of 2**address_bits cubes.
  function cubes (address_bits : positive) return table_t;
  -- Signed to unsigned of fewer bits, clamped to the result's range.
  function saturate (value : signed; bits : positive) return std_logic_vector;
  function lane (value : std_logic_vector) return lane_t;  -- zero extended
  function signed_lane (value : signed) return lane_t;     -- sign extended
  function bit_lane (value : boolean) return lane_t;
end package;

package body netlist_constructs_pkg is
  function formats (exact : boolean) return formats_t is
  begin
    if exact then
      return (narrow => (18, 4), wide => (40, 28));
    end if;
    return (narrow => (12, 0), wide => (32, 20));
  end function;

  function squares return rom_t is
    variable table : rom_t;
  begin
    for i in table'range loop
      table(i) := std_logic_vector(to_unsigned((i * i) mod 512, 9));
    end loop;
    return table;
  end function;

  function wide_table return wide_rom_t is
    variable table : wide_rom_t;
  begin
    for i in table'range loop
      table(i) := std_logic_vector(to_unsigned(i * 65_521, 24)) & std_logic_vector(to_signed(-i * 99_991, 24))
        & std_logic_vector(to_unsigned(i * 7919, 24));
    end loop;
    return table;
  end function;

  function cubes (address_bits : positive) return table_t is
    variable table : table_t(0 to 2 ** address_bits - 1);
  begin
    for i in table'range loop
      table(i) := (i * i * i + 5) mod 8191;
    end loop;
    return table;
  end function;

  function saturate (value : signed; bits : positive) return std_logic_vector is
    constant whole  : std_logic_vector(value'length - 1 downto 0)        := std_logic_vector(value);
    constant zeros  : std_logic_vector(value'length - 2 downto bits)     := (others => '0');
    variable result : std_logic_vector(bits - 1 downto 0);
  begin
    if whole(whole'high) = '1' then
      result := (others => '0');
    elsif whole(whole'high - 1 downto bits) /= zeros then
      result := (others => '1');
    else
      result := whole(bits - 1 downto 0);
    end if;
    return result;
  end function;

  function lane (value : std_logic_vector) return lane_t is
  begin
    return std_logic_vector(resize(unsigned(value), c_lane));
  end function;

  function signed_lane (value : signed) return lane_t is
  begin
    return std_logic_vector(resize(value, c_lane));
  end function;

  function bit_lane (value : boolean) return lane_t is
    variable result : lane_t := (others => '0');
  begin
    if value then
      result(0) := '1';
    end if;
    return result;
  end function;
end package body;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;

-- A record register with load and step, used as a component. One field is never assigned.
entity netlist_register is
  generic (
    g_bits : positive
  );
  port (
    clk   : in  std_logic;
    load  : in  std_logic;
    step  : in  std_logic;
    start : in  std_logic_vector(g_bits - 1 downto 0);
    value : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of netlist_register is
  type reg_t is record
    value : signed(g_bits - 1 downto 0);
    unset : std_logic_vector(3 downto 0);
  end record;

  signal r, r_next : reg_t;
begin
  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if load = '1' then
      v.value := signed(start);
    elsif step = '1' then
      v.value := r.value + signed(start);
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  value <= std_logic_vector(r.value);
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.netlist_constructs_pkg.all;

-- A table of numbers converted to words, read into a register, and a register of a product. Each register has its own
-- clocked process.
entity netlist_rom is
  generic (
    g_address_bits : positive;
    g_data_bits    : positive
  );
  port (
    clk     : in  std_logic;
    enable  : in  std_logic;
    address : in  std_logic_vector(g_address_bits - 1 downto 0);
    factor  : in  std_logic_vector(17 downto 0);
    sample  : out std_logic_vector(g_data_bits - 1 downto 0);
    product : out std_logic_vector(g_data_bits + 17 downto 0)
  );
end entity;

architecture rtl of netlist_rom is
  type rom_t is array (0 to 2 ** g_address_bits - 1) of std_logic_vector(g_data_bits - 1 downto 0);

  function entries return rom_t is
    constant c_table : table_t := cubes(g_address_bits);

    variable rom : rom_t;
  begin
    for i in rom'range loop
      rom(i) := std_logic_vector(to_unsigned(c_table(i), g_data_bits));
    end loop;
    return rom;
  end function;

  constant c_rom : rom_t := entries;

  type reg_t is record
    sample  : std_logic_vector(g_data_bits - 1 downto 0);
    product : unsigned(g_data_bits + 17 downto 0);
  end record;

  signal r : reg_t;
begin
  samples : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        r.sample <= c_rom(to_integer(unsigned(address)));
      end if;
    end if;
  end process;

  products : process (clk)
  begin
    if rising_edge(clk) then
      if enable = '1' then
        r.product <= unsigned(r.sample) * unsigned(factor);
      end if;
    end if;
  end process;

  sample  <= r.sample;
  product <= std_logic_vector(r.product);
end architecture;

library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.netlist_constructs_pkg.all;

entity netlist_constructs is
  generic (
    g_exact : boolean  := true;
    g_count : positive := 3
  );
  port (
    clk      : in  std_logic;
    reset    : in  std_logic;
    stimulus : in  std_logic_vector(c_stimulus - 1 downto 0);
    response : out std_logic_vector(c_lanes * c_lane - 1 downto 0)
  );
end entity;

architecture rtl of netlist_constructs is
  constant c_formats    : formats_t := formats(g_exact);
  constant c_narrow     : positive  := c_formats.narrow.bits;
  constant c_wide       : positive  := c_formats.wide.bits;
  constant c_rom        : rom_t     := squares;
  constant c_wide_rom   : wide_rom_t := wide_table;
  constant c_wide_value : unsigned(71 downto 0) := x"f0123456789abcdef1";
  constant c_mid_value  : signed(39 downto 0)   := x"8000000001";
  constant c_ones       : std_logic_vector(71 downto 0) := (others => '1');

  type state_t is (idle, loading, drawing, last);
  type section_t is record
    count : unsigned(12 downto 0);
    value : signed(17 downto 0);
  end record;
  type reg_t is record
    state   : state_t;
    valid   : std_logic;
    upper   : section_t;
    lower   : section_t;
    payload : std_logic_vector(71 downto 0);
    flag    : std_logic;
  end record;
  type bytes_t is array (0 to 3) of std_logic_vector(7 downto 0);
  type terms_t is array (0 to 1) of std_logic_vector(5 * 13 - 1 downto 0);
  type sums_t is array (0 to 1) of unsigned(15 downto 0);

  -- A record that is packed to a word.
  type fields_t is record
    number : std_logic_vector(c_narrow - 1 downto 0);
    byte_1 : std_logic_vector(7 downto 0);
    flag   : std_logic_vector(0 downto 0);
  end record;
  subtype word_t is std_logic_vector(c_narrow + 8 downto 0);

  function packed (fields : fields_t) return word_t is
  begin
    return fields.flag & fields.byte_1 & fields.number;
  end function;

  function unpacked (word : word_t) return fields_t is
    variable fields : fields_t;
  begin
    (fields.flag, fields.byte_1, fields.number) := word;
    return fields;
  end function;

  signal r, r_next : reg_t;
  signal lanes     : lanes_t;
  signal fields    : fields_t;
  signal upper     : std_logic_vector(71 downto 29); -- a range whose lowest index is not 0
  signal a, b      : std_logic_vector(71 downto 0);
  signal control   : std_logic_vector(15 downto 0);
  signal sa, sb    : signed(71 downto 0);
  signal ua, ub    : unsigned(71 downto 0);
  signal na, nb    : signed(c_narrow - 1 downto 0);
  signal wa, wb    : signed(c_wide - 1 downto 0);
  signal shifted   : signed(71 downto 0);
  signal counter   : unsigned(7 downto 0);
  signal kept      : std_logic_vector(7 downto 0);
  signal held      : std_logic_vector(4 * 20 - 1 downto 0);
  signal bytes     : bytes_t;
  signal step      : std_logic;
  signal mux       : std_logic_vector(71 downto 0);
  signal by_case   : std_logic_vector(39 downto 0);
  signal read      : std_logic;
  signal sample    : std_logic_vector(12 downto 0);
  signal product   : std_logic_vector(30 downto 0);
  signal terms     : terms_t;
  signal sums      : sums_t;
  signal magnitude : std_logic_vector(32 downto 0);
  signal chosen    : std_logic_vector(7 downto 0);
begin
  control <= stimulus(15 downto 0);
  a       <= stimulus(87 downto 16);
  b       <= stimulus(159 downto 88);
  sa      <= signed(a);
  sb      <= signed(b);
  ua      <= unsigned(a);
  ub      <= unsigned(b);
  na      <= signed(a(c_narrow - 1 downto 0));
  nb      <= signed(b(c_narrow - 1 downto 0));
  wa      <= signed(a(c_wide - 1 downto 0));
  wb      <= signed(b(c_wide - 1 downto 0));

  -- Wrapping sums and products of 12 to 72 bits.
  lanes(0) <= lane(std_logic_vector(ua + ub));
  lanes(1) <= signed_lane(sa - sb);
  lanes(2) <= signed_lane(na + nb);
  lanes(3) <= signed_lane(resize(na, c_narrow + 1) + resize(nb, c_narrow + 1));
  lanes(4) <= signed_lane(na * nb);
  lanes(5) <= lane(std_logic_vector(ua(35 downto 0) * ub(35 downto 0)));
  lanes(6) <= signed_lane(sa(39 downto 0) * nb);
  lanes(7) <= signed_lane(resize(na, 40) + wa(31 downto 0));
  lanes(8) <= signed_lane(-wa);
  lanes(9) <= signed_lane(wa + 1);
  lanes(10) <= lane(std_logic_vector(ua + c_wide_value));
  lanes(11) <= signed_lane(sa(39 downto 0) - c_mid_value);

  -- Comparisons.
  lanes(12) <= bit_lane(sa < sb);
  lanes(13) <= bit_lane(ua <= ub);
  lanes(14) <= bit_lane(na >= nb) or (lane(control(0 downto 0)) xor bit_lane(na > nb));
  lanes(15) <= bit_lane(ua < c_wide_value);
  lanes(16) <= bit_lane(a(3 downto 0) = b(3 downto 0)) xor bit_lane(a = c_ones);
  lanes(17) <= bit_lane(sa(39 downto 0) <= c_mid_value) xor bit_lane(unsigned(a(12 downto 0)) = 1);
  lanes(18) <= bit_lane(na < -3) xor bit_lane(nb /= 0);

  -- Slices, concatenations, an arithmetic shift right by sign bits and a slice, widening.
  shifted   <= (71 downto 67 => sa(71)) & sa(71 downto 5);
  lanes(19) <= signed_lane(shifted);
  lanes(20) <= lane(a(17 downto 3) & b(71 downto 40) & control(4) & "101");
  lanes(21) <= signed_lane(shift_left(wa, 3));
  lanes(22) <= lane(std_logic_vector(shift_right(ua, 7)));
  lanes(23) <= lane(std_logic_vector(resize(wa(c_wide - 1 downto c_formats.narrow.fraction), 64)));
  lanes(24) <= lane(std_logic_vector(wa(c_narrow - 1 downto 0)));

  -- Multiplexers.
  lanes(25) <= lane(a) when control(0) = '1' else
    lane(b) when control(2 downto 1) = "10" else
    lane(std_logic_vector(c_wide_value));

  choose : process (all)
  begin
    mux <= a and not b;
    if control(3) = '1' then
      mux <= b xor a;
      if control(4) = '0' and sa < 0 then
        mux <= (others => '1');
      end if;
    elsif control(5) = '1' or control(6) = '1' then
      mux(35 downto 0) <= b(71 downto 36);
    end if;
    case control(9 downto 8) is
      when "00" =>
        by_case <= x"123456789a";
      when "01" =>
        by_case <= a(39 downto 0);
      when "10" =>
        by_case <= std_logic_vector(c_mid_value);
      when "11" =>
        by_case <= b(71 downto 32);
      when others =>
        by_case <= (others => 'X');
    end case;
  end process;
  lanes(26) <= lane(mux);
  lanes(27) <= lane(by_case);

  -- Tables with an index, saturation.
  lanes(28) <= lane(c_rom(to_integer(unsigned(a(5 downto 0)))));
  lanes(29) <= lane(c_wide_rom(to_integer(unsigned(b(70 downto 67)))));
  lanes(30) <= lane(saturate(wa(c_wide - 1 downto c_formats.wide.fraction), 8) & saturate(nb, 8)
    & saturate(sa, 40));

  -- A register of records with a state machine, in two processes.
  combinational : process (all)
    variable v : reg_t;
  begin
    v    := r;
    step <= '0';
    case r.state is
      when idle =>
        if control(0) = '1' then
          v.state   := loading;
          v.payload := a;
          v.upper   := (count => unsigned(b(12 downto 0)), value => signed(b(40 downto 23)));
        end if;
      when loading =>
        v.lower       := r.upper;
        v.lower.count := r.upper.count - 1;
        v.state       := drawing;
        v.valid       := '1';
      when drawing =>
        step          <= '1';
        v.lower.value := r.lower.value + r.upper.value;
        v.flag        := not r.flag;
        if r.lower.count < 4096 or control(7 downto 5) = "111" then
          v.state := last;
        elsif control(1) = '1' then
          v.lower.count := r.lower.count - resize(unsigned(control(3 downto 2)), 13);
        end if;
      when last =>
        v.valid := '0';
        if control(2) = '1' then
          v.state := idle;
        end if;
    end case;
    if reset = '1' then
      v.state := idle;
      v.valid := '0';
      v.flag  := '0';
      v.upper := (count => (others => '0'), value => (others => '0'));
      v.lower := (count => (others => '0'), value => (others => '0'));
      v.payload := (others => '0');
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;
  lanes(31) <= lane(r.payload);
  lanes(32) <= lane(std_logic_vector(r.lower.count) & std_logic_vector(r.lower.value)
    & std_logic_vector(r.upper.count) & r.valid & r.flag & step);

  -- A counter with wrap and enable, a generate loop of instances, an array assigned by a loop.
  count : process (clk)
  begin
    if rising_edge(clk) then
      if reset = '1' then
        counter <= (others => '0');
      elsif control(10) = '1' then
        counter <= counter + 1;
      end if;
      if control(14) = '1' and reset = '0' then
        kept <= kept;
      else
        kept <= a(47 downto 40);
      end if;
    end if;
  end process;

  instances : for i in 0 to 3 generate
    present : if i < g_count generate
      signal load : std_logic;
      begin
        load <= '1' when control(12 downto 11) = std_logic_vector(to_unsigned(i, 2)) or reset = '1' else '0';

        held_value : entity work.netlist_register
          generic map (
            g_bits => 20
            )
          port map (
            clk   => clk,
            load  => load,
            step  => control(13),
            start => a(i * 9 + 19 downto i * 9),
            value => held(i * 20 + 19 downto i * 20)
            );
    else generate
      held(i * 20 + 19 downto i * 20) <= (others => '0');
    end generate;
  end generate;
  lanes(33) <= held;

  pack : process (all)
  begin
    for i in bytes'range loop
      bytes(i) <= a(i * 8 + 7 downto i * 8);
      if i >= g_count then
        bytes(i) <= (others => '0');
      end if;
    end loop;
  end process;
  lanes(34) <= lane(bytes(0) & bytes(1) & bytes(2) & bytes(3) & std_logic_vector(counter) & kept);

  exact_only : if g_exact generate
    lanes(35) <= lane(std_logic_vector(to_signed(-5, 40)) & x"dead");
  else generate
    lanes(35) <= lane(std_logic_vector(resize(unsigned(control), 40) + 12345));
  end generate;

  -- A table and a multiplier after registers with an enable.
  read <= control(15) or reset;

  numbers : entity work.netlist_rom
    generic map (
      g_address_bits => 9,
      g_data_bits    => 13
      )
    port map (
      clk     => clk,
      enable  => read,
      address => a(8 downto 0),
      factor  => b(17 downto 0),
      sample  => sample,
      product => product
      );
  lanes(36) <= lane(product & sample);

  -- Slices of array elements assigned by generates and padded by an aggregate; sums of all elements by a loop.
  two_sums : for i in terms'range generate
    terms(i)(12 downto 0) <= a(i * 9 + 7 downto i * 9) & (4 downto 0 => '0');

    others_of_it : for k in 1 to 4 generate
      terms(i)(k * 13 + 12 downto k * 13) <= b(i * boolean'pos(g_exact) * 7 + k * 11 + 12 downto i
        * boolean'pos(g_exact) * 7 + k * 11);
    end generate;

    add : process (all)
      variable v : unsigned(15 downto 0);
    begin
      v := resize(unsigned(terms(i)(12 downto 0)), 16);
      for k in 1 to 4 loop
        v := v + resize(unsigned(terms(i)((k + 1) * 13 - 1 downto k * 13)), 16);
      end loop;
      sums(i) <= v;
    end process;
  end generate;
  lanes(37) <= lane(std_logic_vector(sums(1)) & std_logic_vector(sums(0)));

  -- Ones' complement by the sign; a slice compared with zero; selection of one element by its number, zero if out of
  -- range.
  magnitude <= not a(32 downto 0) when a(32) = '1' else a(32 downto 0);
  lanes(38) <= lane(magnitude(21 downto 13)) xor bit_lane(magnitude(32 downto 22) = (32 downto 22 => '0'));

  select_byte : process (all)
  begin
    chosen <= (others => '0');
    for i in bytes'range loop
      if unsigned(control(2 downto 0)) = i then
        chosen <= bytes(i);
      end if;
    end loop;
  end process;
  lanes(39) <= lane(chosen);

  -- A word unpacked by an aggregate and packed in another order; slices of a range whose lowest index is not 0.
  fields <= unpacked(a(word_t'range));
  lanes(40) <= lane(packed((fields.number, fields.byte_1, fields.flag)) & fields.number & fields.byte_1);
  upper <= b(upper'range);
  lanes(41) <= lane(upper(71 downto 60) & upper(40 downto 29));

  outputs : for i in lanes'range generate
    response((i + 1) * c_lane - 1 downto i * c_lane) <= lanes(i);
  end generate;
end architecture;
