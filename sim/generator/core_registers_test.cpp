// SPDX-License-Identifier: Apache-2.0
// Bad data. The test of `halfway tables` compares what is written from the data of the checkout.
#include "sim/generator/core_registers.hpp"

#include <gtest/gtest.h>

#include "common/test/is_error.hpp"
#include "sim/os/must.hpp"

namespace halfway::tables {
namespace {

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

}  // namespace
}  // namespace halfway::tables
