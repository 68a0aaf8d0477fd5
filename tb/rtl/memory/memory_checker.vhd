-- SPDX-License-Identifier: Apache-2.0
-- Draws the frames of a file of golden vectors with fragments_to_memory into a memory, and compares all of the memory
-- after each frame. The memory answers at once, after 30 clocks, or at random; fragments come at full speed or with
-- pauses. Each frame is then drawn again with error responses: it must end, with a fault, and without a byte outside.
-- Measures clocks of spans. axi_rules checks every clock.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_memory_pkg.all;
use work.axi_pkg.all;
use work.axi_words_pkg.all;
use work.memory_pkg.all;
use work.tb_pkg.all;

entity memory_checker is
  generic (
    g_number      : natural;  -- of this instance: it has the memories 2 * g_number and 2 * g_number + 1
    g_true_colour : boolean;
    g_data_bits   : positive;
    g_block_bits  : positive := 6;
    g_slot_bits   : positive := 3;
    g_file        : string;   -- empty: measure only
    g_port_clocks : natural  := 0; -- of a memory at memory_port; 0: at AXI4
    g_least       : real := 0.0 -- pixels per clock in spans of 64 at a latency of 30
  );
end entity;

architecture sim of memory_checker is
  constant c_memory   : natural := 2 * g_number;
  constant c_expected : natural := c_memory + 1;
  constant c_bytes    : positive := g_data_bits / 8;
  constant c_limit    : positive := 20_000; -- clocks without a transfer that count as a hang

  -- Of the memory and of the sender, by turns.
  constant c_latencies     : integer_vector(0 to 3) := (1, 30, 5, 60);
  constant c_pauses        : integer_vector(0 to 3) := (0, 0, 1, 2);
  constant c_source_pauses : integer_vector(0 to 3) := (0, 0, 1, 0);

  signal running           : boolean := false;
  signal clk               : std_logic := '0';
  signal reset             : std_logic := '1';
  signal frame             : frame_t;
  signal start             : std_logic := '0';
  signal busy, done, fault : std_logic;
  signal pixels            : pixel_count_t;
  signal tvalid, tlast     : std_logic := '0';
  signal tready            : std_logic;
  signal tdata             : fragment_data_t := (others => '0');
  signal tkeep             : fragment_keep_t := (others => '0');
  signal tuser             : cause_t := (others => '0');
  signal m                 : manager_t;
  signal s                 : subordinate_t;
  signal latency           : positive := 1;
  signal pauses, errors    : natural := 0;
  signal number            : natural := 0; -- of the frame
  signal error_seen        : boolean := false;
  signal drawn             : natural := 0; -- sum of pixels since start
  signal clock             : natural := 0;
  signal idle              : natural := 0;
begin
  dut : entity work.fragments_to_memory
    generic map (
      g_true_colour => g_true_colour,
      g_data_bits   => g_data_bits,
      g_block_bits  => g_block_bits,
      g_slot_bits   => g_slot_bits)
    port map (
      clk           => clk,
      reset         => reset,
      frame         => frame,
      start         => start,
      busy          => busy,
      done          => done,
      fault         => fault,
      pixels        => pixels,
      s_axis_tvalid => tvalid,
      s_axis_tready => tready,
      s_axis_tdata  => tdata,
      s_axis_tkeep  => tkeep,
      s_axis_tlast  => tlast,
      s_axis_tuser  => tuser,
      m_axi_arvalid => m.ar.valid,
      m_axi_arready => s.arready,
      m_axi_araddr  => m.ar.addr,
      m_axi_arlen   => m.ar.len,
      m_axi_arsize  => m.ar.size,
      m_axi_arburst => m.ar.burst,
      m_axi_arcache => open,
      m_axi_arprot  => open,
      m_axi_rvalid  => s.rvalid,
      m_axi_rready  => m.rready,
      m_axi_rdata   => s.rdata(g_data_bits - 1 downto 0),
      m_axi_rresp   => s.rresp,
      m_axi_awvalid => m.aw.valid,
      m_axi_awready => s.awready,
      m_axi_awaddr  => m.aw.addr,
      m_axi_awlen   => m.aw.len,
      m_axi_awsize  => m.aw.size,
      m_axi_awburst => m.aw.burst,
      m_axi_awcache => open,
      m_axi_awprot  => open,
      m_axi_wvalid  => m.wvalid,
      m_axi_wready  => s.wready,
      m_axi_wdata   => m.wdata(g_data_bits - 1 downto 0),
      m_axi_wstrb   => m.wstrb(c_bytes - 1 downto 0),
      m_axi_wlast   => m.wlast,
      m_axi_bvalid  => s.bvalid,
      m_axi_bready  => m.bready,
      m_axi_bresp   => s.bresp);

  at_axi : if g_port_clocks = 0 generate
    memory : entity work.axi_memory
      generic map (g_memory => c_memory, g_data_bits => g_data_bits)
      port map (clk => clk, reset => reset, latency => latency, pause => pauses, errors => errors, m => m, s => s);
  end generate;

  at_port : if g_port_clocks > 0 generate
    memory : entity work.port_memory
      generic map (g_memory => c_memory, g_data_bits => g_data_bits, g_clocks => g_port_clocks)
      port map (clk => clk, reset => reset, m => m, s => s);
  end generate;

  rules : entity work.axi_rules
    generic map (g_true_colour => g_true_colour, g_data_bits => g_data_bits)
    port map (clk => clk, reset => reset, frame => frame, start => start, done => done, m => m, s => s);

  clk <= not clk after c_half_period when running;
  clock <= clock + 1 when rising_edge(clk);

  watch : process (clk) is
  begin
    if rising_edge(clk) then
      idle <= idle + 1;
      if busy = '0' or (tvalid and tready) = '1' or (s.rvalid and m.rready) = '1' or (m.wvalid and s.wready) = '1'
        or (s.bvalid and m.bready) = '1' then
        idle <= 0;
      end if;
      assert idle < c_limit report "memory_checker: frame " & to_string(number) & " does not end" severity failure;
      drawn <= drawn + to_integer(pixels);
      if start = '1' then
        drawn <= 0;
      end if;
      -- A fault that the unit must report.
      if start = '1' then
        error_seen <= false;
      elsif (s.rvalid and m.rready and s.rresp(1)) = '1' or (s.bvalid and m.bready and s.bresp(1)) = '1'
        or ((tvalid and tready) = '1' and tuser /= "000") then
        error_seen <= true;
      end if;
    end if;
  end process;

  run : process is
    type fragments_t is array (0 to 2 ** 14 - 1) of fragment_data_t;

    variable vectors   : vectors_t;
    variable random    : unsigned(31 downto 0) := to_unsigned(5 + g_number, 32);
    variable fragments : fragments_t;
    variable count     : natural;
    variable kept      : natural;
    variable changes   : natural;

    procedure read_frame is
    begin
      count   := vectors.read_number;
      kept    := vectors.read_number;
      changes := vectors.read_number;
      vectors.expect_vector("a frame");
      vectors.drive(frame.colour_base);
      vectors.drive(frame.colour_stride);
      vectors.drive(frame.depth_base);
      vectors.drive(frame.depth_stride);
      vectors.drive(frame.width);
      vectors.drive(frame.height);
      vectors.drive(frame.left);
      vectors.drive(frame.right);
      vectors.drive(frame.top);
      vectors.drive(frame.bottom);
      vectors.drive(frame.clear);
      vectors.drive(frame.red);
      vectors.drive(frame.green);
      vectors.drive(frame.blue);
      vectors.expect_end;
      for i in 0 to count - 1 loop
        vectors.expect_vector("a fragment");
        vectors.read_word(fragments(i));
      end loop;
    end procedure;

    procedure apply_changes is
      variable index : natural;
      variable word  : word_t;
    begin
      for i in 1 to changes loop
        vectors.expect_vector("a changed word");
        index := vectors.read_number;
        vectors.read_word(word);
        memories.set(c_expected, index, word);
      end loop;
    end procedure;

    -- One transfer, after a random number of clocks; some have no fragment.
    procedure send (data : fragment_data_t; source_pause : natural; keep, last : std_logic; cause : cause_t) is
    begin
      pause(clk, random, source_pause);
      tvalid <= '1';
      tdata  <= data;
      tkeep  <= (others => keep);
      tlast  <= last;
      tuser  <= cause;
      wait until rising_edge(clk) and tready = '1';
      tvalid <= '0';
      tdata  <= (others => 'X');
      tuser  <= (others => '0');
    end procedure;

    procedure begin_frame is
    begin
      start <= '1';
      wait until rising_edge(clk);
      start <= '0';
    end procedure;

    -- Data of a transfer without a fragment: as a fragment they would be the nearest one of a pixel.
    impure function no_fragment return fragment_data_t is
      variable data : fragment_data_t := (others => '0');
    begin
      if count > 0 then
        data := fragments(count / 2);
        data(55 downto 32) := (others => '0');
      end if;
      return data;
    end function;

    -- Draw the fragments. With pauses, transfers without a fragment come between them, and as the last one.
    procedure draw (source_pause : natural; cause : cause_t) is
      variable extra : boolean := count = 0;
    begin
      begin_frame;
      for i in 0 to count - 1 loop
        random := next_random(random);
        if source_pause > 0 then
          extra := random(12 downto 10) = "000";
        end if;
        if extra and i < count - 1 then
          send(no_fragment, source_pause, '0', '0', "000");
        end if;
        if i < count - 1 or extra then
          send(fragments(i), source_pause, '1', '0', "000");
        else
          send(fragments(i), source_pause, '1', '1', cause);
        end if;
      end loop;
      if extra then
        send(no_fragment, source_pause, '0', '1', cause);
      end if;
      wait until rising_edge(clk) and done = '1';
      check("memory_checker: frame", number, "fault", fault, to_flag(error_seen));
      check("memory_checker: frame", number, "tready", tready, '0');
    end procedure;

    -- A reset in the middle of a frame. Memory and unit forget what is on its way.
    procedure break (clocks : natural) is
    begin
      begin_frame;
      for i in 0 to count - 1 loop
        exit when i > clocks;
        send(fragments(i), 0, '1', '0', "000");
      end loop;
      reset <= '1';
      wait_clocks(clk, 2);
      reset <= '0';
      check("memory_checker: frame", number, "outputs in reset", busy & done & fault & tready & m.ar.valid & m.aw.valid
        & m.wvalid & m.rready & m.bready, "000000000");
    end procedure;

    -- The clocks of spans of this length, at random places of rows, each nearer than all before it.
    procedure measure (span, clocks : positive; least : real := 0.0) is
      constant c_width  : positive := 320;
      constant c_height : positive := 48;
      constant c_stride : positive := c_width * pixel_bytes(g_true_colour);
      constant c_passes : positive := 1 + 4000 / (c_height * span);

      variable x     : natural;
      variable begun : natural;
      variable rate  : real;
    begin
      memories.fill(c_memory, x"FFFFFFFF");
      latency <= clocks;
      pauses  <= 0;
      frame   <= (
        colour_base                  => to_unsigned(c_memory_origin, address_t'length),
        depth_base                   => to_unsigned(c_memory_origin + c_stride * c_height, address_t'length),
        colour_stride | depth_stride => to_unsigned(c_stride, c_stride_bits),
        width | right                => to_unsigned(c_width, side_t'length),
        height | bottom              => to_unsigned(c_height, side_t'length),
        left | top                   => (others => '0'),
        clear                        => '0',
        others                       => (others => '0'));
      count := 0;
      for pass in 1 to c_passes loop
        for y in 0 to c_height - 1 loop
          random := next_random(random);
          x      := to_integer(random(30 downto 8)) mod (c_width - span + 1);
          for i in 0 to span - 1 loop
            fragments(count) := fragment_data(x"00000000", std_logic_vector(to_unsigned(y, c_place_bits)),
              std_logic_vector(to_unsigned(x + i, c_place_bits)), std_logic_vector(to_unsigned(8000000 - 1000 * pass, c_depth_bits)),
              x"01", x"02", x"03");
            count := count + 1;
          end loop;
        end loop;
      end loop;
      begun := clock;
      draw(0, "000");
      rate := real(count) / real(clock - begun);
      report "memory_checker: " & to_string(pixel_bits(g_true_colour)) & " bits per pixel, bus of " & to_string(g_data_bits)
        & " bits, " & to_string(2 ** g_slot_bits) & " blocks, latency " & to_string(clocks) & ", spans of " & to_string(span)
        & ": " & to_string(rate, 2) & " pixels per clock";
      assert rate >= least report "memory_checker: less than " & to_string(least, 2) severity failure;
    end procedure;

    variable profile : natural;
  begin
    memories.randomize(c_memory);
    memories.randomize(c_expected);
    take_turn;
    running <= true;
    wait_clocks(clk, 3);
    reset <= '0';
    if g_file /= "" then
      vectors.open_file(g_file);
      while vectors.next_vector loop
        read_frame;
        profile := (number + g_number) mod 4;
        if number mod 4 = 1 then
          break(to_integer(random(8 downto 0)));
          memories.copy(c_expected, c_memory);
        end if;
        -- With errors. What is drawn then is not compared.
        latency <= 3;
        pauses  <= number mod 2;
        errors  <= number mod 3 + 1;
        draw(number mod 2, std_logic_vector(to_unsigned(number mod 8, cause_t'length)));
        errors <= 0;
        memories.copy(c_expected, c_memory);

        apply_changes;
        latency <= c_latencies(profile);
        pauses  <= c_pauses(profile);
        draw(c_source_pauses(profile), "000");
        memories.compare("memory_checker: frame", number, c_memory, c_expected);
        check("memory_checker: frame", number, "kept pixels", drawn, kept);
        number <= number + 1;
      end loop;
    end if;
    if g_slot_bits >= 3 then
      measure(64, 30, g_least);
    end if;
    if g_least > 0.0 then
      measure(320, 30);
      measure(64, 100);
      measure(8, 30);
    end if;
    running <= false;
    end_turn(finished);
  end process;
end architecture;
