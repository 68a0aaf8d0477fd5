-- SPDX-License-Identifier: Apache-2.0
-- Frames of every shader as packets, on both widths of the bus: good and empty ones, and between them frames with a
-- packet of a wrong kind, of a wrong length, cut off, without line records, and with a vector that the shader refuses.
-- Every transfer at the output must be that of the golden model; a faulty frame must end with its cause. At full speed,
-- with random stalls at both ends, and from the start again after a reset in the middle. What waits must not change.
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.axi_pkg.all;
use work.shader_pkg.all;
use work.tb_pkg.all;
use work.tb_shaders_pkg.all;

entity words_to_fragments_tb is
  generic (g_folder : string := "words_to_fragments");
end entity;

architecture sim of words_to_fragments_tb is
  constant c_limit_bits : positive := 12; -- a frame takes fewer clocks
  constant c_idle_limit : positive := 3 * 2 ** c_limit_bits; -- clocks without a transfer that count as a hang
begin
  hardware_runs : for index in 0 to 4 generate
    constant h : hardware_t := packet_hardware(index);
  begin
    bus_runs : for lanes in 1 to 2 generate
      constant c_stem : string := g_folder & "/" & nth_word(c_packet_names, index) & "_";

      signal running                : boolean   := false;
      signal aclk                   : std_logic := '0';
      signal aresetn, s_axis_tvalid : std_logic := '0';
      signal s_axis_tready          : std_logic;
      signal s_axis_tdata           : std_logic_vector(lanes * c_word_bits - 1 downto 0) := (others => '0');
      signal s_axis_tlast           : std_logic := '0';
      signal m_axis_tvalid          : std_logic;
      signal m_axis_tready          : std_logic := '0';
      signal m_axis_tdata           : fragment_data_t;
      signal m_axis_tkeep           : fragment_keep_t;
      signal m_axis_tlast           : std_logic;
      signal m_axis_tuser           : cause_t;
    begin
      dut : entity work.words_to_fragments
        generic map (
          g_shader             => h.shader,
          g_exact              => h.exact,
          g_channels           => h.channels,
          g_diffuse            => h.diffuse,
          g_specular           => h.specular,
          g_degree             => h.degree,
          g_lights             => h.lights,
          g_highlight_channels => h.highlight_channels,
          g_powers             => h.powers,
          g_cosine             => h.cosine,
          g_directional        => h.directional,
          g_positional         => h.positional,
          g_spots              => h.spots,
          g_normalize          => h.normalize,
          g_shadows            => h.shadows,
          g_unrolled           => h.unrolled,
          g_objects            => h.objects,
          g_subpixels          => h.subpixels,
          g_bus_bits           => lanes * c_word_bits,
          g_limit_bits         => c_limit_bits)
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
          m_axis_tuser  => m_axis_tuser);

      aclk <= not aclk after c_half_period when running;

      run : process is
        variable words, fragments : vectors_t;

        -- All frames, or the start of them up to a reset in clock reset_at; 0: no reset. A word is offered in one of
        -- 2**word_pause clocks, and tready is '1' in one of 2**fragment_pause.
        procedure pass (seed, word_pause, fragment_pause, reset_at : natural) is
          variable random      : unsigned(31 downto 0) := to_unsigned(seed, 32);
          variable more        : boolean; -- words
          variable offered     : boolean := false;
          variable due         : boolean; -- a transfer
          variable due_last    : std_logic;
          variable due_cause   : cause_t;
          variable due_filled  : std_logic;
          variable due_data    : fragment_data_t;
          variable ticks, idle : natural := 0;
          variable waiting     : boolean := false;
          variable held        : std_logic_vector(c_fragment_bits + 20 - 1 downto 0);

          -- The next bus word. A packet may end with its lower half, if it is cut off.
          procedure read_bus_word is
            variable word     : std_logic_vector(c_word_bits - 1 downto 0);
            variable is_last  : std_logic := '0';
            variable bus_word : std_logic_vector(s_axis_tdata'range) := (others => '1');
          begin
            more := false;
            for lane in 0 to lanes - 1 loop
              if is_last = '0' and (lane = 0 or more) then
                more := words.next_vector;
                if more then
                  words.read_flag(is_last);
                  words.read_word(word);
                  bus_word((lane + 1) * c_word_bits - 1 downto lane * c_word_bits) := word;
                end if;
              end if;
            end loop;
            s_axis_tdata <= bus_word;
            s_axis_tlast <= is_last;
          end procedure;

          procedure read_transfer is
          begin
            due := fragments.next_vector;
            if due then
              fragments.read_flag(due_last);
              fragments.read_word(due_cause);
              fragments.read_flag(due_filled);
              fragments.read_word(due_data);
            end if;
          end procedure;

          procedure check (name : string; got, expected : std_logic_vector) is
          begin
            if got /= expected then
              fragments.fail(name & " is " & to_hstring(got) & ", expected " & to_hstring(expected));
            end if;
          end procedure;

          procedure check_transfer is
          begin
            if not due then
              fragments.fail("a transfer after the last one");
            elsif due_cause = c_no_fault then
              check("tlast", (0 => m_axis_tlast), (0 => due_last));
              check("tuser", m_axis_tuser, due_cause);
              check("tkeep", m_axis_tkeep, (m_axis_tkeep'range => due_filled));
              if due_filled = '1' then
                check("tdata", m_axis_tdata, due_data);
              end if;
              read_transfer;
            elsif m_axis_tlast = '1' then
              check("cause of the fault", m_axis_tuser, due_cause);
              read_transfer;
            else
              check("tuser before the last transfer", m_axis_tuser, c_no_fault);
            end if;
          end procedure;
        begin
          words.open_file(c_stem & "words.txt");
          fragments.open_file(c_stem & "fragments.txt");
          read_bus_word;
          read_transfer;
          while due and (reset_at = 0 or ticks < reset_at) loop
            random        := next_random(random);
            offered       := more and (offered or chance(random(19 downto 12), word_pause));
            s_axis_tvalid <= to_flag(offered);
            m_axis_tready <= to_flag(chance(random(30 downto 23), fragment_pause));
            wait until rising_edge(aclk);
            ticks := ticks + 1;
            idle  := idle + 1;
            if idle > c_idle_limit then
              fragments.fail("hangs");
            end if;
            if waiting then
              check("a transfer that waits", m_axis_tvalid & m_axis_tlast & m_axis_tuser & m_axis_tkeep(15 downto 1) & m_axis_tdata,
                held);
            end if;
            held    := '1' & m_axis_tlast & m_axis_tuser & m_axis_tkeep(15 downto 1) & m_axis_tdata;
            waiting := m_axis_tvalid = '1' and m_axis_tready = '0';
            if m_axis_tvalid = '1' and m_axis_tready = '1' then
              idle := 0;
              check_transfer;
            end if;
            if s_axis_tvalid = '1' and s_axis_tready = '1' then
              idle    := 0;
              offered := false;
              read_bus_word;
            end if;
          end loop;
          if reset_at = 0 and more then
            words.fail("is not taken");
          end if;
          words.close_file;
          fragments.close_file;
          s_axis_tvalid <= '0';
          m_axis_tready <= '1';
          aresetn       <= to_flag(reset_at = 0);
          wait until rising_edge(aclk);
          wait until rising_edge(aclk);
          aresetn <= '1';
          wait until rising_edge(aclk);
          if m_axis_tvalid = '1' then
            report c_stem & ": a transfer after the end" severity failure;
          end if;
          wait until rising_edge(aclk);
        end procedure;

        constant c_resets : integer_vector := (2, 9, 31, 311, 997);
      begin
        take_turn;
        running <= true;
        wait_clocks(aclk, 2);
        assert s_axis_tready = '0' and m_axis_tvalid = '0' report c_stem & ": not idle in reset" severity failure;
        aresetn <= '1';
        wait_clocks(aclk, 2);
        pass(1, 0, 0, 0);
        pass(2, 0, 1, 0);
        pass(3, 2, 2, 0);
        for i in c_resets'range loop
          pass(4 + i, i mod 2, i mod 3, c_resets(i));
        end loop;
        pass(1, 0, 0, 0);
        running <= false;
        end_turn(finished);
      end process;
    end generate;
  end generate;

  report_end(finished, "words_to_fragments_tb");
end architecture;
