// SPDX-License-Identifier: Apache-2.0
#include "sim/study/hardware.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/study/host_setup.hpp"
#include "sim/study/study.hpp"

namespace halfway::study {
namespace {

namespace fs = std::filesystem;

using ::testing::ElementsAre;

// Fast replacements for Yosys and nextpnr with results given in the environment. The clock of a placement is
// 100 to 104 MHz and depends on the seed.
constexpr const char* c_yosys = R"(#!/bin/sh
[ "$1" = -V ] && echo 'Yosys 0.23' && exit
echo >mapped.il
echo '{"modules": {"wrapped": {"ports": {"clk": {"bits": [2]}}, "cells": {}, "netnames": {}}}}' >wrapped.json
case "$*" in
  *synth_ice40*) echo '{"design": {"num_cells_by_type": {"SB_LUT4": '$LUTS', "SB_DFF": 4}}}' >cells.json ;;
  *) echo '{"design": {"num_cells_by_type": {"$lut": 20, "$_DFF_P_": '$FLIP_FLOPS$PRODUCT'}}}' >cells.json
     echo '{"modules": {"m": {"cells": {"c": {"type": "multiplier_cell", "connections": {"A": [2, 3],
       "B": [4, 5], "Y": [6, 7]}, "parameters": {"A_SIGNED": "0", "B_SIGNED": "0"}}}}}}' >multipliers.json ;;
esac
)";
constexpr const char* c_nextpnr = R"(#!/bin/sh
[ "$1" = --version ] && echo 'nextpnr-ice40 (Version 0.4)' && exit
case "$*" in
  *--pack-only*) echo 'Info: 	 ICESTORM_LC:  '$PACKED'/ 7680    1%' ; exit ;;
esac
seed=${*##*--seed } ; seed=${seed%% *}
echo "$seed" >>"$LOG"
echo '{"utilization": {"ICESTORM_LC": {"used": 40, "available": 7680}}, "critical_paths": [],
  "fmax": {"clk": {"achieved": '$((100 + seed * 7 % 5))'}}}' >report.json
)";

class HardwareFiguresTest : public FolderTest {
 protected:
  void SetUp() override {
    // This tree has its own stored clocks.
    for (const char* name : {"docs/results", "sim"}) ASSERT_TRUE(make_folders(folders_.source / name));
    fs::create_directory_symlink(c_source_folder / "rtl", folders_.source / "rtl");
    for (const auto& entry : fs::directory_iterator(c_source_folder / "sim"))
      if (entry.is_directory())
        fs::create_directory_symlink(entry.path(), folders_.source / "sim" / entry.path().filename());
    // Share GHDL's cache, because analysis takes longest.
    ASSERT_TRUE(make_folders(folders_.cache));
    ASSERT_TRUE(make_folders(c_checkout.cache / "ghdl"));
    fs::create_directory_symlink(c_checkout.cache / "ghdl", folders_.cache / "ghdl");
    put_program(at("bin/yosys"), c_yosys);
    put_program(at("bin/nextpnr-ice40"), c_nextpnr);
    ::setenv("PATH", (at("bin").string() + ":" + path_).c_str(), 1);
    ::setenv("LOG", log().c_str(), 1);
    ::unsetenv("PRODUCT");
    set_results("4", "30", "6912");  // as full as can be placed
    key_ = hardware_of(point_, drawn_scene(scene_, c_built_in_scenes, point_)).key;
    Record record{point_, {}};
    record.measured.hardware = key_.name();
    records_ = {record};
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void store(const synth::ClockStore& clocks) const {
    ASSERT_TRUE(synth::write_clocks(folders_.source, *family_, clocks));
  }
  /// A clock of the hardware that was placed elsewhere.
  synth::StoredClock stored_clock() const {
    const synth::Design design{.entity = key_.entity(), .generics = key_.generics(), .root = c_source_folder};
    return {.cells = {1, 2, 3, 4},
            .mhz = 87.5,
            .seeds = 3,
            .tools = "Placer 1",
            .netlist = synth::netlist_identity(synth::netlist_of(design, folders_.cache))};
  }
  static void set_results(const char* flip_flops, const char* luts, const char* packed) {
    ::setenv("FLIP_FLOPS", flip_flops, 1);
    ::setenv("LUTS", luts, 1);
    ::setenv("PACKED", packed, 1);
  }
  fs::path log() const { return at("placements"); }
  std::size_t placements() const {
    const auto text = read_file(log());
    return text ? static_cast<std::size_t>(std::ranges::count(*text, '\n')) : 0;
  }
  synth::Cost figures(bool place) const {
    return hardware_figures(scene_, records_, folders_, {.threads = 2, .place = place, .family = family_})
        .at(key_.name());
  }

  const std::string path_ = std::getenv("PATH");
  const std::string scene_ = c_source_folder / "sim/study/spaces/sphere.toml";
  const DesignPoint point_{.method = Method::quadratic, .preset = Preset::published, .size = {160, 120}};
  const synth::Family* family_ = &synth::c_ice40;
  const SimulatorFolders folders_{at("source"), at("cache")};
  HardwareKey key_;
  std::vector<Record> records_;
};

TEST_F(HardwareFiguresTest, AStoredClockIsUsedForTheSameNetlistOrOfAnotherGhdlForTheSameHardware) {
  EXPECT_EQ(figures(false).clock, synth::c_not_placed);
  const auto with = [&](const synth::StoredClock& clock, bool place = false) {
    store({{"any", clock}});
    return figures(place);
  };
  const synth::StoredClock clock = stored_clock();
  const synth::Cost stored = with(clock, true);
  EXPECT_EQ(stored.mhz, 87.5);
  EXPECT_EQ(stored.clock, synth::c_stored);
  EXPECT_EQ(stored.device_cells, (Cells{1, 2, 3, 4}));
  EXPECT_EQ(stored.tools, "placed with Placer 1, cells by Yosys 0.23");
  synth::StoredClock of_another = clock;
  of_another.netlist += "0";
  EXPECT_FALSE(with(of_another).mhz);
  // Of another GHDL, whose netlist cannot be compared; of this one, it is other hardware.
  of_another.hardware = key_.name();
  of_another.tools = synth::ghdl_name() + ", Placer 1";
  EXPECT_FALSE(with(of_another).mhz);
  of_another.tools = "GHDL 0, Placer 1";
  const synth::Cost other = with(of_another, true);
  EXPECT_EQ(other.mhz, 87.5);
  EXPECT_THAT(other.tools,
              ::testing::HasSubstr("GHDL 0, Placer 1, from a netlist that this GHDL does not write"));
  of_another.hardware += "-fraction12";
  EXPECT_FALSE(with(of_another).mhz);
  // Hardware that has no placement.
  const synth::Cost large =
      with({.cells = {7681, 2, 3, 4}, .tools = "Placer 1", .netlist = clock.netlist}, true);
  EXPECT_FALSE(large.mhz);
  EXPECT_FALSE(large.fits);
  EXPECT_EQ(large.clock, "does not fit the HX8K: 7681 LUTs of 7680");
  EXPECT_EQ(placements(), 0U);
}

TEST_F(HardwareFiguresTest, HardwareThatDoesNotFitHasAReasonInsteadOfAClock) {
  const auto why = [&](const char* flip_flops, const char* luts, const char* packed) {
    fs::remove_all(folders_.cache / "synth");
    set_results(flip_flops, luts, packed);
    const synth::Cost none = figures(true);
    EXPECT_FALSE(none.mhz);
    EXPECT_FALSE(none.fits);
    return none.clock;
  };
  EXPECT_EQ(why("4", "30", "6913"), "too full: 6913 of the HX8K's 7680 logic cells");
  EXPECT_EQ(why("4", "7681", "40"), "does not fit the HX8K: 7681 LUTs of 7680");
  // Reported before synthesis for the device.
  EXPECT_EQ(why("7681", "NONE", "40"), "does not fit the HX8K: 7681 flip-flops of 7680");
  EXPECT_EQ(placements(), 0U);
}

// Each device has its own clocks, cells and limits, for the same netlist.
TEST_F(HardwareFiguresTest, CostsAreThoseOfTheDevice) {
  synth::StoredClock clock = stored_clock();
  store({{"any", clock}});
  EXPECT_EQ(figures(false).device, "iCE40 HX8K");
  family_ = &synth::c_ecp5;
  EXPECT_FALSE(figures(false).mhz);
  set_results("7681", "30", "40");
  EXPECT_TRUE(figures(false).fits);
  clock.cells = {.luts = 5, .multipliers = 6};
  clock.mhz = 120.5;
  store({{"any", clock}});
  const synth::Cost stored = figures(false);
  EXPECT_EQ(stored.device, "ECP5 LFE5U-85F");
  EXPECT_EQ(stored.mhz, 120.5);
  EXPECT_EQ(stored.device_cells, (Cells{.luts = 5, .multipliers = 6}));
  store({{"any", {.cells = {.multipliers = 157}, .tools = "Placer 2", .netlist = clock.netlist}}});
  EXPECT_EQ(figures(false).clock, "does not fit the LFE5U-85F: 157 multipliers of 156");
}

// Where a device has multipliers, products in LUTs say nothing about its room.
TEST_F(HardwareFiguresTest, ProductsFillOnlyADeviceWithoutMultipliers) {
  const auto fits = [&](const synth::Family& family) {
    family_ = &family;
    return figures(false).fits;
  };
  set_results("83641", "30", "40");
  EXPECT_FALSE(fits(synth::c_ecp5));
  set_results("4", "83641", "40");
  ::setenv("PRODUCT", ", \"multiplier_cell\": 1", 1);
  std::filesystem::remove_all(folders_.cache / "synth");
  EXPECT_FALSE(fits(synth::c_ice40));
  EXPECT_TRUE(fits(synth::c_ecp5));
}

// The stored clocks must be of the netlists of the current RTL, by the GHDL that they were placed with.
TEST(StudyClocks, AreThoseOfTheSmallStudysHardware) {
  auto points = read_space(c_source_folder / "sim/study/spaces/small.toml");
  std::erase_if(points, [](const DesignPoint& point) {
    return point.method == Method::processors_1 || point.method == Method::processors_2;
  });
  const std::string scene = c_source_folder / "sim/study/spaces/sphere.toml";
  const synth::Costing costing(c_checkout, synth::c_ice40);
  std::size_t clocks = 0;
  for (const synth::Design& design : hardware_of_space(scene, points, c_checkout)) {
    const synth::Cost cost = costing.stored(design);
    EXPECT_EQ(cost.clock == synth::c_stored, cost.mhz.has_value());
    EXPECT_NE(cost.clock, synth::c_not_placed) << design.name << ": make evidence PAGE=clocks places it";
    clocks += cost.mhz ? 1 : 0;
  }
  EXPECT_GT(clocks, 18U);
}

// Placements as pieces of a study: the cache entries of all parts suffice for the table.
TEST_F(HardwareFiguresTest, PlacementsAreSpreadOverParts) {
  StudySettings settings{.scene = scene_,
                         .points = {{.method = Method::gouraud, .size = {32, 24}}},
                         .out = at("out"),
                         .parts = synth::c_seeds,
                         .folders = folders_,
                         .placed = {point_},
                         .family = family_};
  EXPECT_EQ(most_parts(settings), synth::c_seeds);
  const auto open = [&] { return open_parts(settings); };
  const auto run = [&](std::size_t part) {
    settings.part = part;
    return run_study(settings).placements;
  };
  EXPECT_THAT(open(), ElementsAre(0U, 1U, 2U));
  EXPECT_EQ(run(1), 1U);
  EXPECT_EQ(text_of(log()), "2\n");
  EXPECT_THAT(open(), ElementsAre(0U, 2U));
  EXPECT_EQ(run(1), 0U);
  EXPECT_EQ(run(2) + run(0), 2U);
  EXPECT_TRUE(open().empty());
  // The clock is the median of all seeds: 102, 104, 101.
  const synth::Cost placed = figures(true);
  EXPECT_EQ(placed.mhz, 102.0);
  EXPECT_EQ(placed.clock, "placed");
  EXPECT_TRUE(placed.fits);
  EXPECT_EQ(placed.device_cells, (Cells{.luts = 30, .flip_flops = 4}));
  EXPECT_THAT(placed.tools, ::testing::MatchesRegex(
                                "cells by Yosys 0.23, placed with GHDL .*, Yosys 0.23, nextpnr-ice40 0.4"));
  EXPECT_EQ(placements(), synth::c_seeds);
  // Changing the RTL makes the piece open again.
  fs::remove(folders_.source / "rtl");
  fs::copy(c_source_folder / "rtl", folders_.source / "rtl", fs::copy_options::recursive);
  write("source/rtl/notes", "another");
  EXPECT_THAT(open(), ElementsAre(0U, 1U, 2U));
}

TEST_F(HardwareFiguresTest, APieceThatDoesNotFitIsDone) {
  set_results("4", "7681", "40");
  const StudySettings settings{
      .scene = scene_, .out = at("out"), .folders = folders_, .placed = {point_}, .family = family_};
  EXPECT_EQ(run_study(settings).placements, synth::c_seeds);
  EXPECT_EQ(placements(), 0U);
  EXPECT_TRUE(open_parts(settings).empty());
}

TEST(HostWork, IsSharedOnlyIfItIsTheSame) {
  std::map<std::string, std::array<std::uint64_t, 4>> known;
  std::size_t points = 0;
  for (DesignPoint point : read_space(c_source_folder / "sim/study/spaces/designs.toml")) {
    if (!in_hardware(point.method)) continue;
    point.size = {64, 48};
    ++points;
    const Scene scene = drawn_scene("spheres", c_built_in_scenes, point);
    const PointHardware hardware = hardware_of(point, scene);
    const HostWork work =
        set_up_frame(scene, point.size, hardware.key, frame_setup(point, scene), hardware.models);
    const std::array numbers = {work.words, work.counts.leaves, work.counts.records, work.counts.shaded};
    EXPECT_EQ(known.try_emplace(point.host_work(), numbers).first->second, numbers) << point.name();
  }
  EXPECT_LT(known.size(), points / 2);
}

}  // namespace
}  // namespace halfway::study
