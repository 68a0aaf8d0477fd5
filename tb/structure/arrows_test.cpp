// SPDX-License-Identifier: Apache-2.0
#include "structure/arrows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "sim/system/file.hpp"

namespace halfway::structure {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Sources checkout() {
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  Sources sources;
  for (const char* top : {"model", "sim", "tb"})
    for (const char* ending : {".cpp", ".hpp", ".h"}) {
      const auto files = files_below(source / top, ending);
      EXPECT_TRUE(files) << top;
      for (const std::filesystem::path& file : *files) {
        const auto text = read_file(source / top / file);
        EXPECT_TRUE(text) << file;
        sources[(top / file).string()] = *text;
      }
    }
  return sources;
}

TEST(Arrows, PointFromTbToSimToModel) {
  const Sources sources = checkout();
  ASSERT_GT(sources.size(), 300U);
  EXPECT_THAT(wrong_arrows(sources), IsEmpty());
}

TEST(Arrows, OneThatIsPlantedInTheCheckoutIsFound) {
  Sources sources = checkout();
  sources["model/setup/edge.hpp"] += "#include \"sim/system/file.hpp\"\n";
  const auto wrong = wrong_arrows(sources);
  ASSERT_FALSE(wrong.empty());
  EXPECT_THAT(wrong[0],
              ::testing::HasSubstr("includes sim/system/file.hpp: arrows point from tb to sim to model"));
}

TEST(Arrows, PointingUpIsNamedByFileAndLine) {
  EXPECT_THAT(
      wrong_arrows({{"model/a/x.hpp", "\n  #  include \"sim/b/y.hpp\"\n"},
                    {"sim/b/y.hpp", "#include \"z/w.hpp\"\n"},
                    {"tb/z/w.hpp", "#include \"a/x.hpp\"\n// #include \"sim/b/y.hpp\"\n"}}),
      ElementsAre("model/a/x.hpp:2: includes sim/b/y.hpp: arrows point from tb to sim to model",
                  "sim/b/y.hpp:1: includes tb/z/w.hpp: arrows point from tb to sim to model",
                  "these folders form cycles: model/a sim/b tb/z: move what two of them share below both"));
}

TEST(Arrows, ACycleOfFoldersIsFoundWhereNoFilesFormOne) {
  EXPECT_THAT(wrong_arrows({{"sim/a/x.hpp", "#include \"sim/b/y.hpp\"\n"},
                            {"sim/b/y.hpp", ""},
                            {"sim/b/z.hpp", "#include \"sim/a/w.hpp\"\n"},
                            {"sim/a/w.hpp", "#include \"sim/c/v.hpp\"\n"},
                            {"sim/c/v.hpp", ""}}),
              ElementsAre("these folders form cycles: sim/a sim/b: move what two of them share below both"));
}

TEST(Arrows, HelpersOfTestsAreForTests) {
  EXPECT_THAT(
      wrong_arrows({{"model/a/x.cpp", "#include \"a/test/helper.hpp\"\n"},
                    {"model/a/x_test.cpp", "#include \"a/test/helper.hpp\"\n#include \"sim/b/y.hpp\"\n"},
                    {"model/a/test/helper.hpp", ""},
                    {"sim/b/y.hpp", "#include \"a/x.hpp\"\n"},
                    {"model/a/x.hpp", ""},
                    {"tb/c/z.cpp", "#include \"a/test/helper.hpp\"\n"}}),
      ElementsAre("model/a/x.cpp:1: includes model/a/test/helper.hpp: only tests may use a test's helpers"));
}

TEST(Arrows, SourceFilesAreNotIncluded) {
  EXPECT_THAT(wrong_arrows({{"sim/a/x.cpp", "#include \"sim/a/y.cpp\"\n"}, {"sim/a/y.cpp", ""}}),
              ElementsAre("sim/a/x.cpp:1: includes sim/a/y.cpp: share a header instead of a source file"));
}

}  // namespace
}  // namespace halfway::structure
