// SPDX-License-Identifier: Apache-2.0
// Tests of the command `halfway study`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "sim/cli/command_test.hpp"
#include "sim/study/stand_in_slurm_test.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class StudyCommandTest : public CommandTest {
 protected:
  Outcome study(std::vector<std::string> arguments, Environment environment = {}) const {
    write("space.toml",
          "[[sweep]]\nmethod = [\"gouraud\", \"quadratic\", \"adaptive\"]\nsize = \"160x120\"\n");
    arguments.insert(arguments.begin(), {"study", "--space", "space.toml", "--out", "out"});
    return run(std::move(arguments), std::move(environment));
  }
};

TEST_F(StudyCommandTest, RefusesInvalidQueries) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--error", "2%"}, "--error: '2%' is not valid"},
      {{"--psnr", "loud"}, "--psnr: 'loud' is not valid"},
      {{"--time", "10"}, "--time: '10' is not valid; take a time with its unit"},
      {{"--clock", "0"}, "--clock: takes MHz above 0"},
      {{"--device", "xcv300"}, "--device: 'xcv300' is not a device; take hx8k or ecp5"},
      {{"--size", "huge"}, "--size: 'huge'"},
      {{"--executor", "cloud"}, "--executor: cloud not in {local,slurm}"},
      {{"--part", "3/3"}, "--part: '3/3'"},
      {{"--executor", "slurm", "--parts", "0"}, "--parts: takes 1 or more"},
      {{"no-such-scene"}, "no-such-scene"}};
  for (const auto& [arguments, message] : cases) EXPECT_THAT(study(arguments), Ends(2, HasSubstr(message)));
  EXPECT_FALSE(std::filesystem::exists(at("out/study.csv")));
  EXPECT_FALSE(std::filesystem::exists(at("out/question.csv")));
}

TEST_F(StudyCommandTest, AnswersOrSaysThatNothingIsGoodEnough) {
  EXPECT_THAT(
      study({"--error", "3"}),
      Ends(0, AllOf(HasSubstr("3 points, 3 measured in this run"),
                    HasSubstr("160x120: the quickest with largest error at most 3/255 is adaptive exact, "
                              "threshold 2, "),
                    HasSubstr("cheapest       adaptive exact, threshold 2: largest error"),
                    HasSubstr("cheaper        quadratic exact: largest error"),
                    HasSubstr("more accurate  none"))));
  EXPECT_THAT(study({"--error", "3", "--psnr", "99"}),
              Ends(1, AllOf(HasSubstr("3 points, 0 measured in this run"),
                            HasSubstr("none of 2 points of hardware meets it"),
                            HasSubstr("most accurate  adaptive exact"))));
  // With three channels; these are stored as not fitting the device.
  EXPECT_THAT(study({"spheres", "--time", "1s", "--device", "hx8k"}),
              Ends(1, HasSubstr("2 points: too large for the device")));
  EXPECT_THAT(study({"--time", "1s", "--clock", "50"}),
              Ends(0, AllOf(HasSubstr("cheapest       quadratic exact"), HasSubstr("us)"),
                            Not(HasSubstr("no clock")))));
}

// The device's clocks, and without its placer none but the stored ones.
TEST_F(StudyCommandTest, NamesTheDevice) {
  EXPECT_THAT(study({}), Ends(0, HasSubstr("clocks on an ECP5 LFE5U-85F: 1 stored, 0 placed, 0 not known")));
  EXPECT_THAT(text_of("out/times.csv"), HasSubstr(",ECP5 LFE5U-85F,\n"));
  EXPECT_THAT(study({"--device", "hx8k"}), Ends(0, HasSubstr("clocks on an iCE40 HX8K: 1 stored")));
  EXPECT_THAT(text_of("out/study.csv"), HasSubstr(",iCE40 HX8K,"));
  put_program(at("bin/yosys"), "#!/bin/sh\n");
  const Environment without{{"PATH", at("bin").string()}};
  EXPECT_THAT(study({"--place"}, without),
              Ends(3, AllOf(HasSubstr("nextpnr-ecp5"), HasSubstr("since Debian 13"))));
  EXPECT_THAT(study({"--place", "--device", "hx8k"}, without),
              Ends(3, HasSubstr("apt-get install yosys nextpnr-ice40")));
}

TEST_F(StudyCommandTest, SoftwareMeetsNoDemand) {
  write("software.toml", "[[sweep]]\nmethod = [\"phong\", \"gouraud\"]\nsize = \"80x60\"\n");
  EXPECT_THAT(run({"study", "--space", "software.toml", "--out", "out", "--error", "200"}),
              Ends(1, HasSubstr("nothing meets it: none of the points is hardware")));
  EXPECT_THAT(run({"study", "--space", "software.toml", "--out", "out"}), Ends(0, ::testing::_));
}

// Of several pictures, the one with the most hardware.
TEST_F(StudyCommandTest, EndsWithTheFrontOfItsMainPicture) {
  write("two.toml",
        "[[sweep]]\nmethod = \"quadratic\"\nsize = \"80x60\"\n"
        "[[sweep]]\nmethod = [\"quadratic\", \"adaptive\"]\nsize = \"160x120\"\n");
  EXPECT_THAT(run({"study", "--space", "two.toml", "--out", "out"}),
              Ends(0, AllOf(HasSubstr("160x120\n  front          2 of 2 points"),
                            HasSubstr("  quadratic exact\n"), HasSubstr("  adaptive exact, threshold 2\n"),
                            HasSubstr("make report draws it"), Not(HasSubstr("80x60\n")))));
}

// The report shows the study's table. A query has its own points from the same records.
TEST_F(StudyCommandTest, AQueryKeepsTheStudysTable) {
  EXPECT_THAT(study({"--error", "3"}),
              Ends(0, HasSubstr("out/question.csv: 3 points, 3 measured in this run")));
  EXPECT_FALSE(std::filesystem::exists(at("out/study.csv")));
  EXPECT_THAT(study({}), Ends(0, HasSubstr("out/study.csv: 3 points, 0 measured in this run")));
  const std::string table = text_of("out/study.csv");
  EXPECT_EQ(text_of("out/question.csv"), table);
  EXPECT_THAT(study({"--size", "80x60", "--psnr", "99"}), Ends(1, ::testing::_));
  EXPECT_EQ(text_of("out/study.csv"), table);
  EXPECT_THAT(text_of("out/question.csv"), AllOf(HasSubstr(",80,60,"), Not(HasSubstr(",160,120,"))));
}

TEST_F(StudyCommandTest, TasksMeasureAndTheCommandWritesTheTable) {
  study::put_slurm(here());
  const std::string path = here().string() + ":" + std::getenv("PATH");
  EXPECT_THAT(study({"--executor", "slurm"}, {{"PATH", path}}),
              Ends(0, HasSubstr("3 points, 0 measured in this run")));
}

}  // namespace
}  // namespace halfway
