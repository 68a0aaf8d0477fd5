// SPDX-License-Identifier: Apache-2.0
#include "sim/study/hardware.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sim/study/pictures.hpp"
#include "sim/study/study.hpp"
#include "sim/synth/pinned.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"
#include "sim/system/test/source_folder.hpp"

namespace halfway::study {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;

// Fast replacements for Yosys and nextpnr with given results. The clock of a placement is 100 to 104 MHz and
// depends on the seed.
constexpr const char* c_yosys = R"(#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.23' && exit
echo >mapped.il
echo '{"modules": {"wrapped": {"ports": {"clk": {"bits": [2]}}, "cells": {}, "netnames": {}}}}' >wrapped.json
case "$*" in
  *synth_ice40*) echo '{"design": {"num_cells_by_type": {"SB_LUT4": LUTS, "SB_DFF": 4}}}' >cells.json ;;
  *) echo '{"design": {"num_cells_by_type": {"$lut": 20, "$_DFF_P_": FLIP_FLOPS}}}' >cells.json ;;
esac
)";
constexpr const char* c_nextpnr = R"(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.4)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 ICESTORM_LC:  PACKED/ 7680    1%' ; exit ;;
esac
seed=${*##*--seed } ; seed=${seed%% *}
echo "$seed" >>'LOG'
echo '{"utilization": {"ICESTORM_LC": {"used": 40, "available": 7680}}, "critical_paths": [],
  "fmax": {"clk": {"achieved": '$((100 + seed * 7 % 5))'}}}' >report.json
)";

class HardwareFiguresTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folders_ = {folder_.path() / "source", folder_.path() / "cache"};
    // This tree has its own folders for pinned clocks.
    for (const char* name : {"tb/synth", "sim/studies"}) ASSERT_TRUE(make_folders(folders_.source / name));
    fs::create_directory_symlink(c_source_folder / "rtl", folders_.source / "rtl");
    for (const auto& entry : fs::directory_iterator(c_source_folder / "sim"))
      if (entry.is_directory() && entry.path().filename() != "studies")
        fs::create_directory_symlink(entry.path(), folders_.source / "sim" / entry.path().filename());
    // Share GHDL's cache, because analysis takes longest.
    ASSERT_TRUE(make_folders(folders_.cache));
    ASSERT_TRUE(make_folders(c_source_folder / "build/cache/ghdl"));
    fs::create_directory_symlink(c_source_folder / "build/cache/ghdl", folders_.cache / "ghdl");
    pin("");
    put_tools("4", "30", "40");
    const auto scene = must(drawn_scene(scene_, c_source_folder / "sim/scenes", point_));
    const auto hardware = must(hardware_of(point_, scene));
    key_ = hardware.key;
    Record record{point_, {}};
    record.measured.hardware = key_.name();
    records_ = {record};
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void pin(const std::string& lines) const {
    ASSERT_TRUE(write_file(folders_.source / "tb/synth/pinned.txt", lines));
  }
  void put_tools(const std::string& flip_flops, const std::string& luts, const std::string& packed) {
    using Words = std::vector<std::pair<std::string, std::string>>;
    const fs::path bin = folder_.path() / "bin";
    ASSERT_TRUE(make_folders(bin));
    const auto put = [&](const char* name, std::string text, const Words& words) {
      for (const auto& [what, by] : words) {
        const std::size_t at = text.find(what);
        ASSERT_NE(at, std::string::npos);
        text.replace(at, what.size(), by);
      }
      ASSERT_TRUE(write_file(bin / name, text));
      fs::permissions(bin / name, fs::perms::all);
    };
    put("yosys", c_yosys, {{"FLIP_FLOPS", flip_flops}, {"LUTS", luts}});
    put("nextpnr-ice40", c_nextpnr, {{"LOG", log().string()}, {"PACKED", packed}});
    ::setenv("PATH", (bin.string() + ":" + path_).c_str(), 1);
  }
  fs::path log() const { return folder_.path() / "placements"; }
  std::size_t placements() const {
    const auto text = read_file(log());
    return text ? static_cast<std::size_t>(std::ranges::count(*text, '\n')) : 0;
  }
  Result<GhdlLibrary> synthesis_library() const {
    const auto tool = GhdlTool::find();
    if (!tool) return tool.error();
    const auto sources = read_rtl_sources(c_source_folder);
    if (!sources) return sources.error();
    return GhdlLibrary::for_synthesis(*tool, *sources, folders_.cache);
  }
  HardwareFigures figures(bool place) const {
    return must(hardware_figures(scene_, records_, folders_, {.threads = 2, .place = place})).at(key_.name());
  }

  const std::string path_ = std::getenv("PATH");
  const std::string scene_ = c_source_folder / "sim/studies/sphere.toml";
  const DesignPoint point_{.method = Method::quadratic, .preset = Preset::published, .size = {160, 120}};
  const TemporaryFolder folder_ = must(TemporaryFolder::make(fs::temp_directory_path()));
  SimulatorFolders folders_;
  HardwareKey key_;
  std::vector<Record> records_;
};

// Hardware that does not fit has the clock of the slowest pinned part inside it as an upper bound. The part
// is found by its netlist.
TEST_F(HardwareFiguresTest, HardwareThatDoesNotFitIsBoundedByItsSlowestPart) {
  const auto library = must(synthesis_library());
  const auto line = [&](const char* entity, const std::vector<std::pair<std::string, std::string>>& generics,
                        double mhz) {
    const auto hash =
        must(synth::netlist_hash(library, {.name = "x", .entity = entity, .generics = generics}));
    return fmt::format("{}_{:.0f} 1 1 1 0 {:.1f} {}\n", entity, mhz, mhz, hash);
  };
  const std::string saturate =
      line("saturate", {{"g_value_bits", "32"}, {"g_fraction_bits", "20"}, {"g_result_bits", "8"}}, 90);
  pin(fmt::format("flow {}\n{}{}{}{}", synth::flow_hash(), saturate,
                  line("quadratic_interpolator", {{"g_exact", "false"}, {"g_parts", "2"}}, 80),
                  line("quadratic_interpolator", {{"g_exact", "true"}, {"g_parts", "2"}}, 20),  // not inside
                  line("dot_product", {{"g_bits", "16"}}, 10)));                                // not inside
  put_tools("9000", "30", "40");
  const HardwareFigures bounded = figures(false);
  EXPECT_FALSE(bounded.fits);
  EXPECT_FALSE(bounded.mhz);
  ASSERT_TRUE(bounded.part_mhz);
  EXPECT_EQ(*bounded.part_mhz, 80.0);
  EXPECT_EQ(bounded.slowest_part, "quadratic_interpolator_80");
  // No part is placed.
  pin("");
  EXPECT_FALSE(figures(false).part_mhz);
}

TEST_F(HardwareFiguresTest, APinnedClockIsUsedForTheSameNetlistOnly) {
  const HardwareFigures none = figures(false);
  EXPECT_FALSE(none.mhz);
  EXPECT_EQ(none.clock, "not placed");
  const auto library = must(synthesis_library());
  const auto hash = must(synth::netlist_hash(
      library, {.name = "another", .entity = key_.entity(), .generics = key_.generics()}));
  const std::string flow = fmt::format("flow {}\n", synth::flow_hash());
  pin(flow + fmt::format("any 1 2 3 4 87.5 {}\n", hash));
  const HardwareFigures pinned = figures(true);
  EXPECT_EQ(pinned.mhz, 87.5);
  EXPECT_EQ(pinned.clock, "pinned");
  EXPECT_EQ(pinned.tools, "cells by Yosys 0.23");
  EXPECT_EQ(placements(), 0U);
  ASSERT_TRUE(synth::write_pins(folders_.source / "tb/synth/pinned.txt",
                                {{"any", {{1, 2, 3, 4}, 87.5, hash}}}, "Placer 1, Router 2.5"));
  EXPECT_EQ(figures(false).tools, "pinned with Placer 1, Router 2.5, cells by Yosys 0.23");
  std::string other = hash;
  other[0] = other[0] == '0' ? '1' : '0';
  pin(flow + fmt::format("any 1 2 3 4 87.5 {}\n", other));
  EXPECT_FALSE(figures(false).mhz);
  pin(fmt::format("any 1 2 3 4 87.5 {}\n", hash));  // of an unknown flow
  EXPECT_FALSE(figures(false).mhz);
}

TEST_F(HardwareFiguresTest, AClockIsTheMedianOfAllSeedsAndIsCached) {
  const HardwareFigures placed = figures(true);
  // 102, 104, 101
  EXPECT_EQ(placed.mhz, 102.0);
  EXPECT_EQ(placed.clock, "placed");
  EXPECT_TRUE(placed.fits);
  EXPECT_EQ(placed.ice40, (synth::Ice40Cells{.luts = 30, .flip_flops = 4}));
  EXPECT_THAT(placed.tools, ::testing::MatchesRegex(
                                "cells by Yosys 0.23, placed with GHDL .*, Yosys 0.23, nextpnr-ice40 0.4"));
  EXPECT_EQ(placements(), synth::c_seeds);
  EXPECT_EQ(figures(true).mhz, 102.0);
  EXPECT_EQ(placements(), synth::c_seeds);
}

TEST_F(HardwareFiguresTest, HardwareThatDoesNotFitHasAReasonInsteadOfAClock) {
  const auto why = [&](const char* flip_flops, const char* luts, const char* packed) {
    for (const char* made : {"yosys", "synth"}) fs::remove_all(folders_.cache / made);
    put_tools(flip_flops, luts, packed);
    const HardwareFigures none = figures(true);
    EXPECT_FALSE(none.mhz);
    EXPECT_FALSE(none.fits);
    return none.clock;
  };
  EXPECT_EQ(why("4", "30", "7000"), "too full: 7000 of the HX8K's 7680 logic cells");
  EXPECT_EQ(why("4", "7681", "40"), "does not fit the HX8K: 7681 LUTs of 7680");
  // Reported before synthesis for the device.
  EXPECT_EQ(why("7681", "NONE", "40"), "does not fit the HX8K: 7681 flip-flops of 7680");
  EXPECT_EQ(placements(), 0U);
}

TEST_F(HardwareFiguresTest, PlacedClocksCanBePinned) {
  const auto table = [&](bool place) {
    return must(hardware_figures(scene_, records_, folders_, {.threads = 2, .place = place}));
  };
  const auto pins = [&] { return must(synth::read_pins(folders_.source / synth::c_study_pins)); };
  const auto pinned = [&](const HardwareTable& of) { return must(pin_clocks(of, folders_)); };
  EXPECT_EQ(pinned(table(false)), 0U);  // no clock is known yet
  EXPECT_EQ(pinned(table(true)), 1U);
  const synth::Ice40Cells cells{.luts = 30, .flip_flops = 4};
  EXPECT_EQ(pins().at(key_.name()).cells, cells);
  for (const bool place : {false, true}) {
    const HardwareFigures figures = table(place).at(key_.name());
    EXPECT_EQ(figures.mhz, 102.0);
    EXPECT_EQ(figures.clock, "pinned");
    EXPECT_EQ(figures.ice40, cells);
  }
  EXPECT_EQ(placements(), synth::c_seeds);
  // Pins of other hardware stay if they have the same flow.
  synth::Pins others = pins();
  others["other"] = {{1, 2, 3, 4}, 50.0, std::string(32, 'a')};
  ASSERT_TRUE(synth::write_study_pins(folders_.source / synth::c_study_pins, others, "tools"));
  EXPECT_EQ(pinned(table(false)), 2U);
  EXPECT_EQ(pins().at("other").mhz, 50.0);
  // A design's own pin suffices.
  pin(fmt::format("flow {}\nany 1 2 3 4 87.5 {}\n", synth::flow_hash(), pins().at(key_.name()).netlist));
  EXPECT_EQ(pinned(table(false)), 1U);
  EXPECT_EQ(table(false).at(key_.name()).mhz, 87.5);
  pin("");
  for (const char* made : {"yosys", "synth"}) fs::remove_all(folders_.cache / made);
  put_tools("4", "7681", "40");
  EXPECT_EQ(pinned(table(true)), 2U);
  const HardwareFigures large = table(false).at(key_.name());
  EXPECT_FALSE(large.mhz);
  EXPECT_FALSE(large.fits);
  EXPECT_EQ(large.clock, "does not fit the HX8K: 7681 LUTs of 7680");
}

// The pinned clocks must match the netlists of the current RTL.
TEST(StudyClocks, MatchTheSmallStudysHardware) {
  const auto pins = must(synth::read_pins(c_source_folder / synth::c_study_pins));
  const auto points = must(read_space((c_source_folder / "sim/studies/small.toml").string()));
  const std::string scene = c_source_folder / "sim/studies/sphere.toml";
  const SimulatorFolders folders{c_source_folder, c_source_folder / "build/cache"};
  std::vector<Record> records;
  for (const DesignPoint& point : points) {
    if (!in_hardware(point.method)) continue;
    const auto drawn = must(drawn_scene(scene, c_source_folder / "sim/scenes", point));
    const auto hardware = hardware_of(point, drawn);
    if (!hardware) continue;  // this hardware cannot draw the scene
    records.push_back({point, {}});
    records.back().measured.hardware = hardware->key.name();
  }
  const auto table = must(hardware_figures(scene, records, folders, {.threads = 2, .cells = false}));
  std::size_t clocks = 0;
  for (const auto& [name, figures] : table) {
    clocks += figures.mhz ? 1 : 0;
    const auto pin = pins.find(name);
    if (pin != pins.end()) {
      EXPECT_EQ(pin->second.netlist, figures.netlist) << name;
    }
    // Most processors are too large for the device by their multipliers alone; that is known without
    // synthesis for it.
    if (!name.starts_with("processors")) {
      EXPECT_NE(figures.clock, c_not_placed)
          << name << ": not pinned; make study PLACE=1 PIN=1 places it, minutes for each seed";
    }
  }
  EXPECT_GT(clocks, 18U);
}

// Placements as pieces of a study: the cache entries of all parts suffice for the table.
TEST_F(HardwareFiguresTest, PlacementsAreSpreadOverParts) {
  StudySettings settings{.scene = scene_,
                         .points = {{.method = Method::gouraud, .size = {32, 24}}},
                         .out = folder_.path() / "out",
                         .parts = synth::c_seeds,
                         .folders = folders_,
                         .placed = {point_}};
  EXPECT_EQ(most_parts(settings), synth::c_seeds);
  const auto open = [&] { return must(open_parts(settings)); };
  const auto run = [&](std::size_t part) {
    settings.part = part;
    return must(run_study(settings)).placements;
  };
  EXPECT_THAT(open(), ElementsAre(0U, 1U, 2U));
  EXPECT_EQ(run(1), 1U);
  const auto seeds = must(read_file(log()));
  EXPECT_EQ(seeds, "2\n");
  EXPECT_THAT(open(), ElementsAre(0U, 2U));
  EXPECT_EQ(run(1), 0U);
  EXPECT_EQ(run(2) + run(0), 2U);
  EXPECT_TRUE(open().empty());
  EXPECT_EQ(placements(), synth::c_seeds);
  const HardwareFigures placed = figures(true);
  EXPECT_EQ(placed.mhz, 102.0);
  EXPECT_EQ(placed.clock, "placed");
  EXPECT_EQ(placements(), synth::c_seeds);
  // Changing the RTL makes the piece open again.
  fs::remove(folders_.source / "rtl");
  fs::copy(c_source_folder / "rtl", folders_.source / "rtl", fs::copy_options::recursive);
  ASSERT_TRUE(write_file(folders_.source / "rtl/notes", "another"));
  EXPECT_THAT(open(), ElementsAre(0U, 1U, 2U));
}

TEST_F(HardwareFiguresTest, APieceThatDoesNotFitIsDone) {
  put_tools("4", "7681", "40");
  const StudySettings settings{
      .scene = scene_, .out = folder_.path() / "out", .folders = folders_, .placed = {point_}};
  const auto made = must(run_study(settings));
  EXPECT_EQ(made.placements, synth::c_seeds);
  EXPECT_EQ(placements(), 0U);
  const auto parts = must(open_parts(settings));
  EXPECT_TRUE(parts.empty());
}

}  // namespace
}  // namespace halfway::study
