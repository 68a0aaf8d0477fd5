-- SPDX-License-Identifier: Apache-2.0
-- Around a shader that outputs numbered fragments, 0 to 3 for each vector. Every fragment of a frame must come out
-- once, in order, the last one with tlast, at full speed 1 clock after the next one left the shader, and with random
-- stalls. A frame without fragments must have one transfer without bytes. A frame in which the shader reports a fault
-- or stops, or with a wrong packet, must end with the cause in tuser, and the next frame must be complete.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.tb_pkg.all;

entity axi_adapter_tb is
  generic (g_folder : string := ""); -- not used: there are no vectors
end entity;

architecture sim of axi_adapter_tb is
  constant c_limit_bits : positive := 6;
  constant c_init_bits  : positive := 32;
  constant c_frames     : positive := 600;
  constant c_idle_limit : positive := 3 * 2 ** c_limit_bits; -- clocks without a transfer that count as a hang

  type frame_t is (good, reports, stops, is_wrong);

  function cause_of (kind : frame_t) return cause_t is
  begin
    case kind is
      when good =>
        return c_no_fault;
      when reports =>
        return c_shader_fault;
      when stops =>
        return c_limit_reached;
      when is_wrong =>
        return c_wrong_kind;
    end case;
  end function;

  signal clk                         : std_logic := '0';
  signal reset                       : std_logic := '1';
  signal s_axis_tvalid               : std_logic := '0';
  signal s_axis_tready               : std_logic;
  signal s_axis_tdata                : std_logic_vector(31 downto 0) := (others => '0');
  signal init_valid                  : std_logic;
  signal init_data                   : std_logic_vector(c_init_bits - 1 downto 0);
  signal init_ready, fragment_valid  : std_logic := '0';
  signal fragment_ready              : std_logic;
  signal fragment                    : fragment_data_t := (others => '0');
  signal busy, shader_fault          : std_logic := '0';
  signal shader_reset, m_axis_tvalid : std_logic;
  signal m_axis_tready               : std_logic := '0';
  signal m_axis_tdata                : fragment_data_t;
  signal m_axis_tkeep                : fragment_keep_t;
  signal m_axis_tlast                : std_logic;
  signal m_axis_tuser                : cause_t;
  signal ended                       : boolean := false;
begin
  dut : entity work.axi_adapter
    generic map (
      g_init_bits  => c_init_bits,
      g_lengths    => (c_triangle_packet => 1, others => 0),
      g_limit_bits => c_limit_bits)
    port map (
      clk            => clk,
      reset          => reset,
      s_axis_tvalid  => s_axis_tvalid,
      s_axis_tready  => s_axis_tready,
      s_axis_tdata   => s_axis_tdata,
      s_axis_tlast   => '0',
      init_valid     => init_valid,
      init_ready     => init_ready,
      init_data      => init_data,
      fragment_valid => fragment_valid,
      fragment_ready => fragment_ready,
      fragment       => fragment,
      busy           => busy,
      shader_fault   => shader_fault,
      shader_reset   => shader_reset,
      m_axis_tvalid  => m_axis_tvalid,
      m_axis_tready  => m_axis_tready,
      m_axis_tdata   => m_axis_tdata,
      m_axis_tkeep   => m_axis_tkeep,
      m_axis_tlast   => m_axis_tlast,
      m_axis_tuser   => m_axis_tuser);

  clk <= not clk after c_half_period when not ended;

  run : process is
    variable random : unsigned(31 downto 0) := to_unsigned(11, 32);

    -- A frame of `vectors` vectors. With `pauses` the sender and the receiver pause at random.
    procedure draw (frame : natural; kind : frame_t; vectors : positive; pauses : boolean) is
      constant c_place : string := "axi_adapter: " & frame_t'image(kind) & ", frame";

      variable to_send  : natural := 2 * vectors + 2; -- words; a packet has two, the last one is the frame's end
      variable vector   : integer := 2 * vectors + 1; -- of the next packet: words still to send
      variable offered  : boolean := false; -- a word waits
      variable left     : natural := 0;     -- fragments of the vector in the shader
      variable drawn    : natural := 0;     -- fragments that left the shader
      variable received : natural := 0;
      variable age      : natural := 0;     -- clocks since the shader output its last fragment
      variable idle     : natural := 0;     -- clocks since the last transfer
      variable last     : boolean := false;
    begin
      while not last loop
        random  := next_random(random);
        offered := to_send > 0 and (offered or not pauses or random(8) = '1');
        s_axis_tvalid  <= to_flag(offered);
        if to_send mod 2 = 1 then
          s_axis_tdata <= std_logic_vector(to_unsigned(to_send, 32)); -- the vector
        elsif to_send = 2 then
          s_axis_tdata <= std_logic_vector(to_unsigned(c_end_packet, 32));
        elsif to_send = 4 and kind = is_wrong then
          s_axis_tdata <= x"00010000" or std_logic_vector(to_unsigned(c_load_packet, 32));
        else
          s_axis_tdata <= x"00010000" or std_logic_vector(to_unsigned(c_triangle_packet, 32));
        end if;
        init_ready     <= to_flag(left = 0 and not (kind = stops and to_send <= 2));
        fragment_valid <= to_flag(left > 0);
        fragment       <= std_logic_vector(to_unsigned(drawn + 1, fragment'length));
        busy           <= to_flag(left > 0);
        shader_fault   <= to_flag(kind = reports and to_send = 0 and left = 0);
        m_axis_tready  <= to_flag(not pauses or random(9) = '1');
        wait until rising_edge(clk);
        idle := idle + 1;
        age  := age + 1;
        assert idle < c_idle_limit report c_place & " " & to_string(frame) & ": hangs" severity failure;
        if m_axis_tvalid = '1' and m_axis_tready = '1' then
          idle := 0;
          last := m_axis_tlast = '1';
          if m_axis_tkeep = (m_axis_tkeep'range => '1') then
            received := received + 1;
            check(c_place, frame, "fragment", to_integer(unsigned(m_axis_tdata(30 downto 0))), received);
            if kind = good and not pauses and not last then
              check(c_place, frame, "clocks after the next fragment", age, 1);
            end if;
          else
            check(c_place, frame, "tkeep", to_integer(unsigned(m_axis_tkeep)), 0);
            check(c_place, frame, "tlast without bytes", m_axis_tlast, '1');
            check(c_place, frame, "fragments before a transfer without bytes", received, 0);
          end if;
        end if;
        if fragment_valid = '1' and fragment_ready = '1' then
          drawn := drawn + 1;
          left  := left - 1;
          age   := 0;
        end if;
        if init_valid = '1' and init_ready = '1' then
          check(c_place, frame, "vector", to_integer(unsigned(init_data)), vector);
          vector := vector - 2;
          left := to_integer(random(17 downto 16));
        end if;
        if s_axis_tvalid = '1' and s_axis_tready = '1' then
          to_send := to_send - 1;
          offered := false;
          idle    := 0;
        end if;
        if shader_reset = '1' then
          left := 0;
        end if;
      end loop;
      check(c_place, frame, "words not taken", to_send, 0);
      check(c_place, frame, "tuser", m_axis_tuser, cause_of(kind));
      check(c_place, frame, "fragments", received, drawn);
    end procedure;
  begin
    wait_clocks(clk, 2);
    check("axi_adapter: frame", 0, "s_axis_tready in reset", s_axis_tready, '0');
    reset <= '0';
    for frame in 1 to c_frames loop
      draw(frame, frame_t'val(frame mod 5 mod 4), 1 + frame mod 7, frame mod 4 > 1);
      draw(frame, good, 1 + frame mod 3, frame mod 8 > 3);
    end loop;
    ended <= true;
    finish(finished);
  end process;

  report_end(finished, "axi_adapter_tb");
end architecture;
