// SPDX-License-Identifier: Apache-2.0
// README's tables of savings must match their file, and the file must match the current plans.
#include "sim/costs/savings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "sim/scene_files/load_scene.hpp"
#include "sim/system/file.hpp"
#include "sim/system/must.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path c_root = HALFWAY_SOURCE_DIR;

TEST(Savings, AreWhatThePageSays) {
  const auto savings = must(read_savings(c_root / c_savings));
  const auto page = must(read_file(c_root / "docs/effects.md"));
  const auto drawn = must(with_savings(page, savings));
  EXPECT_EQ(page, drawn) << "make savings writes it";
}

TEST(Savings, AreOfTheHardwareThatIsPlanned) {
  const auto savings = must(read_savings(c_root / c_savings));
  for (std::size_t i = 0; i < savings.size(); ++i) {
    const SavingsCase& which = savings_cases()[i];
    const auto scene = must(load_scene(which.scene, c_root / "sim/scenes"));
    const auto plan = must(plan_scene(scene, which.request()));
    EXPECT_EQ(savings[i].called_for.key, plan.called_for.name()) << "make savings measures it";
    EXPECT_EQ(savings[i].everything.key, plan.everything.name()) << "make savings measures it";
  }
}

TEST(Savings, ComeBackFromTheirFile) {
  std::vector<Savings> savings(savings_cases().size());
  std::uint64_t number = 0;
  for (Savings& s : savings)
    for (HardwareCost* cost : {&s.called_for, &s.everything}) {
      cost->key = "key" + std::to_string(++number);
      for (auto* figure :
           {&cost->luts, &cost->flip_flops, &cost->memory_bits, &cost->multipliers, &cost->cycles})
        *figure = ++number;
    }
  auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
  const auto path = folder.path() / "savings.csv";
  const std::string csv = to_csv(savings);
  ASSERT_TRUE(write_file(path, csv));
  const auto read = must(read_savings(path));
  EXPECT_EQ(to_csv(read), csv);
  const auto refused = [&](const std::string& text) {
    EXPECT_TRUE(write_file(path, text));
    const auto wrong = read_savings(path);
    return wrong ? "" : wrong.error().message;
  };
  EXPECT_THAT(refused(""), HasSubstr("savings.csv:"));
  EXPECT_THAT(refused(csv.substr(0, csv.rfind(','))), HasSubstr("savings.csv:17: has 9 values"));
  EXPECT_THAT(refused(csv.substr(0, csv.size() - 1) + ",7\n"), HasSubstr("savings.csv:17: has 11 values"));
  EXPECT_THAT(refused(csv.substr(0, csv.find("spheres"))), HasSubstr("expected a line 'spheres,"));
  EXPECT_THAT(refused(csv.substr(0, csv.rfind(',')) + ",-1\n"), HasSubstr("savings.csv:17: expected a line"));
}

TEST(Savings, AreDrawnAsSharesAndPairs) {
  std::vector<Savings> savings(savings_cases().size());
  savings[1] = {{.luts = 1326, .flip_flops = 90}, {.luts = 53376, .flip_flops = 100}};
  savings[4] = {{.luts = 4682, .multipliers = 15, .cycles = 19739},
                {.luts = 19557, .multipliers = 92, .cycles = 44464}};
  const auto text = must(with_savings(
      "\n<!-- savings: x -->\n\n<!-- end of savings -->\n\n<!-- savings of processors: x -->\n\n<!-- end of "
      "savings of "
      "processors -->\n",
      savings));
  EXPECT_THAT(text, HasSubstr("\n| `matte` | spherical, `published` | 1326 | 53 376 | 98 % | 10 % |\n"));
  EXPECT_THAT(
      text,
      HasSubstr("\n| `matte`, `exact` | 4682 / 19 557 | 15 / 92 | 0 / 0 | 0 / 0 | 19 739 / 44 464 |\n"));
  EXPECT_FALSE(with_savings("a page without parts", savings));
}

}  // namespace
}  // namespace halfway
