// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/made_formats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/generator/word_lengths/format_sources.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

// Program and library must not be mixed if the checkout has changed since the program was built.
TEST(MadeFormats, AProgramOlderThanTheCheckoutIsRefused) {
  const fs::path source = HALFWAY_SOURCE_DIR;
  const auto here = format_sources_hash(source);
  EXPECT_EQ(here, built_from());

  const auto scratch = must(TemporaryFolder::make(fs::temp_directory_path()));
  const fs::path copy = scratch.path() / "source";
  for (const char* folder : {"model", "sim/generator"}) {
    ASSERT_TRUE(make_folders(copy / folder));
    fs::copy(source / folder, copy / folder, fs::copy_options::recursive);
  }
  EXPECT_EQ(format_sources_hash(copy), built_from());
  HardwareKey key;
  const auto models = [&] {
    return caught([&] { return made_models(key, {copy, scratch.path() / "cache"}); });
  };
  key.words.fraction_bits = 4;
  for (const char* name :
       {"model/golden/edge_walker.hpp", "model/setup/quadratic_setup.cpp",
        "model/golden_run/shader_model.hpp", "sim/generator/word_lengths/formats_harness.cpp"}) {
    const auto text = must(read_file(copy / name));
    ASSERT_TRUE(write_file(copy / name, text + "\n"));
    EXPECT_TRUE(is_error(models(), ExitCode::bad_input, "make program")) << name;
    ASSERT_TRUE(write_file(copy / name, text));
    EXPECT_EQ(format_sources_hash(copy), built_from()) << name;
  }
  ASSERT_TRUE(write_file(copy / "model/golden/another.hpp", ""));
  EXPECT_FALSE(models());
}

}  // namespace
}  // namespace halfway
