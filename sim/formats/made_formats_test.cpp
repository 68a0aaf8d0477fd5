// SPDX-License-Identifier: Apache-2.0
#include "sim/formats/made_formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/formats/format_sources.hpp"
#include "sim/system/file.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Program and library must not be mixed if the checkout has changed since the program was built.
TEST(MadeFormats, AProgramOlderThanTheCheckoutIsRefused) {
  const fs::path source = HALFWAY_SOURCE_DIR;
  const auto here = format_sources_hash(source);
  ASSERT_TRUE(here) << here.error().message;
  EXPECT_EQ(*here, built_from());

  const auto scratch = TemporaryFolder::make(fs::temp_directory_path());
  ASSERT_TRUE(scratch) << scratch.error().message;
  const fs::path copy = scratch->path() / "source";
  for (const char* folder : {"model", "sim/formats"}) {
    ASSERT_TRUE(make_folders(copy / folder));
    fs::copy(source / folder, copy / folder, fs::copy_options::recursive);
  }
  EXPECT_EQ(*format_sources_hash(copy), built_from());
  HardwareKey key;
  key.words.fraction_bits = 4;
  for (const char* name : {"model/golden/edge_walker.hpp", "model/setup/quadratic_setup.cpp",
                           "model/golden_run/shader_model.hpp", "sim/formats/harness.cpp"}) {
    const auto text = read_file(copy / name);
    ASSERT_TRUE(text) << text.error().message;
    ASSERT_TRUE(write_file(copy / name, *text + "\n"));
    const auto made = MadeFormats::open(key, {copy, scratch->path() / "cache"});
    ASSERT_FALSE(made) << name;
    EXPECT_EQ(made.error().code, ExitCode::bad_input);
    EXPECT_THAT(made.error().message, HasSubstr("make program"));
    ASSERT_TRUE(write_file(copy / name, *text));
    EXPECT_EQ(*format_sources_hash(copy), built_from()) << name;
  }
  ASSERT_TRUE(write_file(copy / "model/golden/another.hpp", ""));
  EXPECT_FALSE(MadeFormats::open(key, {copy, scratch->path() / "cache"}));
}

}  // namespace
}  // namespace halfway
