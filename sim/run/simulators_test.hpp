// SPDX-License-Identifier: Apache-2.0
// A small RTL with the shader's ports, whole or with a fault, in both simulators.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "common/test/is_error.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway {

inline const char* const c_package = R"(
package quadratic_pkg is
  function init_bits(exact : boolean; degree, channels : positive) return positive;
end package;
package body quadratic_pkg is
  function init_bits(exact : boolean; degree, channels : positive) return positive is
  begin
    return 70 + channels;
  end function;
end package body;
)";

// Emits `count` fragments along x for each vector: bits 11..0 count, 43..12 triangle, 55..44 y. The tests
// replace the marks @...@.
inline const char* const c_shader = R"(
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.quadratic_pkg.all;
entity quadratic_shader is
  generic (g_exact : boolean := true; g_channels : positive := 3;
           g_degree : positive := 2);
  port (
    clk, reset : in std_logic;
    init_valid : in std_logic; init_ready : out std_logic;
    init_data : in std_logic_vector(init_bits(g_exact, g_degree, g_channels) - 1 downto 0);
    fragment_valid : out std_logic; fragment_ready : in std_logic;
    fragment_triangle : out std_logic_vector(31 downto 0);
    fragment_y, fragment_x : out std_logic_vector(11 downto 0);
    fragment_z : out std_logic_vector(23 downto 0);
    fragment_red, fragment_green, fragment_blue : out std_logic_vector(7 downto 0);
    busy, fault : out std_logic);
end entity;
architecture rtl of quadratic_shader is
  type reg_t is record
    valid    : std_logic;
    left     : unsigned(11 downto 0);
    x        : unsigned(11 downto 0);
    triangle : std_logic_vector(31 downto 0);
    y        : std_logic_vector(11 downto 0);
    alarm    : std_logic_vector(4 downto 0);
  end record;
  signal r, r_next : reg_t;
  signal ready, take, one_left : std_logic;
begin
  one_left   <= '1' when r.left = 1 else '0';
  ready      <= not r.valid or (fragment_ready and one_left);
  init_ready <= ready;
  take       <= init_valid and ready;
  combinational : process (all)
    variable v : reg_t;
  begin
    v := r;
    if r.valid = '1' and fragment_ready = '1' then
      v.left := r.left - 1;
      v.x    := r.x + 1;
      if r.left = 1 then
        v.valid := '0';
      end if;
    end if;
    if take = '1' then
      v.left     := unsigned(init_data(11 downto 0));
      v.triangle := init_data(43 downto 12);
      v.y        := init_data(55 downto 44);
      v.x        := (others => '0');
      v.valid    := '1';
      if unsigned(init_data(11 downto 0)) = 0 then
        v.valid := '0';
      end if;
    end if;
    v.alarm := r.alarm(3 downto 0) & (r.alarm(0) or @ALARM@);
    if reset = '1' then
      v.valid := '0';
      v.alarm := (others => '0');
    end if;
    @FAULT@
    r_next <= v;
  end process;
  process (clk) is
  begin
    if rising_edge(clk) then
      r <= r_next;
    end if;
  end process;
  busy              <= r.valid;
  fault             <= r.alarm(@DELAY@);
  fragment_valid    <= @VALID@;
  fragment_triangle <= r.triangle;
  fragment_y        <= r.y;
  fragment_x        <= std_logic_vector(r.x);
  fragment_z        <= x"000" & std_logic_vector(r.left);
  fragment_red      <= @RED@;
  fragment_green    <= r.triangle(7 downto 0);
  fragment_blue     <= x"a5";
end architecture;
)";

/// Replacements of the marks.
struct Parts {
  std::string fault, valid = "r.valid", red = "std_logic_vector(r.x(7 downto 0))";
  std::string alarm = "'0'", delay = "0";
};

inline void replace(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at; (at = text.find(what)) != std::string::npos;) text.replace(at, what.size(), with);
}

class Simulators : public FolderTest {
 protected:
  void SetUp() override {
    must(make_folders(folders_.source));
    for (const char* folder : {"sim", "tb"})
      std::filesystem::copy(c_source_folder / folder, folders_.source / folder,
                            std::filesystem::copy_options::recursive);
    write_rtl({});
    init_.bits = 73;
    for (const unsigned count : {5U, 0U, 1U, 300U, 2U, 0U, 0U, 77U, 1U}) add_triangle(count);
  }

  void write_rtl(const Parts& parts) {
    std::string text = c_shader;
    replace(text, "@FAULT@", parts.fault);
    replace(text, "@VALID@", parts.valid);
    replace(text, "@RED@", parts.red);
    replace(text, "@ALARM@", parts.alarm);
    replace(text, "@DELAY@", parts.delay);
    write("tree/rtl/quadratic_pkg.vhd", c_package);
    write("tree/rtl/shaders/quadratic_shader.vhd", text);
    write("tree/rtl/cosine_pkg.vhd", must(read_file(c_source_folder / "rtl/tables/cosine_pkg.vhd")));
    write("tree/rtl/files.f", "quadratic_pkg.vhd\ncosine_pkg.vhd\nshaders/quadratic_shader.vhd\n");
  }

  void add_triangle(unsigned count) {
    const auto triangle = static_cast<std::uint32_t>(0xfffffff0U + 3 * init_.size());
    const std::uint32_t y = 4095 - static_cast<std::uint32_t>(init_.size());
    init_.words.push_back(count | triangle << 12);
    init_.words.push_back(triangle >> 20 | y << 12 | 0x5a000000);
    init_.words.push_back(0x1ab);
    for (std::uint32_t x = 0; x < count; ++x) {
      expected_.push_back({.triangle = triangle,
                           .z = count - x,
                           .y = static_cast<std::uint16_t>(y),
                           .x = static_cast<std::uint16_t>(x),
                           .red = static_cast<std::uint8_t>(x),
                           .green = static_cast<std::uint8_t>(triangle),
                           .blue = 0xa5});
    }
  }

  Result<Trace> ghdl(const GhdlRunOptions& options = {}) {
    const auto init_file = at("init.txt"), trace_file = at("out/ghdl.trace");
    if (auto written = write_init_file(init_file, key_.name(), init_); !written) return written.error();
    auto runner = GhdlRunner::open(key_, folders_);
    if (!runner) return runner.error();
    auto run = runner->run(init_file, trace_file, options);
    if (!run) {
      EXPECT_FALSE(std::filesystem::exists(trace_file));
      return run.error();
    }
    auto trace = read_trace(trace_file, key_.name());
    if (trace) {
      EXPECT_EQ(run->fragments, trace->fragments.size());
      EXPECT_EQ(run->cycles, trace->cycles);
    }
    return trace;
  }

  /// The vectors are given in pieces, as by a caller that streams.
  Result<Trace> verilator(const VerilatorOptions& options = {}, std::size_t most = 1U << 20,
                          std::size_t piece = 2) {
    auto simulator = VerilatorSimulator::open(key_, folders_, options);
    if (!simulator) return simulator.error();
    Trace trace;
    for (std::size_t i = 0; i < init_.size(); i += piece) {
      const std::size_t count = std::min(piece, init_.size() - i);
      const auto words =
          std::span(init_.words).subspan(i * init_.words_per_vector(), count * init_.words_per_vector());
      if (auto run = simulator->run(words, trace.fragments, most); !run) return run.error();
    }
    if (auto done = simulator->finish(trace.fragments, most); !done) return done.error();
    trace.cycles = simulator->cycles();
    return trace;
  }

  void expect_both_fail(const std::string& with, const std::string& in_verilator) {
    EXPECT_TRUE(
        is_error(ghdl({.max_fragments = 1000, .idle_limit = 500, .stall_seed = 9}), ExitCode::differs, with));
    if (in_verilator.empty()) return;
    EXPECT_TRUE(is_error(verilator({.stall_seed = 9, .idle_limit = 500}), ExitCode::differs, in_verilator));
  }

  HardwareKey key_;
  const SimulatorFolders folders_{at("tree"), c_checkout.cache};
  InitStream init_;
  std::vector<Fragment> expected_;
};

}  // namespace halfway
