// SPDX-License-Identifier: Apache-2.0
// Caching, and designs that do not fit or whose placement does not end. Yosys and nextpnr are replaced, calls
// of GHDL are counted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "sim/synth/stand_ins_test.hpp"
#include "sim/synth/synthesis.hpp"
#include "sim/system/file.hpp"
#include "sim/system/subprocess.hpp"

namespace halfway::synth {
namespace {

namespace fs = std::filesystem;

constexpr const char* c_entity = R"(library ieee;
use ieee.std_logic_1164.all;

entity wire is
  generic (
    g_bits : positive := 2
  );
  port (
    clk  : in  std_logic;
    word : in  std_logic_vector(g_bits - 1 downto 0);
    same : out std_logic_vector(g_bits - 1 downto 0)
  );
end entity;

architecture rtl of wire is
begin
  same <= word;
end architecture;
)";
constexpr const char* c_yosys = R"(#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.23' && exit
cp '{0}/cells.json' .
echo >mapped.il
echo '{{"modules": {{"wrapped": {{"ports": {{"clk": {{"bits": [2]}}}}, "cells": {{}}, "netnames": {{}}}}}}}}' >wrapped.json
)";
// The placement with seed 2 does not end.
constexpr const char* c_nextpnr = R"(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.4)' && exit
case "$*" in
  *--pack-only*) cat '{0}/packed' ; exit ;;
  *'--seed 2 '*) echo 2 >>'{0}/placed' ; while : ; do : ; done ;;
esac
echo 1 >>'{0}/placed'
echo '{{"utilization": {{"ICESTORM_LC": {{"used": 40, "available": 7680}}}}, "critical_paths": [],
  "fmax": {{"clk": {{"achieved": 100}}}}}}' >report.json
)";

class SynthesizerTest : public StandInTools {
 protected:
  void SetUp() override {
    StandInTools::SetUp();
    if (IsSkipped() || HasFatalFailure()) return;
    ASSERT_TRUE(make_folders(root() / "rtl"));
    ASSERT_TRUE(write_file(root() / "rtl/files.f", "wire.vhd\n"));
    ASSERT_TRUE(write_file(root() / "rtl/wire.vhd", c_entity));
    put("yosys", fmt::format(c_yosys, root().string()));
    put("nextpnr-ice40", fmt::format(c_nextpnr, root().string()));
    ::setenv("PATH", path_before(path_).c_str(), 1);
    tell("\"SB_LUT4\": 30, \"SB_DFF\": 4", 40);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  // Set the results of the replacements.
  void tell(const std::string& cells, int packed) const {
    ASSERT_TRUE(write_file(root() / "cells.json",
                           fmt::format("{{\"design\": {{\"num_cells_by_type\": {{{}}}}}}}", cells)));
    ASSERT_TRUE(
        write_file(root() / "packed", fmt::format("Info: \t ICESTORM_LC:  {}/ 7680    1%\n", packed)));
    std::error_code none;
    fs::remove_all(root() / "cache/synth", none);
  }
  std::size_t lines(const char* log) const {
    const auto text = read_file(root() / log);
    return text ? static_cast<std::size_t>(std::ranges::count(*text, '\n')) : 0;
  }
  Synthesizer open() const {
    return Synthesizer::open({root(), root() / "cache"}, true, {}, std::chrono::seconds(1));
  }
  std::string no_room(const std::string& cells, int packed) const {
    tell(cells, packed);
    return open().no_room(design_);
  }

  const std::string path_ = std::getenv("PATH");
  const Design design_{.name = "wire", .entity = "wire", .generics = {{"g_bits", "3"}}};
};

TEST_F(SynthesizerTest, AnUnfinishedPlacementIsReportedAndCached) {
  for (int time = 0; time < 2; ++time) {
    const Clock clock = open().clock(design_, 3);
    EXPECT_EQ(clock.endless, 1U);
    EXPECT_EQ(clock.none, "");
    ASSERT_EQ(clock.placements.size(), 2U);
    EXPECT_EQ(clock.median()->mhz, 100.0);
  }
  EXPECT_EQ(lines("placed"), 3U);
}

TEST_F(SynthesizerTest, ADesignThatDoesNotFitHasAReason) {
  EXPECT_EQ(no_room("\"SB_LUT4\": 7680, \"SB_RAM40_4K\": 32", 6912), "");
  EXPECT_EQ(no_room("\"SB_LUT4\": 7681", 1), "does not fit the HX8K: 7681 LUTs of 7680");
  EXPECT_EQ(no_room("\"SB_DFFE\": 7681", 1), "does not fit the HX8K: 7681 flip-flops of 7680");
  EXPECT_EQ(no_room("\"SB_RAM40_4K\": 33", 1), "does not fit the HX8K: 33 RAMs of 32");
  EXPECT_EQ(no_room("\"SB_LUT4\": 30", 6913), "too full: 6913 of the HX8K's 7680 logic cells");
}

}  // namespace
}  // namespace halfway::synth
