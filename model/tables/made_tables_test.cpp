// SPDX-License-Identifier: Apache-2.0
#include "tables/made_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <optional>

#include "common/file.hpp"

namespace halfway::tables {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::Not;

const fs::path c_source = HALFWAY_SOURCE_DIR;

TEST(MadeTables, AreThoseThatAreCompiledIn) {
  std::size_t compared = 0;
  for (const golden::CosineTable& table : golden::c_cosine_tables) {
    const CosineSize size{table.address_bits, table.data_bits};
    EXPECT_TRUE(compiled_in(table.exact, size));
    const MadeTables made(table.exact, size);
    for (const golden::CosineTable& other : made.tables()) {
      EXPECT_EQ(other.exact, table.exact);
      EXPECT_EQ(other.address_bits, size.address_bits);
      EXPECT_EQ(other.data_bits, size.data_bits);
      if (other.power != table.power) continue;
      EXPECT_THAT(other.entries, ElementsAreArray(table.entries));
      ++compared;
    }
  }
  EXPECT_EQ(compared, golden::c_cosine_tables.size());
  EXPECT_FALSE(compiled_in(true, {5, 4}));
}

TEST(MadeTables, TheRtlHasThemAndIsElseTheCheckouts) {
  auto cache = TemporaryFolder::make(fs::temp_directory_path());
  ASSERT_TRUE(cache) << cache.error().message;
  const auto folder = rtl_with_tables(false, {5, 4}, c_source, cache->path());
  ASSERT_TRUE(folder) << folder.error().message;
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(c_source / "rtl")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path name = entry.path().lexically_relative(c_source / "rtl");
    const auto theirs = read_file(*folder / "rtl" / name), ours = read_file(entry.path());
    ASSERT_TRUE(theirs && ours) << name;
    if (name != "tables/cosine_pkg.vhd") {
      EXPECT_EQ(*theirs, *ours) << name;
      continue;
    }
    EXPECT_THAT(*theirs, HasSubstr("c_published_cosine_2_5_4"));
    EXPECT_THAT(*theirs, HasSubstr("c_exact_cosine_16_9_8"));
    EXPECT_THAT(*theirs, Not(HasSubstr("c_published_cosine_2_6_6")));
  }
  EXPECT_GT(files, 20U);
  EXPECT_TRUE(fs::exists(*folder / "sim/verilator/harness.cpp"));
  const auto again = rtl_with_tables(false, {5, 4}, c_source, cache->path());
  ASSERT_TRUE(again);
  EXPECT_EQ(*again, *folder);
  EXPECT_NE(*rtl_with_tables(true, {5, 4}, c_source, cache->path()), *folder);
}

}  // namespace
}  // namespace halfway::tables
