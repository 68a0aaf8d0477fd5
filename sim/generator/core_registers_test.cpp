// SPDX-License-Identifier: Apache-2.0
// Registers and commands as data: bad data, and the files of the checkout.
#include "sim/generator/core_registers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/generator/generated_files.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::tables {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr std::string_view c_data =
    R"(identity = 0x48414C46
[[register]]
name = "control"
offset = 0x18
access = "rw"
text = "start"
fields = [
  { name = "enable", high = 0, low = 0, text = "take commands" },
  { name = "mode", high = 31, low = 30, text = "mode", values = { slow = 1, fast = 3 } },
]
[[register]]
name = "head"
offset = 0x34
access = "w1c"
text = "number"
[command]
words = 2
fields = [
  { name = "first", word = 0, high = 31, low = 0, text = "address" },
  { name = "width", word = 1, high = 12, low = 0, text = "columns" },
]
)";

std::string with(std::string_view old, std::string_view text) {
  std::string data(c_data);
  const std::size_t at = data.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return data.replace(at, old.size(), text);
}

TEST(CoreRegisters, BadDataNamesFileAndLine) {
  constexpr const char* c_mode = "name = \"mode\", high = 31, low = 30";
  const std::vector<std::array<std::string, 3>> cases = {
      {"[command]", "[command", "f.toml:16: "},
      {"identity = 0x48414C46", "", "f.toml:1: identity must be a whole number from 0 to 4294967295"},
      {"[[register]]", "[[registers]]", "f.toml:2: unknown key 'registers'; the keys here are identity"},
      {"name = \"control\"\n", "", "f.toml:2: name must be a text in quotes"},
      {"\"control\"", "\"Control\"", "f.toml:2: 'Control' is no name of lower-case letters"},
      {"\"head\"", "\"head_\"", "f.toml:11: 'head_' is no name"},
      {"\"head\"", "\"control\"", "f.toml:11: the name 'control' is used twice"},
      {"0x34", "0x18", "f.toml:11: offset 18 of 'head' is that of 'control'"},
      {"0x34", "0x32", "f.toml:11: offset 32 is no multiple of 4"},
      {"0x34", "0x100", "f.toml:11: offset must be a whole number from 0 to 252"},
      {"\"w1c\"", "\"wo\"", "f.toml:11: unknown access 'wo'; take ro, rw, w1c"},
      {"text = \"number\"\n", "", "f.toml:11: text must be a text in quotes"},
      {"high = 0, low = 0", "high = 30, low = 0", "f.toml:9: 'mode' overlaps 'enable'"},
      {c_mode, "name = \"mode\", high = 1, low = 0", "f.toml:9: 'mode' overlaps 'enable'"},
      {c_mode, "name = \"enable\", high = 31, low = 30", "f.toml:9: the name 'enable' is used twice"},
      {c_mode, "name = \"mode\", high = 32, low = 30", "f.toml:9: high must be a whole number from 0 to 31"},
      {c_mode, "name = \"mode\", high = 29, low = 30", "f.toml:9: 'mode' has high 29 below low 30"},
      {c_mode, "name = \"mode\", high = 30, low = 30", "f.toml:9: fast must be a whole number from 0 to 1"},
      {c_mode, "name = \"mode\", word = 0, high = 31, low = 30", "f.toml:9: unknown key 'word'"},
      {"word = 1, ", "word = 0, ", "f.toml:20: 'width' overlaps 'first'"},
      {"word = 1, ", "word = 2, ", "f.toml:20: word must be a whole number from 0 to 1"},
      {"words = 2\n", "words = 17\n", "f.toml:16: words must be a whole number from 0 to 16"},
  };
  for (const auto& [old, text, expected] : cases)
    EXPECT_TRUE(
        is_error(caught([&] { core_registers(with(old, text), "f.toml"); }), ExitCode::bad_input, expected))
        << old << " -> " << text;
}

// What the checkout has is what its data says, and a change of the data makes each file stale.
TEST(CoreRegisters, FilesOfTheCheckoutAreCurrent) {
  const TemporaryFolder folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const std::string files[] = {"rtl/core/core_registers_pkg.vhd",
                               "sim/extras/library/halfway_core_registers.h", "docs/rtl/core.md"};
  const std::string data = must(read_file(c_source_folder / "rtl/core/core_registers.toml"));
  must(make_folders(folder.path() / "rtl/core"));
  must(write_file(folder.path() / "rtl/core/core_registers.toml", data));
  // A copy of the sources has no pages.
  for (const GeneratedFile& file : generated_files(folder.path(), {}))
    EXPECT_NE(file.path, "docs/rtl/core.md");
  must(make_folders(folder.path() / "docs/rtl"));
  must(write_file(folder.path() / "docs/rtl/core.md", "no parts\n"));
  EXPECT_TRUE(
      is_error(caught([&] { generated_files(folder.path(), {}); }), "docs/rtl/core.md: wants one part"));
  for (const std::string& file : files) {
    must(make_folders((folder.path() / file).parent_path()));
    must(write_file(folder.path() / file, must(read_file(c_source_folder / file))));
  }
  must(write_files(folder.path(), generated_files(folder.path(), {})));
  EXPECT_THAT(stale_files(folder.path(), {}), ::testing::IsEmpty());
  for (const std::string& file : files)
    EXPECT_TRUE(must(read_file(folder.path() / file)) == must(read_file(c_source_folder / file)))
        << file << ": run `make tables`";

  std::string changed = data;
  const std::string old = "name = \"ring_size\"\noffset = 0x30";
  ASSERT_NE(changed.find(old), std::string::npos);
  changed.replace(changed.find(old), old.size(), "name = \"ring_size\"\noffset = 0xFC");
  must(write_file(folder.path() / "rtl/core/core_registers.toml", changed));
  std::vector<::testing::Matcher<std::string>> stale;
  for (const std::string& file : files)
    stale.push_back(AllOf(HasSubstr(file + ":"), HasSubstr("edit rtl/core/core_registers.toml")));
  EXPECT_THAT(stale_files(folder.path(), {}), ::testing::ElementsAreArray(stale));
}

}  // namespace
}  // namespace halfway::tables
