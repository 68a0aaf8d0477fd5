// SPDX-License-Identifier: Apache-2.0
#include "sim/generator/word_lengths/made_formats.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/generator/word_lengths/format_sources.hpp"
#include "sim/os/test/folder_test.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {
namespace {

namespace fs = std::filesystem;

using MadeFormats = FolderTest;

// Program and library must not be mixed if the checkout has changed since the program was built.
TEST_F(MadeFormats, AProgramOlderThanTheCheckoutIsRefused) {
  EXPECT_EQ(format_sources_hash(c_source_folder), built_from());

  const fs::path copy = at("source");
  for (const char* folder : {"model", "sim/generator"}) {
    ASSERT_TRUE(make_folders(copy / folder));
    fs::copy(c_source_folder / folder, copy / folder, fs::copy_options::recursive);
  }
  EXPECT_EQ(format_sources_hash(copy), built_from());
  HardwareKey key;
  const auto models = [&] { return caught([&] { return made_models(key, {copy, at("cache")}); }); };
  key.words.fraction_bits = 4;
  for (const char* name :
       {"model/golden/edge_walker.hpp", "model/setup/quadratic_setup.cpp",
        "model/golden_run/shader_model.hpp", "sim/generator/word_lengths/formats_harness.cpp"}) {
    const std::string text = text_of(copy / name);
    write(copy / name, text + "\n");
    EXPECT_TRUE(is_error(models(), ExitCode::bad_input, "make program")) << name;
    write(copy / name, text);
    EXPECT_EQ(format_sources_hash(copy), built_from()) << name;
  }
  write(copy / "model/golden/another.hpp", "");
  EXPECT_FALSE(models());
}

}  // namespace
}  // namespace halfway
