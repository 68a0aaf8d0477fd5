// SPDX-License-Identifier: Apache-2.0
// The output of halfway_synth, with stand-ins for Yosys and nextpnr.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "designs.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/synth/stand_ins_test.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::synth {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path c_source = HALFWAY_SOURCE_DIR;

constexpr const char* c_yosys = R"(#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.23' && exit
case "$*" in
  *synth_ecp5*) echo '{"design": {"num_cells_by_type": {"LUT4": 24, "TRELLIS_FF": 24}}}' >cells.json ;;
  *) echo '{"design": {"num_cells_by_type": {"SB_LUT4": 24, "SB_CARRY": 23, "SB_DFFSR": 24}}}' >cells.json ;;
esac
echo >mapped.il
echo '{"modules": {"wrapped": {"ports": {"clk": {"bits": [2]}}, "cells": {}, "netnames": {}}}}' >wrapped.json
)";
// Seed 2 does not end; a limit of processor time then stops the real program.
constexpr const char* c_nextpnr = R"(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.4)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 ICESTORM_LC:  40/ 7680    1%' ; exit ;;
  *'--seed 2 '*) kill -XCPU $$ ;;
esac
echo '{"utilization": {"ICESTORM_LC": {"used": 40, "available": 7680}}, "fmax": {"clk": {"achieved": 90}},
  "critical_paths": [{"from": "posedge clk", "to": "posedge clk", "path": [
  {"type": "routing", "delay": 1.0, "from": {"cell": "a", "port": "O"}, "to": {"cell": "b", "port": "I0"}}]}]}' >report.json
)";

struct Outcome {
  int exit_status = -1;
  std::string output, errors;
};

class SynthProgram : public StandInTools {
 protected:
  void SetUp() override {
    StandInTools::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    for (const char* name : {"tb/synth", "cache"}) ASSERT_TRUE(make_folders(root() / name));
    fs::create_directory_symlink(c_source / "rtl", root() / "rtl");
    fs::create_symlink(c_source / c_accumulator, root() / c_accumulator);
    // GHDL itself checks the VHDL, which takes most of the time.
    ASSERT_TRUE(make_folders(c_source / "build/cache/ghdl"));
    fs::create_directory_symlink(c_source / "build/cache/ghdl", root() / "cache/ghdl");
    put("yosys", c_yosys);
    put("nextpnr-ice40", c_nextpnr);
    pin(90);
    ASSERT_TRUE(write_file(page(), "# Page\n\n## Figures\n"));
  }
  fs::path page() const { return root() / "page.md"; }
  void pin(double mhz) const {
    ASSERT_TRUE(write_pins(root() / c_pins, {{"accumulator_24", {.cells = {24, 23, 24, 0}, .mhz = mhz}}},
                           "stand-ins"));
  }
  Outcome run(std::vector<std::string> arguments, const std::string& part = "accumulator_24") const {
    arguments.insert(arguments.begin(), HALFWAY_SYNTH);
    arguments.insert(arguments.end(), {root().string(), (root() / "cache").string(), part});
    return outcome_of(arguments);
  }
  /// stdout and stderr both are its output.
  Outcome run_on_terminal(const std::vector<std::string>& options) const {
    Command program{.arguments = {HALFWAY_SYNTH}};
    program.arguments.insert(program.arguments.end(), options.begin(), options.end());
    program.arguments.insert(program.arguments.end(),
                             {root().string(), (root() / "cache").string(), "accumulator_24"});
    return outcome_of({"script", "--quiet", "--return", "--command", to_string(program), "/dev/null"});
  }

 private:
  Outcome outcome_of(const std::vector<std::string>& arguments) const {
    const auto end = run_process({.arguments = arguments,
                                  .standard_output = root() / "output",
                                  .environment = {{"PATH", path_before(std::getenv("PATH"))}}},
                                 "");
    if (!end) return {-1, "", end.error().message};
    const auto output = read_file(root() / "output");
    return {end->exit_status, output ? *output : "", end->output};
  }
};

TEST_F(SynthProgram, WritesTheRowAndReportsSeedsWithoutEnd) {
  const Outcome outcome = run({"--seeds", "3", "--evidence", "all", "--page", page().string()});
  EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output, HasSubstr("accumulator_24, seed 2: nextpnr does not end"));
  EXPECT_THAT(outcome.output, HasSubstr("0 of 1 designs are not as pinned"));
  const auto text = read_file(page());
  ASSERT_TRUE(text);
  EXPECT_THAT(*text, HasSubstr("| `accumulator_24` | 24 | 23 | 24 | 0 | 90 | 90 to 90 of 2; nextpnr does not "
                               "end: 1 | 11.1 | – | `"));
}

TEST_F(SynthProgram, MeasuresOnlyRowsThatAreStale) {
  const std::vector<std::string> stale = {"--evidence", "stale", "--pin", "--page", page().string()};
  const Outcome first = run(stale);
  EXPECT_EQ(first.exit_status, 0) << first.errors;
  EXPECT_THAT(first.output, HasSubstr("accumulator_24, seed 1: 90.0 MHz"));
  const auto pins = read_pins(root() / c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  EXPECT_FALSE(pins->at("accumulator_24").netlist.empty());
  const Outcome second = run(stale);
  EXPECT_EQ(second.exit_status, 0) << second.errors;
  EXPECT_THAT(second.output, Not(HasSubstr("seed")));
  // A pin of another netlist is stale, too.
  pin(90);
  EXPECT_THAT(run({"--evidence", "check", "--page", page().string()}).errors,
              HasSubstr("accumulator_24: is pinned for another netlist; make evidence"));
  EXPECT_THAT(run(stale).output, HasSubstr("accumulator_24, seed 1: 90.0 MHz"));
}

TEST_F(SynthProgram, PinsOfHowManySeedsAClockIs) {
  const Outcome few = run({"--pin", "--seeds", "1"});
  EXPECT_EQ(few.exit_status, 0) << few.errors;
  EXPECT_THAT(few.errors, HasSubstr("note: 1 clocks are pinned of fewer than the usual 3 seeds"));
  auto pins = read_pins(root() / c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  EXPECT_EQ(pins->at("accumulator_24").seeds, 1U);
  // One of four placements does not end.
  const Outcome enough = run({"--pin", "--seeds", "4"});
  EXPECT_EQ(enough.exit_status, 0) << enough.errors;
  EXPECT_EQ(enough.errors, "");
  pins = read_pins(root() / c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  EXPECT_EQ(pins->at("accumulator_24").seeds, 3U);
  EXPECT_THAT(*read_file(root() / c_pins), Not(::testing::ContainsRegex("[0-9a-f]{32} 3\n")));
}

// One of the two designs is for ECP5 only.
TEST_F(SynthProgram, CountsWhatItPins) {
  const Outcome outcome = run({"--pin", "--seeds", "1"}, "shading_pipeline");
  EXPECT_EQ(outcome.exit_status, 0) << outcome.errors;
  EXPECT_THAT(outcome.output,
              AllOf(HasSubstr("shading_pipeline_exact, ECP5"), HasSubstr("\n1 designs are pinned\n")));
}

// A part of the designs does not have all of README's figures: README stays unchanged.
TEST_F(SynthProgram, PinsAndLeavesReadmeWhereItLacksAClock) {
  const fs::path readme = root() / "readme.md";
  const std::string before = "\n<!-- clocks: written -->\nold\n<!-- end of clocks -->\n";
  ASSERT_TRUE(write_file(readme, before));
  const Outcome outcome = run({"--pin", "--readme", readme.string()});
  EXPECT_EQ(outcome.exit_status, 2);
  EXPECT_THAT(outcome.errors, HasSubstr("quadratic_shader_grey_published: not pinned"));
  EXPECT_EQ(*read_file(readme), before);
  EXPECT_EQ(run({"--readme", readme.string()}).exit_status, 2) << "without pinning";
}

// Measuring takes minutes to hours. Missing or unwritable files are reported before; with --check nothing is
// measured.
TEST_F(SynthProgram, ReportsBadArgumentsBeforeItMeasures) {
  const fs::path missing = root() / "none.md";
  ASSERT_TRUE(write_file(root() / "readme.md", "no such part\n"));
  const std::string readme = (root() / "readme.md").string();
  const std::vector<std::vector<std::string>> cases = {{"--evidence", "all", "--page", missing.string()},
                                                       {"--pin", "--readme", missing.string()},
                                                       {"--pin", "--readme", readme},
                                                       {"--seeds", "0"}};
  for (std::vector<std::string> arguments : cases) {
    for (const bool check : {false, true}) {
      if (check) arguments.insert(arguments.begin(), "--check");
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_status, 2) << arguments.back();
      EXPECT_THAT(outcome.errors, Not(::testing::IsEmpty()));
      EXPECT_EQ(outcome.output, "");
    }
  }
  const Outcome none = run({"--check"}, "no_such_design");
  EXPECT_EQ(none.exit_status, 2);
  EXPECT_THAT(none.errors, HasSubstr("no_such_design: no design has this in its name"));
  const Outcome good = run({"--check", "--evidence", "all", "--page", page().string()});
  EXPECT_EQ(good.exit_status, 0) << good.errors;
  EXPECT_EQ(good.output + good.errors, "");
  ASSERT_TRUE(write_file(root() / c_pins, "accumulator_24 1 2\n"));
  EXPECT_EQ(run({"--check"}).exit_status, 2);
  EXPECT_FALSE(fs::exists(root() / "cache/synth"));
}

// Wrong arguments are reported immediately. The frames take minutes and are drawn after that.
TEST(SynthMakefile, LooksAtTheArgumentsBeforeItDrawsFrames) {
  const auto makefile = read_file(c_source / "Makefile");
  ASSERT_TRUE(makefile);
  const std::size_t rule = makefile->find("\nsynth: ");
  ASSERT_NE(rule, std::string::npos);
  const std::size_t check = makefile->find("halfway_synth --check $(synth_options)", rule),
                    frames = makefile->find("@build/tb/synth_frames", rule),
                    measured = makefile->find("halfway_synth $(synth_options)", rule);
  EXPECT_LT(check, frames);
  EXPECT_LT(frames, measured);
  EXPECT_LT(measured, makefile->find("\n\n", rule));
}

TEST_F(SynthProgram, SaysOnStderrWhatIsNotAsPinnedAndWhere) {
  pin(120);
  const Outcome outcome = run({"--seeds", "1"});
  EXPECT_EQ(outcome.exit_status, 1);
  EXPECT_THAT(outcome.errors,
              ::testing::StartsWith("tb/synth/pinned.txt:7: accumulator_24: 90.0 MHz, 120.0 are"));
  EXPECT_THAT(outcome.output, HasSubstr("1 of 1 designs are not as pinned"));
}

// Running jobs are shown in one line that is overwritten. Without a terminal they are not shown.
TEST_F(SynthProgram, ShowsOnATerminalAloneWhatIsUnderWay) {
  ASSERT_FALSE(find_program("script").empty()) << "no script: apt-get install bsdutils";
  const std::vector<std::string> arguments = {"--seeds", "1", "--jobs", "1"};
  const Outcome elsewhere = run(arguments);
  EXPECT_EQ(elsewhere.exit_status, 0) << elsewhere.errors;
  EXPECT_THAT(elsewhere.output + elsewhere.errors, Not(HasSubstr("\033")));
  const Outcome terminal = run_on_terminal(arguments);
  EXPECT_EQ(terminal.exit_status, 0) << terminal.output << terminal.errors;
  const std::string over = "\r\033[K";
  for (const char* shown : {"cells: 0 of 2; accumulator_24, iCE40", "cells: 1 of 2; accumulator_24, ECP5",
                            "clocks: 0 of 1; accumulator_24, seed 1"})
    EXPECT_THAT(terminal.output, HasSubstr(over + shown + over)) << shown;
  for (const char* said : {"[1/2] accumulator_24, iCE40: 24 LUTs", "[2/2] accumulator_24, ECP5: 24 LUTs",
                           "[1/1] accumulator_24, seed 1: 90.0 MHz"})
    EXPECT_THAT(terminal.output, HasSubstr(over + said)) << said;
  // Nothing remains below the table.
  EXPECT_GT(terminal.output.find("| design |"), terminal.output.rfind(over));
}

TEST_F(SynthProgram, ReportsABrokenToolOnStderrAndComparesNothing) {
  put("yosys",
      "#!/bin/sh\n[ \"$1\" = -V ] && echo 'Yosys 0.23' && exit\necho 'ERROR: a broken one' ; exit 1\n");
  const Outcome outcome = run({"--quick", "--cells"});
  EXPECT_EQ(outcome.exit_status, 3);
  EXPECT_THAT(outcome.errors, HasSubstr("ERROR: a broken one"));
  EXPECT_THAT(outcome.errors, HasSubstr("1 figures could not be had"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("broken")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("as pinned")));
}

}  // namespace
}  // namespace halfway::synth
