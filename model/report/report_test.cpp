// SPDX-License-Identifier: Apache-2.0
// `halfway report`, as a user meets it.
#include "report/report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/command_test.hpp"

namespace halfway::report {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ReportCommand : public CommandTest {
 protected:
  Outcome report() const {
    return run({"report", "--results", "out", "--study", "study", "--figures", "figures", "--out",
                "new/page.html", "--no-timing"});
  }
  std::string page() const {
    const auto text = read_file(folder_->path() / "new/page.html");
    return text ? *text : "";
  }
  void put(const std::filesystem::path& file, const std::string& text) const {
    ASSERT_TRUE(make_folders((folder_->path() / file).parent_path()));
    ASSERT_TRUE(write_file(folder_->path() / file, text));
  }
};

TEST_F(ReportCommand, SaysWhatIsMissingAndWhatMakesIt) {
  const Outcome outcome = report();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* command : {"make sim", "make study", "make figures"}) {
    EXPECT_THAT(outcome.output, HasSubstr(command));
    EXPECT_THAT(page(), HasSubstr(std::string("<code>") + command + "</code> makes it"));
  }
  // What comes with the checkout is there: pages as tables, diagrams as drawings, and no mark left.
  EXPECT_THAT(page(),
              AllOf(HasSubstr("<summary>Proofs</summary>"), HasSubstr("<summary>Hard cases</summary>"),
                    HasSubstr("<summary>Mutants and coverage</summary>"),
                    HasSubstr(">unrolled_shading_processor: "), Not(HasSubstr("{{"))));
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("src=\"http")), Not(HasSubstr("url(http"))));
}

TEST_F(ReportCommand, RefusesWhatIsDamaged) {
  put("out/spheres/quadratic/summary.json", "{\"width\": 3");
  Outcome outcome = report();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("summary.json"), HasSubstr("make sim")));
  EXPECT_EQ(page(), "");
  put("out/spheres/quadratic/summary.json", "[]");
  EXPECT_EQ(report().exit_code, 2);
  std::filesystem::remove_all(folder_->path() / "out");
  put("study/study.csv", "a,b\n1\n");
  outcome = report();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.output, HasSubstr("study.csv:2: "));
  std::filesystem::remove_all(folder_->path() / "study");
  for (const char* damaged : {"[", "[{\"id\": 3}]"}) {
    put("figures/figures.json", damaged);
    outcome = report();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.output, AllOf(HasSubstr("figures.json"), HasSubstr("make figures")));
  }
}

TEST_F(ReportCommand, MakeDrawsEveryFrameThatIsMissing) {
  const auto here = folder_->path();
  const std::filesystem::path source = HALFWAY_SOURCE_DIR;
  std::filesystem::copy_file(source / "Makefile", here / "Makefile");
  for (const char* scene : {"lights", "matte"}) put(fmt::format("sim/scenes/{}.toml", scene), "");
  // A first run was broken off in the second shader.
  for (const char* drawn : {"lights/quadratic", "matte/quadratic", "lights/spherical"})
    put(fmt::format("build/out/{}/summary.json", drawn), "{}");
  put("build/out/matte/spherical/init.txt", "");
  put("build/study/study.csv", "");
  put("sim/figures/figures.json", "");
  put("build/halfway", "#!/bin/sh\necho \"$@\" >>said\n[ \"$1\" != sim ]\n");  // 1: a difference
  std::filesystem::permissions(here / "build/halfway", std::filesystem::perms::owner_all);
  const auto made =
      run_process({.arguments = {"make", "-o", "program", "report"}, .working_folder = here}, "");
  ASSERT_TRUE(made && made->succeeded()) << (made ? made->output : made.error().message);
  const auto said = read_file(here / "said");
  ASSERT_TRUE(said);
  EXPECT_EQ(*said,
            "sim --shader spherical -- matte\n"
            "sim --shader processors --simulator verilator -- lights\n"
            "sim --shader processors --simulator verilator -- matte\n"
            "report\n");
}

TEST_F(ReportCommand, EqualPicturesAreOne) {
  const Outcome drawn =
      run({"sim", "spheres", "--size", "96x72", "--simulator", "verilator", "--out", "out"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
  const auto image_of = [&](const std::string& layer) {
    const std::string mark = "<script type=\"application/json\" id=\"data\">";
    const std::size_t begin = page().find(mark) + mark.size();
    const auto data = nlohmann::json::parse(page().substr(begin, page().find("</script>", begin) - begin));
    for (const auto& of : data.at("frames").at(0).at("layers"))
      if (of.at("id") == layer) return of.at("image").get<int>();
    return -1;
  };
  ASSERT_EQ(report().exit_code, 0);
  EXPECT_EQ(image_of("golden"), image_of("verilator"));
  EXPECT_NE(image_of("golden"), image_of("reference"));
  EXPECT_EQ(image_of("ghdl"), -1);
  // What is drawn of no scene but this is told.
  for (const char* gap :
       {"Frames by the shader quadratic of highlights, lights, matte, shadows, teapot:",
        "Frames by the shader spherical of highlights, lights, matte, shadows, spheres, teapot:"})
    EXPECT_THAT(page(), HasSubstr(gap));
  // A wrong picture is shown as what it is.
  const auto folder = folder_->path() / "out/spheres/quadratic";
  std::filesystem::copy_file(folder / "reference.png", folder / "verilator.png",
                             std::filesystem::copy_options::overwrite_existing);
  ASSERT_EQ(report().exit_code, 0);
  EXPECT_NE(image_of("golden"), image_of("verilator"));
}

}  // namespace
}  // namespace halfway::report
