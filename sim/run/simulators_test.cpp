// SPDX-License-Identifier: Apache-2.0
// Tests both simulators on a small RTL with the shader's ports: both must give the expected fragments and the
// same cycles, and detect each fault.
#include "sim/run/simulators_test.hpp"

#include <tuple>

namespace halfway {
namespace {

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

TEST_F(Simulators, FaultsOfTheHardwareAreSeen) {
  const std::string alarm = "(r.valid and fragment_ready and r.triangle(3) and not r.triangle(31))";
  // With the message of GHDL, and of Verilator if it sees the fault.
  const std::vector<std::tuple<Parts, std::string, std::string>> cases = {
      {{.fault = "if r.left = 9 then v := r; end if;", .valid = "'0' when r.left = 9 else r.valid"},
       "hang",
       "hang"},
      // The fault comes with the last vector's fragment, and a few cycles later when the pipeline is empty.
      {{.alarm = alarm}, "refused a vector", "refused a vector"},
      {{.alarm = alarm, .delay = "4"}, "refused a vector", "refused a vector"},
      // The payload changes only with fragment_ready.
      {{.red = "(7 downto 1 => '0') & fragment_ready"},
       "changed while it was not taken",
       "changed or was withdrawn"},
      {{.fault = "if r.left = 7 and fragment_ready = '0' then v.left := r.left - 1; v.valid := '0'; end if;"},
       "was withdrawn",
       "withdrawn"},
      {{.red = "\"0000000X\" when r.left = 3 else x\"00\""}, "metavalue in fragment", ""}};
  for (const auto& [parts, in_ghdl, in_verilator] : cases) {
    write_rtl(parts);
    expect_both_fail(in_ghdl, in_verilator);
  }
}

TEST_F(Simulators, MoreFragmentsThanAllowedAreSeen) {
  const auto limit = static_cast<std::uint32_t>(expected_.size() - 1);
  EXPECT_TRUE(is_error(ghdl({.max_fragments = limit}), ExitCode::differs));
  EXPECT_TRUE(is_error(verilator({}, limit), ExitCode::differs));
}

TEST_F(Simulators, BrokenRtlIsReportedWithItsLine) {
  write_rtl({.valid = "nonsense"});
  for (const auto& result : {ghdl(), verilator()})
    EXPECT_TRUE(is_error(result, ExitCode::tool_failed, "rtl/shaders/quadratic_shader.vhd:"));
}

TEST_F(Simulators, AWrongInitFileIsBadInput) {
  const auto runner = must(GhdlRunner::open(key_, folders_));
  const auto expect_refused = [&](const std::filesystem::path& file, const char* message) {
    EXPECT_TRUE(is_error(runner.run(file, at("t")), ExitCode::bad_input, message)) << file;
  };
  ASSERT_TRUE(write_init_file(at("other"), "other", {.bits = 80, .words = {1, 2, 3}}));
  expect_refused(at("other"), "not of 73 bits");
  expect_refused(write("cut", "halfway-init 1 k 73\n0000000000000000000\n"), "");
  expect_refused(write("digits", "halfway-init 1 k 73\n000000000000000zzzz\nend 1\n"), "");
  expect_refused(at("none"), "");
}

TEST_F(Simulators, AFullDiskIsReportedAndLeavesNoTrace) {
  const auto runner = must(GhdlRunner::open(key_, folders_));
  const auto init_file = at("init.txt");
  ASSERT_TRUE(write_init_file(init_file, key_.name(), init_));
  // Simulate a full disk: the temporary name is a link to /dev/full.
  const auto trace = at("full.trace");
  std::filesystem::create_symlink("/dev/full", trace.string() + ".part-" + std::to_string(::getpid()));
  EXPECT_TRUE(is_error(runner.run(init_file, trace), ExitCode::tool_failed));
  EXPECT_FALSE(std::filesystem::exists(trace));
}

TEST_F(Simulators, WavesOfAWindowAreWritten) {
  const auto wave_file = at("waves.fst");
  const auto run = must(verilator({.wave_file = wave_file, .waves_from = 10, .waves_to = 60}));
  EXPECT_EQ(run.fragments, expected_);
  ASSERT_TRUE(std::filesystem::exists(wave_file));
  EXPECT_GT(std::filesystem::file_size(wave_file), 400U);
}

}  // namespace
}  // namespace halfway
