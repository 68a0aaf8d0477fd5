// SPDX-License-Identifier: Apache-2.0
// Compares the list of designs with rtl/, and the pinned and printed figures with the list.
#include "designs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "sim/synth/pinned.hpp"
#include "sim/system/file.hpp"

namespace halfway::synth {
namespace {

const std::filesystem::path c_root = HALFWAY_SOURCE_DIR;

std::vector<std::string> names() {
  std::vector<std::string> names;
  for (const ListedDesign& listed : all_designs()) names.push_back(listed.design.name);
  return names;
}

TEST(SynthDesigns, AreOfEveryEntityAndOfNoOther) {
  auto sources = read_rtl_sources(c_root);
  ASSERT_TRUE(sources) << sources.error().message;
  auto accumulator = read_vhdl_source(c_root, c_accumulator);
  ASSERT_TRUE(accumulator) << accumulator.error().message;
  sources->push_back(std::move(*accumulator));
  const std::regex entity(R"((?:^|\n)entity (\w+) is)");
  std::set<std::string> there, listed;
  for (const VhdlSource& source : *sources)
    for (std::sregex_iterator it(source.content.begin(), source.content.end(), entity), end; it != end; ++it)
      there.insert((*it)[1]);
  for (const ListedDesign& design : all_designs()) listed.insert(design.design.entity);
  // The shader and axi_adapter, which are measured. With one light it does not fit the device.
  EXPECT_TRUE(listed.insert("processors_axi").second);
  // These are measured inside the shading processors: a generic of record type has no value on GHDL's command
  // line.
  for (const char* inside :
       {"ambient_term", "cosine_power", "fragment_output", "half_vector", "light_state", "light_term",
        "light_vector", "light_weight", "radiance_sum", "reflected_term", "shading_sequence", "shared_adder",
        "shared_dot_product", "shared_multiplier", "shared_normalizer", "shared_weight", "token_order",
        "token_rasterizer", "token_register"})
    EXPECT_TRUE(listed.insert(inside).second) << inside;
  EXPECT_THAT(listed, ::testing::ContainerEq(there));
  EXPECT_GT(there.size(), 30U);
}

TEST(SynthDesigns, ArePinnedEachOnceAndNothingElseIs) {
  std::vector<std::string> listed;
  for (const ListedDesign& design : all_designs())
    if (design.ice40) listed.push_back(design.design.name);
  std::ranges::sort(listed);
  EXPECT_EQ(std::ranges::adjacent_find(listed), listed.end()) << "two designs of one name";
  const auto pins = read_pins(c_root / c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  std::vector<std::string> pinned;
  for (const auto& [name, pin] : *pins) pinned.push_back(name);
  EXPECT_THAT(pinned, ::testing::ContainerEq(listed));
}

// Within the permitted difference: the page may be from another run with other seeds.
TEST(SynthDesigns, HaveTheirRowsInThePage) {
  const auto page = read_file(c_root / "docs/results/synthesis.md");
  ASSERT_TRUE(page) << page.error().message;
  const auto pins = read_pins(c_root / c_pins);
  ASSERT_TRUE(pins) << pins.error().message;
  const std::size_t figures = page->find("\n## Figures\n");
  ASSERT_NE(figures, std::string::npos);
  const std::string table = page->substr(figures);
  const std::regex row(
      R"(\n\| `(\w+)` \| (\d+|–) \| (\d+|–) \| (\d+|–) \| (\d+|–) \| (\d+|–) \| [^|]+ \| [^|]+ \| (\d+|–) \|)");
  std::vector<std::string> rows;
  for (std::sregex_iterator it(table.begin(), table.end(), row), end; it != end; ++it) {
    const std::string name = (*it)[1];
    rows.push_back(name);
    const auto published = published_ns(name);
    EXPECT_EQ((*it)[7], published ? std::to_string(*published) : "–") << name;
    const auto found = pins->find(name);
    EXPECT_EQ(found == pins->end(), (*it)[2] == "–") << name;
    if (found == pins->end()) continue;
    const Pin& pin = found->second;
    const auto cells = [&](std::size_t column) { return std::stoull((*it)[column]); };
    EXPECT_EQ(compare(name, *pins, {cells(2), cells(3), cells(4), cells(5)}, std::nullopt), "");
    const double mhz = (*it)[6] == "–" ? 0 : std::stod((*it)[6]);
    EXPECT_LE(std::fabs(mhz - pin.mhz), c_clock_share * pin.mhz + 0.5) << name;
  }
  EXPECT_THAT(rows, ::testing::ContainerEq(names()));
}

}  // namespace
}  // namespace halfway::synth
