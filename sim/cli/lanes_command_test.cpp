// SPDX-License-Identifier: Apache-2.0
// Tests of `halfway sim` and `compare` with lanes.
#include <gmock/gmock.h>

#include "sim/cli/command_test.hpp"
#include "sim/files/image.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class LanesCommand : public CommandTest {};

TEST_F(LanesCommand, SimDrawsTheSameWithoutCycles) {
  for (const std::string threads : {"1", "3"}) {
    EXPECT_THAT(run({"sim", "matte", "--size", "64x48", "--simulator", "lanes", "--threads", threads, "--out",
                     "out"}),
                Ends(0, AllOf(ContainsRegex("[1-9][0-9]* fragments \\| lanes: 0 mismatches, "),
                              Not(HasSubstr("cycles")), Not(HasSubstr("verilator")))));
    const std::filesystem::path folder = folder_.path() / "out" / "matte" / "quadratic";
    const auto golden = read_png(folder / "golden.png"), lanes = read_png(folder / "lanes.png");
    ASSERT_TRUE(golden && lanes);
    EXPECT_EQ(golden->rgb, lanes->rgb);
    const auto summary = must(read_file(folder / "summary.json"));
    EXPECT_THAT(summary, ContainsRegex("\"simulator\": \"lanes\",\n *\"cycles\": null"));
    EXPECT_THAT(run({"compare", "matte", "--out", "out"}),
                Ends(0, ContainsRegex("lanes +[a-z0-9_-]+ 64x48 +[1-9][0-9]* fragments, 0 mismatch")));
  }
}

TEST_F(LanesCommand, SimDrawsShadows) {
  EXPECT_THAT(run({"sim", "shadows", "--simulator", "lanes", "--shader", "processors", "--size", "64x48",
                   "--out", "out"}),
              Ends(0, ContainsRegex("[1-9][0-9]* fragments \\| lanes: 0 mismatches, ")));
}

}  // namespace
}  // namespace halfway
