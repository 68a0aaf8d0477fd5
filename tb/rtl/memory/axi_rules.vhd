-- SPDX-License-Identifier: Apache-2.0
-- Checks the port of fragments_to_memory, or of halfway_core, in each clock of a simulation. Of AXI4: what waits does not change; INCR bursts of
-- whole words, aligned, not across 4 KiB; wlast and rlast with the last word of a burst and with no other; a response only
-- after its burst. Of the unit: each byte that a strobe selects belongs to a pixel inside frame and scissor; reads are in the
-- rows of the depth buffer, and not in beats of a write without a response; the first read of a frame comes after all
-- responses of its clear; at done nothing is on its way.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_words_pkg.all;
use work.memory_pkg.all;
use work.tb_pkg.all;

entity axi_rules is
  generic (
    g_true_colour : boolean;
    g_data_bits   : positive;
    g_any_place   : boolean := false -- AXI4's rules only: of halfway_core, whose frames are not known
  );
  port (
    clk   : in std_logic;
    reset : in std_logic;
    frame : in frame_t := (
      colour_base | depth_base => to_unsigned(0, 32), colour_stride | depth_stride => to_unsigned(0, 16),
      width | height | left | right | top | bottom => to_unsigned(0, 13), clear => '0', red | green | blue => x"00"
      );
    start : in std_logic := '0';
    done  : in std_logic := '0';
    m     : in manager_t;
    s     : in subordinate_t
  );
end entity;

architecture sim of axi_rules is
  constant c_bytes   : positive := g_data_bits / 8;
  constant c_pixel   : positive := pixel_bytes(g_true_colour);
  constant c_pending : positive := 64;
  constant c_beats   : positive := 4096;

  type burst_t is record
    first : natural; -- address of its first and of its last byte
    last  : natural;
  end record;

  type bursts_t is array (0 to c_pending - 1) of burst_t;

  type lengths_t is array (0 to c_pending - 1) of natural;

  type beat_t is record
    strb : std_logic_vector(7 downto 0);
    last : std_logic;
  end record;

  type beats_t is array (0 to c_beats - 1) of beat_t;

  procedure require (condition : boolean; rule : string) is
  begin
    if not condition then
      report "axi_rules: " & rule severity failure;
    end if;
  end procedure;

  function burst_of (request : request_t) return burst_t is
    constant c_first : natural := to_integer(request.addr);
  begin
    return (c_first, c_first + c_bytes - 1 + c_bytes * to_integer(request.len));
  end function;

  procedure check_request (name : string; request : request_t) is
    constant c_burst : burst_t := burst_of(request);
  begin
    require(request.burst = "01", name & " is not INCR");
    require(2 ** to_integer(unsigned(request.size)) = c_bytes, name & " is not of whole words");
    require(c_burst.first mod c_bytes = 0, name & " is not aligned");
    require(c_burst.first / 4096 = c_burst.last / 4096, name & " crosses 4 KiB");
  end procedure;

  -- Column and row of a byte in a buffer of this base and stride; false if it is before or after its rows.
  procedure find (address : natural; base : address_t; stride : stride_t; rows : side_t;
    found : out boolean; column, row : out natural) is
    constant c_offset : integer := address - to_integer(base);
  begin
    found  := c_offset >= 0 and c_offset < to_integer(stride) * to_integer(rows);
    column := 0;
    row    := 0;
    if found then
      column := c_offset mod to_integer(stride) / c_pixel;
      row    := c_offset / to_integer(stride);
    end if;
  end procedure;

  -- The byte belongs to a pixel that may be written.
  procedure check_byte (address : natural) is
    variable found       : boolean;
    variable column, row : natural;
  begin
    find(address, frame.colour_base, frame.colour_stride, frame.height, found, column, row);
    if not found then
      find(address, frame.depth_base, frame.depth_stride, frame.height, found, column, row);
    end if;
    require(found and column < frame.width and column >= frame.left and column < frame.right
      and row >= frame.top and row < frame.bottom, "write outside the frame at " & to_hstring(to_unsigned(address, 32)));
  end procedure;
begin
  rules : process (clk) is
    variable m_before : manager_t;
    variable s_before : subordinate_t;
    variable running  : boolean := false; -- m_before and s_before are known
    variable bursts   : bursts_t; -- addresses that were taken
    variable taken    : natural; -- their number
    variable beats    : beats_t; -- words that were taken
    variable words    : natural; -- their number
    variable checked  : natural; -- words that belong to an address
    variable burst    : natural; -- of the next one
    variable place    : natural; -- its bytes from the burst's start
    variable answered : natural; -- bursts with a response
    variable lengths  : lengths_t; -- of reads that were taken
    variable asked    : natural; -- their number
    variable read     : natural; -- those with all words
    variable word     : natural; -- of the next one
    variable found    : boolean;
    variable column   : natural;
    variable row      : natural;
    variable request  : burst_t;
    variable strobes  : std_logic_vector(7 downto 0);
    variable cleared  : boolean := true; -- the frame has no clear, or has begun to read

    procedure check_stable is
    begin
      if m_before.ar.valid = '1' and s_before.arready = '0' then
        require(m.ar = m_before.ar, "AR changes while it waits");
      end if;
      if m_before.aw.valid = '1' and s_before.awready = '0' then
        require(m.aw = m_before.aw, "AW changes while it waits");
      end if;
      if m_before.wvalid = '1' and s_before.wready = '0' then
        require(m.wvalid = '1' and m.wdata = m_before.wdata and m.wstrb = m_before.wstrb and m.wlast = m_before.wlast,
          "W changes while it waits");
      end if;
      if s_before.rvalid = '1' and m_before.rready = '0' then
        require(s.rvalid = '1' and s.rdata = s_before.rdata and s.rresp = s_before.rresp, "R changes while it waits");
      end if;
      if s_before.bvalid = '1' and m_before.bready = '0' then
        require(s.bvalid = '1' and s.bresp = s_before.bresp, "B changes while it waits");
      end if;
    end procedure;
  begin
    if rising_edge(clk) then
      if reset = '1' then
        running  := false;
        taken    := 0;
        words    := 0;
        checked  := 0;
        burst    := 0;
        place    := 0;
        answered := 0;
        asked    := 0;
        read     := 0;
        word     := 0;
      else
        require(not is_x(std_logic_vector'(m.ar.valid & m.aw.valid & m.wvalid & m.rready & m.bready)), "a valid or ready is unknown");
        if running then
          check_stable;
        end if;

        -- Reads, from the first clock in which they are valid.
        if m.ar.valid = '1' then
          check_request("AR", m.ar);
          request := burst_of(m.ar);
          for i in answered to taken - 1 loop
            require(request.last < bursts(i mod c_pending).first or request.first > bursts(i mod c_pending).last,
              "read before the response of a write at " & to_hstring(m.ar.addr));
          end loop;
          require(g_any_place or cleared or (answered = taken and words = checked), "read before the last response of the clear");
          cleared := true;
          find(request.first, frame.depth_base, frame.depth_stride, frame.height, found, column, row);
          require(g_any_place or found, "read outside the depth buffer");
          find(request.last, frame.depth_base, frame.depth_stride, frame.height, found, column, row);
          require(g_any_place or found, "read outside the depth buffer");
        end if;

        if s.rvalid = '1' and m.rready = '1' then
          require(read < asked, "a word without a read");
          require((s.rlast = '1') = (word = lengths(read mod c_pending)), "rlast is not the burst's last word");
          word := word + 1;
          if s.rlast = '1' then
            read := read + 1;
            word := 0;
          end if;
        end if;
        if m.ar.valid = '1' and s.arready = '1' then
          lengths(asked mod c_pending) := to_integer(m.ar.len);
          asked := asked + 1;
        end if;

        -- Writes.
        if m.aw.valid = '1' then
          check_request("AW", m.aw);
          if s.awready = '1' then
            bursts(taken mod c_pending) := burst_of(m.aw);
            taken := taken + 1;
          end if;
        end if;
        if m.wvalid = '1' and s.wready = '1' then
          beats(words mod c_beats) := (m.wstrb, m.wlast);
          words := words + 1;
        end if;
        while checked < words and burst < taken loop
          request := bursts(burst mod c_pending);
          strobes := beats(checked mod c_beats).strb;
          for lane in 0 to c_bytes - 1 loop
            if strobes(lane) /= '0' and not g_any_place then
              check_byte(request.first + place + lane);
            end if;
          end loop;
          place := place + c_bytes;
          require((beats(checked mod c_beats).last = '1') = (request.first + place > request.last),
            "wlast is not the burst's last word");
          checked := checked + 1;
          if request.first + place > request.last then
            burst := burst + 1;
            place := 0;
          end if;
        end loop;
        if s.bvalid = '1' and m.bready = '1' then
          require(answered < burst, "a response before the end of its burst");
          answered := answered + 1;
        end if;

        if start = '1' then
          cleared := frame.clear = '0';
        end if;
        if done = '1' then
          require(answered = taken and checked = words and burst = taken and place = 0 and read = asked and m.ar.valid = '0'
            and m.aw.valid = '0' and m.wvalid = '0', "done before the last response");
        end if;
        running  := true;
        m_before := m;
        s_before := s;
      end if;
    end if;
  end process;
end architecture;
