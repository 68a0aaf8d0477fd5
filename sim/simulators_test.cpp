// SPDX-License-Identifier: Apache-2.0
// Tests both simulators on a small RTL with the shader's ports: both must give the expected fragments and the
// same cycles, and detect each fault.
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "common/test/is_error.hpp"
#include "sim/engines/ghdl/ghdl_runner.hpp"
#include "sim/engines/verilator/verilator_simulator.hpp"
#include "sim/extras/lanes/lane_simulator.hpp"
#include "sim/files/init_file.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

const char* const c_package = R"(
package formats_pkg is
  function init_bits(exact : boolean; channels : positive) return positive;
end package;
package body formats_pkg is
  function init_bits(exact : boolean; channels : positive) return positive is
  begin
    if exact then
      return 70 + channels;
    end if;
    return 60;
  end function;
end package body;

package quadratic_pkg is
  function init_bits(exact : boolean; degree, channels : positive) return positive;
end package;
package body quadratic_pkg is
  function init_bits(exact : boolean; degree, channels : positive) return positive is
  begin
    return work.formats_pkg.init_bits(exact, channels);
  end function;
end package body;
)";

// Emits `count` fragments along x for each vector: bits 11..0 count, 43..12 triangle, 55..44 y. The tests
// replace the marks @...@.
const char* const c_shader = R"(
library ieee;
use ieee.std_logic_1164.all;
use ieee.numeric_std.all;
use work.formats_pkg.all;
entity quadratic_shader is
  generic (g_exact : boolean := true; g_channels : positive := 3;
           g_degree : positive := 2);
  port (
    clk, reset : in std_logic;
    init_valid : in std_logic; init_ready : out std_logic;
    init_data : in std_logic_vector(init_bits(g_exact, g_channels) - 1 downto 0);
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
  signal ready, take : std_logic;
begin
  ready      <= not r.valid or (fragment_ready and @LAST@);
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

struct Parts {
  std::string last = "is_last", fault, valid = "r.valid", red = "std_logic_vector(r.x(7 downto 0))";
  std::string alarm = "'0'", delay = "0";
};

void replace(std::string& text, const std::string& what, const std::string& with) {
  for (std::size_t at; (at = text.find(what)) != std::string::npos;) text.replace(at, what.size(), with);
}

class Simulators : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path root = HALFWAY_SOURCE_DIR;
    for (const char* folder : {"sim/extras/lanes", "sim/engines/verilator", "tb"}) {
      std::filesystem::create_directories(folders_.source / folder);
      std::filesystem::copy(root / folder, folders_.source / folder,
                            std::filesystem::copy_options::recursive);
    }
    write_rtl({});
    init_.bits = 73;
    for (const unsigned count : {5U, 0U, 1U, 300U, 2U, 0U, 0U, 77U, 1U}) add_triangle(count);
  }

  void write_rtl(const Parts& parts) {
    std::string text = c_shader;
    replace(text, "@LAST@", parts.last == "is_last" ? "one_left" : parts.last);
    replace(text, "@FAULT@", parts.fault);
    replace(text, "@VALID@", parts.valid);
    replace(text, "@RED@", parts.red);
    replace(text, "@ALARM@", parts.alarm);
    replace(text, "@DELAY@", parts.delay);
    replace(text, "  signal ready, take : std_logic;\nbegin",
            "  signal ready, take : std_logic;\n  signal one_left : std_logic;\nbegin\n"
            "  one_left <= '1' when r.left = 1 else '0';");
    ASSERT_TRUE(write_file(folders_.source / "rtl/formats_pkg.vhd", c_package));
    ASSERT_TRUE(write_file(folders_.source / "rtl/shaders/quadratic_shader.vhd", text));
    ASSERT_TRUE(
        write_file(folders_.source / "rtl/files.f", "formats_pkg.vhd\nshaders/quadratic_shader.vhd\n"));
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
    const auto init_file = scratch_.path() / "init.txt", trace_file = scratch_.path() / "out/ghdl.trace";
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

  Result<std::vector<Fragment>> lanes(std::size_t most = 1U << 20, LaneOptions options = {}) {
    options.fast = false;
    auto simulator = LaneSimulator::open(key_, folders_, options);
    if (!simulator) return simulator.error();
    std::vector<Fragment> fragments;
    if (auto run = simulator->run(init_.words, fragments, most); !run) return run.error();
    return fragments;
  }

  void expect_lanes_fail(const std::string& with) {
    EXPECT_TRUE(is_error(lanes(1U << 20, {.idle_limit = 500}), ExitCode::differs, with));
  }

  void expect_both_fail(const std::string& with, const std::string& in_verilator) {
    EXPECT_TRUE(
        is_error(ghdl({.max_fragments = 1000, .idle_limit = 500, .stall_seed = 9}), ExitCode::differs, with));
    if (in_verilator.empty()) return;
    EXPECT_TRUE(is_error(verilator({.stall_seed = 9, .idle_limit = 500}), ExitCode::differs, in_verilator));
  }

  HardwareKey key_;
  const TemporaryFolder scratch_ = must(TemporaryFolder::make(testing::TempDir()));
  const SimulatorFolders folders_{scratch_.path() / "tree", HALFWAY_CACHE_DIR};
  InitStream init_;
  std::vector<Fragment> expected_;
};

TEST_F(Simulators, BothGiveTheExpectedFragmentsAndCycles) {
  const auto from_ghdl = must(ghdl());
  EXPECT_EQ(from_ghdl.fragments, expected_);
  // One cycle for the first vector, then one per fragment. Each of the three vectors without fragments costs
  // a cycle, because the next vector cannot be accepted together with a last fragment.
  EXPECT_EQ(from_ghdl.cycles, expected_.size() + 1 + 3);
  for (const std::size_t piece : {std::size_t{1}, std::size_t{2}, init_.size()}) {
    const auto from_verilator = must(verilator({}, expected_.size(), piece));
    EXPECT_EQ(from_verilator.fragments, expected_);
    EXPECT_EQ(from_verilator.cycles, from_ghdl.cycles);
  }
}

TEST_F(Simulators, StallsChangeOnlyTheCyclesAndInBothEqually) {
  for (const std::uint32_t seed : {1U, 77U}) {
    const auto from_ghdl = must(ghdl({.stall_seed = seed}));
    EXPECT_EQ(from_ghdl.fragments, expected_);
    EXPECT_GT(*from_ghdl.cycles, expected_.size() + expected_.size() / 2);
    const auto from_verilator = must(verilator({.stall_seed = seed}));
    EXPECT_EQ(from_verilator.fragments, expected_);
    EXPECT_EQ(from_verilator.cycles, from_ghdl.cycles);
  }
}

TEST_F(Simulators, NoVectorsGiveAnEmptyTrace) {
  init_.words.clear();
  const auto from_ghdl = must(ghdl());
  EXPECT_TRUE(from_ghdl.fragments.empty());
  EXPECT_EQ(from_ghdl.cycles, 0U);
  const auto from_verilator = must(verilator());
  EXPECT_TRUE(from_verilator.fragments.empty());
  EXPECT_EQ(from_verilator.cycles, 0U);
}

TEST_F(Simulators, AHangIsSeen) {
  write_rtl({.fault = "if r.left = 9 then v := r; end if;", .valid = "'0' when r.left = 9 else r.valid"});
  expect_both_fail("hang", "hang");
  expect_lanes_fail("hang");
}

TEST_F(Simulators, AFaultThatTheHardwareReportsIsDetected) {
  // The fault comes with the last vector's fragment, and a few cycles later when the pipeline is empty.
  for (const char* delay : {"0", "4"}) {
    write_rtl(
        {.alarm = "(r.valid and fragment_ready and r.triangle(3) and not r.triangle(31))", .delay = delay});
    expect_both_fail("shadow counter", "shadow counter");
    expect_lanes_fail("fault");
  }
}

TEST_F(Simulators, APayloadThatChangesIsDetected) {
  write_rtl({.red = "(7 downto 1 => '0') & fragment_ready"});
  // The payload changes only with fragment_ready.
  expect_both_fail("changed while it was not taken", "changed or was withdrawn");
}

TEST_F(Simulators, AWithdrawnFragmentIsSeen) {
  write_rtl(
      {.fault = "if r.left = 7 and fragment_ready = '0' then v.left := r.left - 1; v.valid := '0'; end if;"});
  expect_both_fail("was withdrawn", "withdrawn");
}

TEST_F(Simulators, AMetavalueIsSeen) {
  write_rtl({.red = "\"0000000X\" when r.left = 3 else x\"00\""});
  expect_both_fail("metavalue in fragment", "");
}

TEST_F(Simulators, MoreFragmentsThanAllowedAreSeen) {
  const auto limit = static_cast<std::uint32_t>(expected_.size() - 1);
  EXPECT_TRUE(is_error(ghdl({.max_fragments = limit}), ExitCode::differs));
  EXPECT_TRUE(is_error(verilator({}, limit), ExitCode::differs));
  EXPECT_TRUE(is_error(lanes(limit), ExitCode::differs));
  EXPECT_TRUE(lanes(limit + 1));
}

TEST_F(Simulators, LanesGiveTheExpectedFragmentsInOrder) {
  for (const unsigned threads : {1U, 3U}) {
    const auto from_lanes = must(lanes(1U << 20, {.threads = threads}));
    EXPECT_EQ(from_lanes, expected_) << threads;
  }
}

TEST_F(Simulators, BrokenRtlIsReportedWithItsLine) {
  write_rtl({.valid = "nonsense"});
  for (const auto& result : {ghdl(), verilator()}) {
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ExitCode::tool_failed);
    EXPECT_NE(result.error().message.find("rtl/shaders/quadratic_shader.vhd:"), std::string::npos)
        << result.error().message;
  }
}

TEST_F(Simulators, AWrongInitFileIsBadInput) {
  const auto init_file = scratch_.path() / "init.txt";
  const auto runner = must(GhdlRunner::open(key_, folders_));
  ASSERT_TRUE(write_init_file(init_file, "other", {.bits = 80, .words = {1, 2, 3}}));
  EXPECT_TRUE(is_error(runner.run(init_file, scratch_.path() / "t"), ExitCode::bad_input, "not of 73 bits"));
  ASSERT_TRUE(write_file(init_file, "halfway-init 1 k 73\n0000000000000000000\n"));
  EXPECT_EQ(runner.run(init_file, scratch_.path() / "t").error().code, ExitCode::bad_input);
  ASSERT_TRUE(write_file(init_file, "halfway-init 1 k 73\n000000000000000zzzz\nend 1\n"));
  EXPECT_EQ(runner.run(init_file, scratch_.path() / "t").error().code, ExitCode::bad_input);
  EXPECT_EQ(runner.run(scratch_.path() / "none", scratch_.path() / "t").error().code, ExitCode::bad_input);
}

TEST_F(Simulators, AFullDiskIsReportedAndLeavesNoTrace) {
  const auto runner = must(GhdlRunner::open(key_, folders_));
  const auto init_file = scratch_.path() / "init.txt";
  ASSERT_TRUE(write_init_file(init_file, key_.name(), init_));
  // Simulate a full disk: the temporary name is a link to /dev/full.
  const auto trace = scratch_.path() / "full.trace";
  std::filesystem::create_symlink("/dev/full", trace.string() + ".part-" + std::to_string(::getpid()));
  EXPECT_TRUE(is_error(runner.run(init_file, trace), ExitCode::tool_failed));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST_F(Simulators, WavesOfAWindowAreWritten) {
  const auto wave_file = scratch_.path() / "waves.fst";
  const auto run = must(verilator({.wave_file = wave_file, .waves_from = 10, .waves_to = 60}));
  EXPECT_EQ(run.fragments, expected_);
  ASSERT_TRUE(std::filesystem::exists(wave_file));
  EXPECT_GT(std::filesystem::file_size(wave_file), 400U);
}

}  // namespace
}  // namespace halfway
