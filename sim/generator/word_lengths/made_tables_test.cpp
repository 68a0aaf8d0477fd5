// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/made_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"
#include "words/generator/formats.hpp"
#include "words/generator/functions.hpp"

namespace halfway::tables {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::Not;

class MadeTablesTest : public FolderTest {
 protected:
  fs::path copy(bool exact, const WordLengths& words = {}) const {
    return rtl_with(exact, CosineSize{5, 4}, words, c_source_folder, here());
  }
};

TEST_F(MadeTablesTest, AreTheOnlyChangeOfTheCopiedRtl) {
  const fs::path folder = copy(false);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(c_source_folder / "rtl")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path name = entry.path().lexically_relative(c_source_folder / "rtl");
    const std::string theirs = text_of(folder / "rtl" / name);
    if (name != "tables/cosine_pkg.vhd")
      EXPECT_EQ(theirs, text_of(entry.path())) << name;
    else
      EXPECT_THAT(theirs, AllOf(HasSubstr("c_published_cosine_2_5x4"), HasSubstr("c_exact_cosine_16_9x8"),
                                Not(HasSubstr("c_published_cosine_2_6x6"))));
  }
  EXPECT_GT(files, 20U);
  EXPECT_TRUE(fs::exists(folder / "sim/engines/verilator/verilator_harness.cpp"));
  EXPECT_EQ(copy(false), folder);
  EXPECT_NE(copy(true), folder);
}

TEST(MadeWords, ChangeOnePresetOnly) {
  EXPECT_FALSE(WordLengths{}.any());
  const WordLengths words{.angle_bits = 12, .fraction_bits = 6, .seed_bits = 8, .newton = false};
  EXPECT_EQ(words.name(), "angle12-fraction6-seed8-plain");
  const auto own = preset_formats(), made = preset_formats(true, words);
  const auto format = [](const PresetFormats& preset, std::string_view name) {
    for (const Format& f : preset.formats)
      if (f.name == name) return std::pair(f.integer_bits, f.fraction_bits);
    return std::pair(-1, -1);
  };
  EXPECT_EQ(format(made[0], "angle"), std::pair(10, 12));
  EXPECT_EQ(format(made[0], "intensity"), std::pair(11, 6));
  EXPECT_EQ(format(made[0], "root_entry"), std::pair(0, 8));
  EXPECT_EQ(format(made[0], "root"), std::pair(0, 8));  // the entry itself
  EXPECT_EQ(format(made[0], "depth_sum"), format(own[0], "depth_sum"));
  for (const Format& f : own[1].formats) EXPECT_EQ(format(made[1], f.name), format(own[1], f.name));
  EXPECT_EQ(format(preset_formats(true, {.seed_bits = 8})[0], "root"), format(own[0], "root"));
  EXPECT_EQ(format(preset_formats(false, {.seed_bits = 8})[1], "root"), std::pair(0, 8));
}

TEST(MadeWords, TheTableOfRootsHasTheSeedsSize) {
  const auto own = function_tables(), made = function_tables(true, {.seed_bits = 8});
  ASSERT_EQ(made.size(), own.size());
  for (std::size_t i = 0; i < made.size(); ++i) {
    if (!made[i].exact || made[i].function != Function::reciprocal_root) {
      EXPECT_EQ(made[i].values, own[i].values);
      continue;
    }
    EXPECT_EQ(made[i].values.size(), 32U);
    EXPECT_EQ(made[i].value_bits, 8);
    EXPECT_EQ(made[i].values.front(), 252U);  // 1/sqrt(1 + 1/32), of 256
  }
  // The committed files and their word lengths.
  const WordLengths same{.seed_bits = 12, .newton = true};
  EXPECT_EQ(function_vhdl_package(function_tables(true, same)), function_vhdl_package());
  EXPECT_EQ(vhdl_package(preset_formats(true, same)), vhdl_package(preset_formats()));
}

}  // namespace
}  // namespace halfway::tables
