// SPDX-License-Identifier: Apache-2.0
#include "evidence/thresholds.hpp"

#include <gmock/gmock.h>

#include "sim/os/file.hpp"
#include "sim/os/machine.hpp"
#include "sim/os/must.hpp"

namespace halfway::page {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* c_text =
    "[mutants]\n"
    "release = \"Debian GNU/Linux 13 (trixie)\"\n"
    "rule = \"at least 90 %\"\n"
    "a = 80\n"
    "\"b.c\" = 50.5\n"
    "[cells]\n"
    "columns = [\"LUTs\", \"RAMs\"]\n"
    "rules = [\"within 3 % or 3\", \"equal\"]\n"
    "d = [200, 2]\n"
    "e = [10, 0]\n";

TEST(Thresholds, ThatAreBrokenAreReportedWithLineValueAndRule) {
  const Thresholds t = Thresholds::parse(c_text);
  EXPECT_THAT(t.broken({"mutants", "a", {72}}), IsEmpty());
  EXPECT_THAT(t.broken({"mutants", "a", {100}}), IsEmpty());
  EXPECT_THAT(
      t.broken({"mutants", "a", {71.9}}),
      ElementsAre(
          "tb/evidence/thresholds.toml:4: mutants: a: it is 71.9; the threshold is 80, at least 90 %"));
  EXPECT_THAT(t.broken({"cells", "d", {206, 2}}), IsEmpty());
  EXPECT_THAT(t.broken({"cells", "d", {194, 2}}), IsEmpty());
  EXPECT_THAT(
      t.broken({"cells", "d", {207, 3}}),
      ElementsAre(
          "tb/evidence/thresholds.toml:9: cells: d: LUTs is 207; the threshold is 200, within 3 % or 3",
          "tb/evidence/thresholds.toml:9: cells: d: RAMs is 3; the threshold is 2, equal"));
  EXPECT_THAT(t.broken({"cells", "d", {193, 2}}).size(), 1);
  EXPECT_THAT(t.broken({"cells", "e", {13, 0}}), IsEmpty());
  EXPECT_THAT(t.broken({"cells", "e", {14, 0}}).size(), 1);
  EXPECT_THAT(t.broken({"mutants", "a", {std::nan("")}}).size(), 1);
}

TEST(Thresholds, AreWantedForEachMeasuredName) {
  const Thresholds t = Thresholds::parse(c_text);
  EXPECT_THAT(t.broken({"mutants", "x", {7}}),
              ElementsAre("tb/evidence/thresholds.toml:1: mutants: x has no threshold; it is 7"));
  EXPECT_THAT(t.broken({"none", "x", {7}}),
              ElementsAre("tb/evidence/thresholds.toml: has no section [none]"));
  EXPECT_THAT(t.broken({"cells", "d", {200}}), ElementsAre(HasSubstr("has 1 numbers, not 2")));
  const Value values[] = {{"mutants", "a", {80}}};
  EXPECT_THAT(t.unmeasured(values),
              ElementsAre("tb/evidence/thresholds.toml:5: mutants: b.c is not measured any more; remove it"));
  EXPECT_THAT(t.numbers("cells", "d"), ElementsAre(200, 2));
  EXPECT_THAT(t.numbers("cells", "x"), IsEmpty());
}

TEST(Thresholds, OfAnotherReleaseAreNotJudged) {
  const TemporaryFolder folder = must(TemporaryFolder::make(testing::TempDir()));
  const Value broken[] = {{"mutants", "a", {1}}};
  const auto judged_as = [&](const std::string& release) {
    std::string text = c_text;
    text.replace(text.find("Debian GNU/Linux 13 (trixie)"), 28, release);
    must(make_folders(folder.path() / "tb/evidence"));
    must(write_file(folder.path() / "tb/evidence/thresholds.toml", text));
    return judged(folder.path(), broken);
  };
  EXPECT_EQ(judged_as("CP/M"), ExitCode::equal);
  EXPECT_EQ(judged_as(operating_system()), ExitCode::differs);
  EXPECT_EQ(judged_as(""), ExitCode::differs);
}

TEST(Thresholds, KnowRulesOfOneSide) {
  const auto t =
      Thresholds::parse("[low]\nrule = \"at most\"\na = 0.3\n[high]\nrule = \"at least\"\na = -2\n");
  EXPECT_THAT(t.broken({"low", "a", {0.1 + 0.2}}), IsEmpty());
  EXPECT_THAT(t.broken({"low", "a", {-100}}), IsEmpty());
  EXPECT_EQ(t.broken({"low", "a", {0.31}}).size(), 1U);
  EXPECT_THAT(t.broken({"high", "a", {-1.9}}), IsEmpty());
  EXPECT_EQ(t.broken({"high", "a", {-2.1}}).size(), 1U);
}

TEST(Thresholds, OfAFileThatIsWrongNameItsLine) {
  const auto message = [](const char* text) {
    const auto read = caught([&] { return Thresholds::parse(text); });
    return read ? std::string() : read.error().message;
  };
  EXPECT_THAT(message("[a]\nrule = \"nearly\"\n"),
              HasSubstr("tb/evidence/thresholds.toml:1: a: no such rule: nearly"));
  EXPECT_THAT(message("[a]\nx = 1\n"), HasSubstr("tb/evidence/thresholds.toml:1: a: give a rule"));
  EXPECT_THAT(message("[a]\nrule = \"equal\"\nx = [1, 2]\n"),
              HasSubstr("tb/evidence/thresholds.toml:3: x: wants 1 numbers"));
  EXPECT_THAT(message("[a]\nrule = \"equal\"\nx = \"y\"\n"),
              HasSubstr("tb/evidence/thresholds.toml:3: x: wants 1 numbers"));
  EXPECT_THAT(message("[a\n"), HasSubstr("tb/evidence/thresholds.toml:"));
}

}  // namespace
}  // namespace halfway::page
