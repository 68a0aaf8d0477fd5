// SPDX-License-Identifier: Apache-2.0
#include "sim/cost/generic_cells.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <tuple>

#include "common/test/is_error.hpp"
#include "sim/cost/synthesis.hpp"
#include "sim/engines/ghdl/ghdl_library.hpp"
#include "sim/os/test/folder_test.hpp"

namespace halfway::synth {
namespace {

class CellsTest : public FolderTest {
 protected:
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  /// Put a replacement for Yosys at the front of PATH.
  void put_yosys(const std::string& script) {
    put_program(at("bin/yosys"), "#!/bin/sh\n" + script);
    ::setenv("PATH", (at("bin").string() + ":" + path_).c_str(), 1);
  }
  Result<Cells> count(const HardwareKey& key) const {
    return caught([&] {
      return Synthesizer::open(folders_.cache, false).generic_cells(design_of(key, folders_.source));
    });
  }
  std::size_t cached() const {
    std::error_code error;
    const std::filesystem::directory_iterator entries(folders_.cache / "synth", error);
    return static_cast<std::size_t>(std::distance(begin(entries), end(entries)));
  }

  const std::string path_ = std::getenv("PATH");
  const HardwareKey grey_{.channels = 1}, coloured_{.channels = 3};
  SimulatorFolders folders_{HALFWAY_SOURCE_DIR, at("cache")};
};

TEST_F(CellsTest, FewerEffectsTakeFewerCells) {
  ASSERT_FALSE(find_program("yosys").empty()) << "no yosys: " << c_install_tools;
  const Cells grey = must(count(grey_)), coloured = must(count(coloured_));
  // A channel has six line interpolators of 40 bits, six constant words, and ten words for each of the
  // waiting triangles.
  const std::uint64_t flip_flops = coloured.flip_flops - grey.flip_flops;
  EXPECT_GT(flip_flops, 2 * 6 * 40U);
  EXPECT_LT(flip_flops, 2 * 40 * 40U);
  EXPECT_GT(coloured.luts, grey.luts + 2 * 6 * 40U);  // an adder takes at least one LUT per bit
  EXPECT_EQ(cached(), 2U);

  // The second count uses the cache. Yosys only reports its version.
  const ProcessEnd version = must(run_process({.arguments = {"yosys", "-V"}}, c_install_tools));
  put_yosys("[ $# = 1 ] && printf '" + version.output + "' || exit 9\n");
  EXPECT_EQ(must(count(grey_)), grey);
  EXPECT_FALSE(count({.preset = Preset::published}));
}

// Another netlist is counted again, although the key is the same.
TEST_F(CellsTest, ChangedRtlIsCountedAgain) {
  put_yosys("[ $# = 1 ] || echo '{\"design\": {\"num_cells_by_type\": {\"$lut\": 1}}}' >cells.json\n");
  ASSERT_TRUE(count(grey_));
  ASSERT_TRUE(count(grey_));
  EXPECT_EQ(cached(), 1U);
  const std::filesystem::path copy = at("source");
  ASSERT_TRUE(make_folders(copy));
  std::filesystem::copy(folders_.source / "rtl", copy / "rtl", std::filesystem::copy_options::recursive);
  folders_.source = copy;
  ASSERT_TRUE(count(grey_));
  EXPECT_EQ(cached(), 1U);
  replace_in(copy / "rtl/interpolation/part_interpolator.vhd", "sum_of(value, addend",
             "sum_of(value, not addend");
  ASSERT_TRUE(count(grey_));
  EXPECT_EQ(cached(), 2U);
}

// Only the shading processors, whose multipliers are wide and many.
TEST_F(CellsTest, MultipliersOfTheShadingProcessorsAreNotLuts) {
  ASSERT_FALSE(find_program("yosys").empty()) << "no yosys: " << c_install_tools;
  HardwareKey key{.shader = Shader::processors, .preset = Preset::published, .channels = 1};
  const Cells ambient = must(count(key));
  // Only k I.
  EXPECT_EQ(ambient.multipliers, 1U);
  const int k_bits = words::Published::c_coefficient_bits, i_bits = words::Published::c_light_intensity_bits;
  EXPECT_GE(ambient.product_bits, static_cast<std::uint64_t>(k_bits + i_bits));
  EXPECT_LE(ambient.product_bits, static_cast<std::uint64_t>(k_bits + i_bits + 2));  // sign bits
  key.processors = {.directional = 1, .diffuse = true};
  const Cells lit = must(count(key));
  // N.L has three multipliers; k I and the weighted term have one each.
  EXPECT_EQ(lit.multipliers, 1 + 3 + 2U);
  EXPECT_GT(lit.luts, ambient.luts);
  EXPECT_GT(lit.flip_flops, ambient.flip_flops);
  // Each bit product of a multiplier takes one or two LUTs.
  EXPECT_GT(ambient.multiplier_luts, static_cast<std::uint64_t>(k_bits * i_bits / 2));
  EXPECT_LT(ambient.multiplier_luts, static_cast<std::uint64_t>(3 * k_bits * i_bits));
  EXPECT_GT(lit.multiplier_luts, 5 * ambient.multiplier_luts);
  // LUTs are the table and the adders only. The multipliers would double the count.
  EXPECT_LT(lit.luts, 4000U);
}

// Operands in Yosys's JSON format, lowest bit first: with sign extension, with zero extension, and without
// extension.
TEST(MultiplierShapes, HaveNoRedundantSignBits) {
  const auto netlist = [](const std::string& a, const std::string& b) {
    const std::string cell = fmt::format(
        R"({{"type": "mul", "parameters": {{"A_SIGNED": "0", "B_SIGNED": "0"}},
             "connections": {{"A": [{}], "B": [{}], "Y": [90, 91, 92]}}}})",
        a, b);
    return fmt::format(R"({{"modules": {{"top": {{"cells": {{"one": {0}, "two": {0}}}}}}}}})", cell);
  };
  const std::tuple<const char*, const char*, MultiplierShape> cases[] = {
      {"1, 2, 3, 4", "11, 12", {false, false, 4, 2, 3}},
      {"1, 2, 3, 4", "1, 2, 3, 4", {false, true, 4, 4, 3}},
      {"1, 2, 3, 3, 3", "11, 12, 12", {true, false, 3, 2, 3}},
      {"1, 2, 3, 3, 3", "11, 12", {true, false, 3, 2, 3}},
      {R"(1, 2, "0", "0", "0")", "11, 12", {false, false, 2, 2, 3}},
      {R"(1, 2, "1", "1")", "11, 12", {false, false, 4, 2, 3}},
      // In a product with a signed word, one of the zeros is the sign.
      {R"(1, 2, "0", "0", "0")", "11, 12, 12", {true, false, 3, 2, 3}}};
  for (const auto& [a, b, shape] : cases)
    EXPECT_EQ(read_multiplier_shapes(netlist(a, b), "mul"), std::vector(2, shape)) << a << " * " << b;
  EXPECT_TRUE(read_multiplier_shapes(netlist("1", "11"), "other").empty());
  for (const std::string& damaged : {netlist("", "1"), netlist(R"("0", "0")", "1"), std::string("{}")})
    EXPECT_THROW(read_multiplier_shapes(damaged, "mul"), Failure);
}

// Invalid results of Yosys and their error messages. They are removed from the cache.
TEST_F(CellsTest, InvalidCountsAreRefused) {
  const auto stat = [](const std::string& cells) {
    return "[ $# = 1 ] || cat >cells.json <<'EOF'\n{\"design\": {\"num_cells_by_type\": {" + cells +
           "}}}\nEOF\n";
  };
  put_yosys(stat("\"$lut\": 12, \"$_DFF_P_\": 3, \"$_SDFFCE_PP0P_\": 4"));
  EXPECT_EQ(must(count(coloured_)), (Cells{.luts = 12, .flip_flops = 7}));
  const std::size_t before = cached();
  const std::vector<std::pair<std::string, std::string>> cases = {
      {stat("\"$lut\": 12, \"$_DLATCH_P_\": 1"), "$_DLATCH_P_"},
      {stat("\"$lut\": 12, \"multiplier_cell\": 1"), "multipliers.json"},
      {stat("\"multiplier_cell\": 2") + "[ $# = 1 ] || echo '{\"modules\": {}}' >multipliers.json",
       "0 multipliers, not 2"},
      {"[ $# = 1 ] || echo nonsense >cells.json", "not the output of Yosys's stat"},
      {"[ $# = 1 ] || echo '{}' >cells.json", "not the output of Yosys's stat"},
      {"exit 0", "cells.json"},
      {"[ $# = 1 ] || { echo 'ERROR: no such cell'; exit 1; }", "ERROR: no such cell"},
      {"exit 1", "looking for yosys"},
  };
  for (const auto& [script, message] : cases) {
    put_yosys(script + "\n");
    EXPECT_TRUE(is_error(count(grey_), ExitCode::tool_failed, message));
    EXPECT_EQ(cached(), before) << script;
  }
}

}  // namespace
}  // namespace halfway::synth
