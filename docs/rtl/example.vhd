-- SPDX-License-Identifier: Apache-2.0
--
-- Purpose     Shows how a design uses a shader: a ROM of init vectors drives a grey quadratic_shader, and its fragments
--             write a frame memory with a depth test.
-- Contract    start = '1' for one clock draws the ROM's triangles over the frame; done = '1' when all are drawn. The
--             frame is read through read_address, one pixel per clock; pixel (x, y) is at y * c_width + x
-- Formats     formats_pkg: depth, colour
-- Throughput  1 fragment per clock
-- Source      ours; the vectors are those of
--             halfway init sim/report/timing.toml --size 16x12 --highlight-test none --preset published

library ieee, halfway;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use halfway.formats_pkg.all;
use halfway.quadratic_pkg.all;

entity example is
  port (
    clk          : in  std_logic;
    reset        : in  std_logic;
    start        : in  std_logic;
    done         : out std_logic;
    read_address : in  unsigned(7 downto 0);
    read_colour  : out std_logic_vector(7 downto 0)
  );
end entity;

architecture rtl of example is

  constant c_exact  : boolean  := false;
  constant c_bits   : positive := init_bits(c_exact, 2, 1); -- 497: preset published, degree 2, 1 channel
  constant c_width  : positive := 16;
  constant c_height : positive := 12;

  -- The lines of the file, 125 hexadecimal digits each; the upper 3 of 500 bits are zero.
  type rom_t is array (natural range <>) of std_logic_vector(499 downto 0);

  constant c_rom : rom_t := (
    x"1ff15414600326319ffe1bf200145fb2bff0afddc15133abe00000000000000000000a8d53bf02000015556005c0001fff80000005c000000700200000000",
    x"1ff15414600326319ffe1bf21fbc582d20039506a0ef5f0dc00000000000000000000a8d53bf021ffc0000000640001fff80000002c000000200800000000",
    x"1e281a6d204f564cfff28ddddfa61ff79fe19ab6c15133abe00000000000000000000a8d53bf021fff80000005c0001ffd00000005c000000200200000001",
    x"1ffc2bc2a000e72f9ff28ddddffcf8882030f103a0f753a3400000000000000000000a8d53bf021fff8000000540001fffeaaaa002c000000700300000001");

  type depths_t is array (0 to c_width * c_height - 1) of std_logic_vector(23 downto 0);

  type colours_t is array (0 to c_width * c_height - 1) of std_logic_vector(7 downto 0);

  type reg_t is record
    valid : std_logic; -- c_rom(index) is offered to the shader
    index : natural range 0 to c_rom'high;
  end record;

  signal r, r_next      : reg_t;
  signal init_ready     : std_logic;
  signal fragment_valid : std_logic;
  signal x, y           : std_logic_vector(11 downto 0);
  signal z              : std_logic_vector(23 downto 0);
  signal colour         : std_logic_vector(7 downto 0);
  signal busy           : std_logic;
  signal depths         : depths_t;
  signal colours        : colours_t;

begin

  shader : entity halfway.quadratic_shader
    generic map (
      g_exact    => c_exact,
      g_channels => 1
      )
    port map (
      clk               => clk,
      reset             => reset,
      init_valid        => r.valid,
      init_ready        => init_ready,
      init_data         => c_rom(r.index)(c_bits - 1 downto 0),
      fragment_valid    => fragment_valid,
      fragment_ready    => '1', -- the frame memory always takes a fragment
      fragment_triangle => open,
      fragment_y        => y,
      fragment_x        => x,
      fragment_z        => z,
      fragment_red      => colour,
      fragment_green    => open,
      fragment_blue     => open,
      busy              => busy,
      fault             => open
      );

    -- Offer one vector after the other.
  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if r.valid = '1' and init_ready = '1' then
      if r.index = c_rom'high then
        v.valid := '0';
      else
        v.index := r.index + 1;
      end if;
    end if;
    if start = '1' then
      v.valid := '1';
      v.index := 0;
    end if;
    if reset = '1' then
      v.valid := '0';
    end if;
    r_next <= v;
  end process;

  registers : process (clk)
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;

  -- Clear the frame on start; write each fragment that is nearer than what the frame holds.
  frame : process (clk)
    variable address : natural range 0 to c_width * c_height - 1;
  begin
    if rising_edge(clk) then
      if start = '1' then
        depths  <= (others => (others => '1'));
        colours <= (others => (others => '0'));
      elsif fragment_valid = '1' then
        address := to_integer(unsigned(y)) * c_width + to_integer(unsigned(x));
        if unsigned(z) < unsigned(depths(address)) then
          depths(address)  <= z;
          colours(address) <= colour;
        end if;
      end if;
      read_colour <= colours(to_integer(read_address));
    end if;
  end process;

  done <= not (r.valid or busy or fragment_valid);

end architecture;
