// SPDX-License-Identifier: Apache-2.0
// The exit codes and messages of halfway_synth, and its cache, with stand-ins for Yosys and nextpnr. GHDL is
// the real one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "designs.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/subprocess.hpp"

namespace halfway::synth {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path c_source = HALFWAY_SOURCE_DIR;

constexpr const char* c_yosys = R"(#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.23' && exit
case "$*" in
  *synth_ecp5*) echo '{"design": {"num_cells_by_type": {"LUT4": 25, "TRELLIS_FF": 24}}}' >cells.json ;;
  *) echo '{"design": {"num_cells_by_type": {"SB_LUT4": 24, "SB_CARRY": 23, "SB_DFFSR": 24}}}' >cells.json ;;
esac
echo >mapped.il
echo '{"modules": {"wrapped": {"ports": {"clk": {"bits": [2]}}, "cells": {}, "netnames": {}}}}' >wrapped.json
)";
constexpr const char* c_nextpnr_ecp5 = R"sh(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ecp5 (Version 0.7)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 TRELLIS_COMB:  40/ 83640    1%' ; exit ;;
  '--85k --package CABGA756 --speed 6 --freq 200 --out-of-context --json'*) ;;
  *) exit 1 ;;
esac
echo '{"fmax": {"clk": {"achieved": 130}}, "critical_paths": []}' >report.json
)sh";
// Seed 2 does not end, with either router: the limit of processor time stops it.
constexpr const char* c_nextpnr = R"sh(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.4)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 ICESTORM_LC:  40/ 7680    1%' ; exit ;;
esac
case "$(ulimit -S -t) $*" in
  '1200 '*' --report report.json' | '2400 '*' --router router1') ;;
  *) exit 1 ;;
esac
echo 1 >>"${0%/*}/placed"
case "$*" in
  *'--seed 2 '*) kill -XCPU $$ ;;
esac
echo '{"utilization": {"ICESTORM_LC": {"used": 40, "available": 7680}}, "fmax": {"clk": {"achieved": 90}},
  "critical_paths": [{"from": "posedge clk", "to": "posedge clk", "path": [
  {"type": "routing", "delay": 1.0, "from": {"cell": "a", "port": "O"}, "to": {"cell": "b", "port": "I0"}}]}]}' >report.json
)sh";

class SynthProgram : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"bin", "tb/evidence/synthesis", "build/cache"})
      must(make_folders(root() / name));
    fs::create_directory_symlink(c_source / "rtl", root() / "rtl");
    fs::create_symlink(c_source / c_accumulator, root() / c_accumulator);
    // GHDL itself checks the VHDL, which takes most of the time.
    ASSERT_TRUE(make_folders(c_source / "build/cache/ghdl"));
    fs::create_directory_symlink(c_source / "build/cache/ghdl", root() / "build/cache/ghdl");
    put("yosys", c_yosys);
    put("nextpnr-ice40", c_nextpnr);
    must(write_file(root() / "tb/evidence/thresholds.toml",
                    "[cells]\ncolumns = [\"LUTs\", \"flip-flops\", \"RAMs\"]\n"
                    "rules = [\"within 3 % or 3\", \"equal\", \"equal\"]\naccumulator_24 = [21, 24, 0]\n"
                    "accumulator_32 = [20, 24, 0]\n[clocks]\nrule = \"within 8 %\"\n"
                    "accumulator_24 = 97.0\naccumulator_32 = 98.0\n"
                    "[clocks_ecp5]\nrule = \"within 8 %\"\nquadratic_shader_grey_published = 100\n"));
  }
  fs::path root() const { return folder_.path(); }
  void put(const char* name, const std::string& text) const {
    must(write_file(root() / "bin" / name, text));
    fs::permissions(root() / "bin" / name, fs::perms::all);
  }
  // Expects the exit code. Returns what the program prints.
  std::string run(int code, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), HALFWAY_SYNTH);
    arguments.insert(arguments.end(), {"--source", root().string()});
    const auto end =
        run_process({.arguments = arguments,
                     .environment = {{"PATH", (root() / "bin").string() + ":" + std::getenv("PATH")}}},
                    "");
    EXPECT_TRUE(end);
    EXPECT_EQ(end->exit_status, code) << end->output;
    return end->output;
  }

 private:
  const TemporaryFolder folder_ = must(TemporaryFolder::make(fs::temp_directory_path()));
};

TEST_F(SynthProgram, ComparesCellsWithThresholds) {
  EXPECT_THAT(run(0, {"cells", "accumulator_24"}),
              HasSubstr("| `accumulator_24` | 24 | 23 | 24 | 0 | 25 | 24 | 0 | 0 |"));
  EXPECT_THAT(run(1, {"cells", "--quick", "accumulator_32"}), HasSubstr("accumulator_32: LUTs is 24"));
}

TEST_F(SynthProgram, ComparesClocksWithThresholds) {
  // Also a placement that does not end is cached.
  for (int time = 0; time < 2; ++time)
    EXPECT_THAT(
        run(0, {"clocks", "accumulator_24"}),
        HasSubstr("| `accumulator_24` | 90.0 | 90 to 90 of 2; nextpnr does not end: 1 | 11.1 | – | `"));
  EXPECT_EQ(must(read_file(root() / "bin/placed")), "1\n1\n1\n1\n");
  EXPECT_THAT(run(1, {"clocks", "--seeds", "1", "accumulator_32"}), HasSubstr("accumulator_32: "));
}

TEST_F(SynthProgram, PlacesOnAnEcp5) {
  put("nextpnr-ecp5", c_nextpnr_ecp5);
  EXPECT_THAT(run(1, {"clocks", "--device", "ecp5", "quadratic_shader_grey_published"}),
              HasSubstr("clocks_ecp5: quadratic_shader_grey_published: it is 130; the threshold is 100"));
  // Entities have no threshold there.
  EXPECT_THAT(run(0, {"clocks", "--device", "ecp5", "--seeds", "2", "accumulator_24"}),
              ::testing::ContainsRegex(
                  "[|] `accumulator_24` [|] 130.0 [|] 130 to 130 of 2 .* 25 [|] 24 [|] 0 [|] 0 [|]"));
  EXPECT_THAT(run(2, {"clocks", "--device", "other", "accumulator_24"}), HasSubstr("other"));
}

TEST_F(SynthProgram, RefusesAnUnknownDesignAndABrokenTool) {
  EXPECT_THAT(run(2, {"cells", "no_such_design"}),
              HasSubstr("no_such_design: no design has this in its name"));
  EXPECT_THAT(run(2, {"cells", "--page", "accumulator_24"}), HasSubstr("PART"));
  put("yosys",
      "#!/bin/sh\n[ \"$1\" = -V ] && echo 'Yosys 0.23' && exit\necho 'ERROR: a broken one' ; exit 1\n");
  EXPECT_THAT(run(3, {"cells", "accumulator_24"}), HasSubstr("ERROR: a broken one"));
}

}  // namespace
}  // namespace halfway::synth
