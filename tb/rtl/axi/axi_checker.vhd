-- SPDX-License-Identifier: Apache-2.0
-- Drives an AXI4-Stream top and compares every fragment with the golden model, in order, on the vectors of the shader:
-- each set is a frame. tlast must come with the frame's last fragment and with no other transfer. Frames without
-- fragments and faulty frames are drawn between them. At full speed each fragment must come in the clock that the header
-- promises. Other passes have random stalls at both ends, or a reset in the middle.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.formats_pkg.all;
use work.processors_pkg.all;
use work.tb_pkg.all;
use work.tb_shaders_pkg.all;

entity axi_checker is
  generic (
    g_hardware   : hardware_t;
    g_timed      : boolean  := true;  -- the files contain the clocks
    g_limit_bits : positive := 13;    -- of the top
    g_faults     : boolean  := false; -- only the set "fault", in which the shader reports a fault, between good frames
    g_stem       : string             -- start of the file names
  );
end entity;

architecture sim of axi_checker is
  constant c_formats   : formats_t := formats(g_hardware.exact);
  constant c_init_bits : positive  := init_bits(g_hardware);
  constant c_records   : natural   := boolean'pos(has_records(g_hardware)); -- of a triangle of one line

  -- Lowest bit of the walk in a vector that draws.
  function find_walk return natural is
  begin
    if g_hardware.shader = processors then
      return walk_low(processors_config(g_hardware));
    end if;
    return 0;
  end function;

  constant c_walk_low   : natural  := find_walk;
  constant c_idle_limit : positive := 3 * 2 ** g_limit_bits; -- clocks without a transfer that count as a hang
  constant c_end_clocks : positive := 10; -- from the last fragment's clock in the shader to its transfer

  type frame_t is (draws, empty, too_long, faulty);

  signal ended                  : boolean := false;
  signal aclk                   : std_logic := '0';
  signal aresetn, s_axis_tvalid : std_logic := '0';
  signal s_axis_tready          : std_logic;
  signal s_axis_tdata           : std_logic_vector(whole_words(c_init_bits) - 1 downto 0);
  signal s_axis_tlast           : std_logic := '0';
  signal m_axis_tvalid          : std_logic;
  signal m_axis_tready          : std_logic := '0';
  signal m_axis_tdata           : fragment_data_t;
  signal m_axis_tkeep           : fragment_keep_t;
  signal m_axis_tlast, fault    : std_logic;
begin
  quadratic_dut : if g_hardware.shader = quadratic generate
    dut : entity work.quadratic_axi
      generic map (
        g_exact      => g_hardware.exact,
        g_channels   => g_hardware.channels,
        g_degree     => g_hardware.degree,
        g_limit_bits => g_limit_bits)
      port map (
        aclk          => aclk,
        aresetn       => aresetn,
        s_axis_tvalid => s_axis_tvalid,
        s_axis_tready => s_axis_tready,
        s_axis_tdata  => s_axis_tdata,
        s_axis_tlast  => s_axis_tlast,
        m_axis_tvalid => m_axis_tvalid,
        m_axis_tready => m_axis_tready,
        m_axis_tdata  => m_axis_tdata,
        m_axis_tkeep  => m_axis_tkeep,
        m_axis_tlast  => m_axis_tlast,
        fault         => fault);
  end generate;

  spherical_dut : if g_hardware.shader = spherical generate
    dut : entity work.spherical_axi
      generic map (
        g_exact              => g_hardware.exact,
        g_channels           => g_hardware.channels,
        g_lights             => g_hardware.lights,
        g_diffuse            => g_hardware.diffuse,
        g_specular           => g_hardware.specular,
        g_highlight_channels => g_hardware.highlight_channels,
        g_powers             => g_hardware.powers,
        g_address_bits       => g_hardware.address_bits,
        g_data_bits          => g_hardware.data_bits,
        g_limit_bits         => g_limit_bits)
      port map (
        aclk          => aclk,
        aresetn       => aresetn,
        s_axis_tvalid => s_axis_tvalid,
        s_axis_tready => s_axis_tready,
        s_axis_tdata  => s_axis_tdata,
        s_axis_tlast  => s_axis_tlast,
        m_axis_tvalid => m_axis_tvalid,
        m_axis_tready => m_axis_tready,
        m_axis_tdata  => m_axis_tdata,
        m_axis_tkeep  => m_axis_tkeep,
        m_axis_tlast  => m_axis_tlast,
        fault         => fault);
  end generate;

  processors_dut : if g_hardware.shader = processors generate
    dut : entity work.processors_axi
      generic map (
        g_exact       => g_hardware.exact,
        g_channels    => g_hardware.channels,
        g_directional => g_hardware.directional,
        g_positional  => g_hardware.positional,
        g_spots       => g_hardware.spots,
        g_diffuse     => g_hardware.diffuse,
        g_specular    => g_hardware.specular,
        g_normalize   => g_hardware.normalize,
        g_shadows     => g_hardware.shadows,
        g_unrolled    => g_hardware.unrolled,
        g_objects     => g_hardware.objects,
        g_subpixels   => g_hardware.subpixels,
        g_limit_bits  => g_limit_bits)
      port map (
        aclk          => aclk,
        aresetn       => aresetn,
        s_axis_tvalid => s_axis_tvalid,
        s_axis_tready => s_axis_tready,
        s_axis_tdata  => s_axis_tdata,
        s_axis_tlast  => s_axis_tlast,
        m_axis_tvalid => m_axis_tvalid,
        m_axis_tready => m_axis_tready,
        m_axis_tdata  => m_axis_tdata,
        m_axis_tkeep  => m_axis_tkeep,
        m_axis_tlast  => m_axis_tlast,
        fault         => fault);
  end generate;

  aclk <= not aclk after c_half_period when not ended;

  run : process is
    variable inits, fragments : vectors_t;

    -- Vectors of frames without a set: number still to come. The vector after the one that is offered.
    variable vectors  : natural;
    variable more     : boolean;
    variable next_one : std_logic_vector(c_init_bits - 1 downto 0);

    -- The fragment that comes next, the one after it, and the clock of the transfer of the first.
    variable fragment, next_fragment : fragment_data_t;
    variable there, next_there       : boolean;
    variable due                     : natural;
    variable shader_clock            : natural; -- of the fragment that was read last

    procedure check (name : string; got, expected : std_logic_vector) is
    begin
      if got /= expected then
        fragments.fail(name & " is " & to_hstring(got) & ", expected " & to_hstring(expected));
      end if;
    end procedure;

    procedure check (name : string; got, expected : std_logic) is
    begin
      assert got = expected
        report g_stem & ": " & name & " is " & to_string(got) & ", expected " & to_string(expected) severity failure;
    end procedure;

    -- The next fragment of the file as a transfer. Its fields are in the order of the file.
    procedure read_fragment (data : out fragment_data_t; found : out boolean) is
      variable triangle         : std_logic_vector(c_formats.triangle.bits - 1 downto 0);
      variable y                : std_logic_vector(c_formats.pixel_y.bits - 1 downto 0);
      variable x                : std_logic_vector(c_formats.pixel_x.bits - 1 downto 0);
      variable z                : std_logic_vector(c_formats.depth.bits - 1 downto 0);
      variable red, green, blue : std_logic_vector(c_formats.colour.bits - 1 downto 0);
    begin
      found := fragments.next_vector;
      data  := (others => '0');
      if found then
        fragments.read_word(triangle);
        fragments.read_word(y);
        fragments.read_word(x);
        fragments.read_word(z);
        fragments.read_word(red);
        fragments.read_word(green);
        fragments.read_word(blue);
        shader_clock := fragments.read_number;
        data := x"00" & blue & green & red & triangle & x"00" & z & x"0" & y & x"0" & x;
      end if;
    end procedure;

    -- Reads one vector ahead, because tlast comes with the last one.
    procedure read_vector (kind : frame_t) is
    begin
      if kind = draws or kind = faulty then
        more := inits.next_vector;
        if more then
          inits.read_word(next_one);
        end if;
      else
        more     := vectors > 0;
        next_one := (others => '0');
        if g_hardware.shader = processors then
          next_one(request_header(g_hardware.exact).command.low) := '1'; -- new_object
        end if;
        -- Upper lines: 0 counts as 2**13.
        if kind = empty then
          next_one(c_walk_low + init_header(true).upper_lines.low) := '1';
        else
          next_one(c_walk_low + init_header(true).lower_lines.high downto c_walk_low + init_header(true).lower_lines.low)
            := (others => '1');
        end if;
        if vectors > 0 then
          vectors := vectors - 1;
        end if;
      end if;
    end procedure;

    -- Reads one fragment ahead: it gives the clock in which the fragment before it comes.
    procedure read_ahead is
    begin
      fragment := next_fragment;
      there    := next_there;
      if there then
        due := shader_clock + c_end_clocks;
        read_fragment(next_fragment, next_there);
        if next_there then
          due := shader_clock + 1;
        end if;
      end if;
    end procedure;

    -- One frame: draws: the set's vectors; empty: a triangle without pixels; too_long: triangles that take longer than
    -- the top allows; faulty: a set in which the shader reports a fault. With stalls, a vector is offered in one of
    -- 2**init_pause clocks, and tready is '1' in one of 2**fragment_pause. The pass ends with a reset in clock reset_at;
    -- 0: no reset.
    procedure pass (kind : frame_t; set : string; seed, init_pause, fragment_pause, reset_at : natural) is
      constant c_full   : boolean   := init_pause = 0 and fragment_pause = 0;
      constant c_faulty : std_logic := to_flag(kind = too_long or kind = faulty);

      variable random             : unsigned(31 downto 0) := to_unsigned(seed, 32);
      variable vector             : std_logic_vector(c_init_bits - 1 downto 0);
      variable to_come            : boolean; -- the vector
      variable offered, waiting   : boolean := false;
      variable held               : std_logic_vector(c_fragment_bits downto 0); -- tlast, tdata
      variable clock              : integer := -1; -- 0: the first vector is taken
      variable ticks, idle, taken : natural := 0;
    begin
      if kind = draws or kind = faulty then
        inits.open_file(g_stem & set & "_init.txt");
      elsif kind = empty then
        vectors := 1 + c_records;
      else
        vectors := 4;
      end if;
      there := false;
      read_vector(kind);
      to_come := more;
      vector  := next_one;
      read_vector(kind);
      if kind = draws then
        fragments.open_file(g_stem & set & "_fragments.txt");
        read_fragment(next_fragment, next_there);
        read_ahead;
      end if;

      loop
        random  := next_random(random);
        offered := to_come and (offered or chance(random(19 downto 12), init_pause));
        s_axis_tvalid <= to_flag(offered);
        s_axis_tdata  <= (others => '1');
        s_axis_tlast  <= '1';
        if offered then
          s_axis_tdata(c_init_bits - 1 downto 0) <= vector;
          s_axis_tlast               <= to_flag(not more);
        end if;
        m_axis_tready <= to_flag(chance(random(30 downto 23), fragment_pause));
        ticks   := ticks + 1;
        aresetn <= to_flag(ticks /= reset_at);
        wait until rising_edge(aclk);
        exit when ticks = reset_at;
        if clock >= 0 or (s_axis_tvalid = '1' and s_axis_tready = '1') then
          clock := clock + 1;
        end if;
        idle := idle + 1;

        if kind = draws or kind = empty then
          check("fault", fault, '0');
        end if;
        if waiting then
          check("m_axis_tvalid of a transfer that is not taken", m_axis_tvalid, '1');
          check("a transfer that waits", m_axis_tlast & m_axis_tdata, held);
        elsif m_axis_tvalid = '1' and kind = draws then
          assert there report g_stem & set & ": a transfer after the frame's last fragment" severity failure;
          check("tdata", m_axis_tdata, fragment);
          check("tkeep", m_axis_tkeep, (m_axis_tkeep'range => '1'));
          check("tlast", m_axis_tlast, to_flag(not next_there));
          if c_full and g_timed and clock /= due then
            fragments.fail("comes in clock " & to_string(clock) & ", expected " & to_string(due));
          end if;
          read_ahead;
        end if;
        held    := m_axis_tlast & m_axis_tdata;
        waiting := m_axis_tvalid = '1' and m_axis_tready = '0';
        if m_axis_tvalid = '1' and m_axis_tready = '1' then
          idle := 0;
          if kind = empty or kind = too_long then
            check("tkeep of a frame without fragments", m_axis_tkeep, (m_axis_tkeep'range => '0'));
            check("tlast of a frame without fragments", m_axis_tlast, '1');
          end if;
          if m_axis_tlast = '1' then
            check("fault at tlast", fault, c_faulty);
            exit;
          end if;
        end if;

        if s_axis_tvalid = '1' and s_axis_tready = '1' then
          offered := false;
          taken   := taken + 1;
          to_come := more;
          vector  := next_one;
          if more then
            read_vector(kind);
          end if;
          idle := 0;
        end if;
        assert idle < c_idle_limit
          report g_stem & set & ": no transfer for " & to_string(c_idle_limit) & " clocks after " & to_string(taken)
          & " vectors"
          severity failure;
      end loop;

      if ticks /= reset_at then
        assert not to_come report g_stem & set & ": tlast before the last vector is taken" severity failure;
        assert not there report g_stem & set & ": tlast before the last fragment" severity failure;
      end if;
      inits.close_file;
      if kind = draws then
        fragments.close_file;
      end if;

      -- The top waits, both after a reset and after a frame.
      s_axis_tvalid <= '0';
      aresetn       <= '1';
      m_axis_tready <= '1';
      for i in 1 to 3 loop
        wait until rising_edge(aclk);
        check("s_axis_tready when idle", s_axis_tready, to_flag(ticks /= reset_at or i > 1));
        check("m_axis_tvalid when idle", m_axis_tvalid, '0');
        check("fault when idle", fault, '0');
      end loop;
    end procedure;

    constant c_resets : integer_vector := (2, 5, 9, 23, 311);
  begin
    for i in 1 to 3 loop
      wait until rising_edge(aclk);
    end loop;
    check("s_axis_tready in reset", s_axis_tready, '0');
    check("m_axis_tvalid in reset", m_axis_tvalid, '0');
    aresetn <= '1';
    wait until rising_edge(aclk);
    pass(draws, "mixed", 1, 0, 0, 0);
    if g_faults then
      pass(faulty, "fault", 1, 0, 0, 0);
    else
      pass(draws, "dense", 1, 0, 0, 0);
      pass(empty, "empty", 1, 0, 0, 0);
      pass(draws, "mixed", 12, 1, 1, 0);
      pass(empty, "empty", 1, 1, 2, 0);
      pass(too_long, "too_long", 1, 0, 0, 0);
      pass(draws, "mixed", 13, 4, 0, 0);
      pass(too_long, "too_long", 2, 2, 2, 0);
      pass(draws, "dense", 14, 0, 1, 0);
      for i in c_resets'range loop
        pass(draws, "mixed", 20 + i, 0, i mod 2, c_resets(i));
      end loop;
    end if;
    pass(draws, "mixed", 1, 0, 0, 0);
    ended <= true;
    finish(finished);
  end process;

end architecture;
