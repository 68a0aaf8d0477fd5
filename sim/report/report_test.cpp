// SPDX-License-Identifier: Apache-2.0
// Tests of the command `halfway report`.
#include "sim/report/report.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sim/cli/command_test.hpp"
#include "sim/os/must.hpp"

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
  std::string page() const { return text_of("new/page.html"); }
};

TEST_F(ReportCommand, SaysWhatIsMissingAndWhatMakesIt) {
  const Outcome outcome = report();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  for (const char* command : {"make sim", "make study", "make figures"}) {
    EXPECT_THAT(outcome.output, HasSubstr(command));
    EXPECT_THAT(page(), HasSubstr(std::string("<code>") + command + "</code> makes it"));
  }
  // The parts that come with the checkout are present: pages as tables, diagrams as drawings. No template
  // mark is left.
  EXPECT_THAT(page(),
              AllOf(HasSubstr("<summary>Proofs</summary>"), HasSubstr("<summary>Hard cases</summary>"),
                    HasSubstr("<summary>Mutants</summary>"), HasSubstr(">unrolled_shading_processor: "),
                    Not(HasSubstr("{{"))));
  const auto commit =
      run_process({.arguments = {"git", "-C", HALFWAY_SOURCE_DIR, "describe", "--always", "--tags"}}, "");
  if (commit && commit->succeeded()) {
    EXPECT_THAT(page(), HasSubstr("Made at commit " + commit->output.substr(0, commit->output.find('\n'))));
  }
  EXPECT_THAT(page(), AllOf(Not(HasSubstr("src=\"http")), Not(HasSubstr("url(http"))));
}

TEST_F(ReportCommand, RefusesWhatIsDamaged) {
  write("out/spheres/quadratic/summary.json", "{\"width\": 3");
  EXPECT_THAT(report(), Ends(2, AllOf(HasSubstr("summary.json"), HasSubstr("make sim"))));
  EXPECT_FALSE(std::filesystem::exists(at("new/page.html")));
  write("out/spheres/quadratic/summary.json", "[]");
  EXPECT_EQ(report().exit_code, 2);
  std::filesystem::remove_all(at("out"));
  write("study/study.csv", "a,b\n1\n");
  EXPECT_THAT(report(), Ends(2, HasSubstr("study.csv:2: ")));
  std::filesystem::remove_all(at("study"));
  for (const char* damaged : {"[", "[{\"id\": 3}]"}) {
    write("figures/figures.json", damaged);
    EXPECT_THAT(report(), Ends(2, AllOf(HasSubstr("figures.json"), HasSubstr("make figures"))));
  }
}

// A picture of five hardware designs, one without a clock, and two software points.
constexpr const char* c_study =
    R"(scene,scene_hash,tools,point,method,preset,tessellation,exponent,width,height,hardware,cells,cycles,clock_mhz,clock,frame_ns,rms,largest_error,error_99,psnr_db,highlight_rms,perceived_pixels,mach_rms,host_evaluations,host_instructions,front,record,device
"ball",77,"GHDL 9, Verilator 8",P,phong,,1,5,320,240,,,0,,,,0,0,0,inf,0,0,0,0,,,a,
"ball",77,"GHDL 9, Verilator 8",G,gouraud,,1,5,320,240,,,0,,,,4.5,9,8,33.1,7,31,1,0,,,b,
"ball",77,"GHDL 9, Verilator 8",Q,quadratic,exact,1,5,320,240,q,5334,32813,112.1,"stored",292712,0.5,4,3,50.9,1,0,0.5,1452,5417130,1,c,iCE40 HX8K
"ball",77,"GHDL 9, Verilator 8",R,quadratic,exact,1,5,320,240,q,5334,33813,112.1,"stored",301633,0.4,3,2,51.9,1,12,0.4,1474,78705437,0,d,iCE40 HX8K
"ball",77,"GHDL 9, Verilator 8",S,spherical,exact,1,5,320,240,s,5985,33100,,"not placed",,0.3,2,1,57,0.4,0,0.3,31283,6417130,1,e,iCE40 HX8K
"ball",77,"GHDL 9, Verilator 8",V,processors-1,exact,1,5,320,240,v,12214,31460,,"does not fit the HX8K: 9578 LUTs of 7680",,5.7,39,25,33,10,61,0.8,0,0,1,f,iCE40 HX8K
"ball",77,"GHDL 9, Verilator 8",W,processors-2,exact,1,5,320,240,w,14214,31460,,"",,5.8,39,25,33,10,61,0.8,0,,0,g,iCE40 HX8K
)";

TEST_F(ReportCommand, PlotsEveryPointOrSaysWhichNot) {
  ASSERT_FALSE(find_program("gnuplot").empty()) << "no gnuplot here: apt-get install gnuplot-nox";
  write("study/study.csv", c_study);
  const Outcome outcome = report();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto part = [text = page()](const std::string& begin, const std::string& end) {
    const std::size_t at = text.find(begin);
    return at == std::string::npos ? std::string() : text.substr(at, text.find(end, at) - at);
  };
  const auto plot = [&](const std::string& id) { return part("id=\"plot/" + id + "\"", "</figure>"); };
  // Points with a known clock have a time; the others are counted.
  EXPECT_THAT(
      plot("rms-time"),
      AllOf(HasSubstr("aria-label=\"Q: time of the frame, ns 292712, rms error, steps of 1/255 0.5\""),
            HasSubstr("href=\"#point-3\""), Not(HasSubstr("href=\"#point-4\"")),
            HasSubstr("PLACE=1</code> finds: 1 of processors-2; 1 of spherical; in all 2"),
            HasSubstr("their hardware does not fit the device: 1 of processors-1; in all 1"),
            HasSubstr("gouraud (software)"), HasSubstr("phong (software)")));
  // All hardware has a number of clocks. Software has none, so it is not a point.
  EXPECT_THAT(plot("rms-clocks"), AllOf(HasSubstr("href=\"#point-6\""), Not(HasSubstr("not here")),
                                        Not(HasSubstr("href=\"#point-0\"")), Not(HasSubstr("e+0"))));
  // 0 has a position, also for the host's work.
  EXPECT_THAT(plot("perceived-time"), AllOf(HasSubstr("href=\"#point-2\""), HasSubstr("href=\"#point-3\"")));
  EXPECT_THAT(plot("rms-host"),
              AllOf(HasSubstr("href=\"#point-5\""), HasSubstr("V: instructions of setup on the host 0,"),
                    HasSubstr("instructions of setup on the host 78705437,"),
                    HasSubstr("1 of processors-2; in all 1")));
  EXPECT_THAT(part("<ul class=\"legend\"", "</ul>"),
              AllOf(HasSubstr("spherical"), Not(HasSubstr("software"))));
  // The table lists all points and has no 0 for missing values.
  const auto row = [&](const std::string& point) {
    return part("<td><a href=\"#point-" + point + "\">", "</tr>");
  };
  EXPECT_THAT(part("Points of the study</caption>", "</thead>"),
              AllOf(HasSubstr("on the front"), HasSubstr("ns per frame"), HasSubstr("cells"),
                    HasSubstr("PSNR"), HasSubstr("99th percentile")));
  EXPECT_THAT(row("1"),
              AllOf(HasSubstr("G</a></td><td>–</td><td>–</td><td>–</td><td>–</td><td>–</td><td>4.5</td>"),
                    HasSubstr("<td>33.1</td>")));
  EXPECT_THAT(row("2"),
              HasSubstr("Q</a></td><td>yes</td><td>292712</td><td>32813</td><td>5334</td><td>5417130</td>"));
  EXPECT_THAT(row("4"), HasSubstr("S</a></td><td>yes</td><td>–</td><td>33100</td>"));
  // The page names the study and says that it is not the default one.
  EXPECT_THAT(part("id=\"study/of\"", "</p>"),
              AllOf(HasSubstr("<strong>ball</strong>"), HasSubstr("<code>77</code>"),
                    HasSubstr("7 points, of no space"), HasSubstr("GHDL 9, Verilator 8")));
  const std::string other = "The study is of the scene ball, not of sim/study/spaces/sphere.toml";
  EXPECT_THAT(page(), HasSubstr(other));
  EXPECT_THAT(outcome.output, HasSubstr(other));
  // A point's panel gives the reason for a missing clock.
  EXPECT_THAT(page(), AllOf(HasSubstr("[\"origin of that clock\",\"not placed\"]"),
                            HasSubstr("[\"FPGA\",\"iCE40 HX8K\"]"),
                            HasSubstr("[\"99th percentile of errors, /255\",\"25\"]"),
                            HasSubstr("[\"on the front\",\"no\"]")));
}

TEST_F(ReportCommand, NamesTheStudysSceneAndSpace) {
  write("study/study.csv", text_of(c_source_folder / "docs/results/gallery/front.csv"));
  const Outcome outcome = report();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(page(), HasSubstr("points of <code>sim/study/spaces/small.toml</code>, in a table of 20"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("The study is of the scene")));
}

TEST_F(ReportCommand, MakeDrawsEveryFrameThatIsMissing) {
  std::filesystem::copy_file(c_source_folder / "Makefile", at("Makefile"));
  for (const char* scene : {"lights", "matte"}) write(fmt::format("sim/scenes/{}.toml", scene), "");
  // The first run was interrupted in the second shader.
  for (const char* drawn : {"lights/quadratic", "matte/quadratic", "lights/spherical"})
    write(fmt::format("build/out/{}/summary.json", drawn), "{}");
  write("build/out/matte/spherical/init.txt", "");
  write("build/study/study.csv", "");
  write("docs/results/figures/figures.json", "");
  put_program(at("build/halfway"),
              "#!/bin/sh\necho \"$@\" >>said\n[ \"$1\" != sim ]\n");  // 1: a difference
  const auto made =
      run_process({.arguments = {"make", "-o", "program", "report"}, .working_folder = here()}, "");
  ASSERT_TRUE(made && made->succeeded()) << (made ? made->output : made.error().message);
  EXPECT_EQ(text_of("said"),
            "sim --shader spherical -- matte\n"
            "sim --shader processors --simulator verilator -- lights\n"
            "sim --shader processors --simulator verilator -- matte\n"
            "report\n");
}

TEST_F(ReportCommand, EqualPicturesAreOne) {
  ASSERT_THAT(run({"sim", "spheres", "--size", "96x72", "--simulator", "verilator", "--out", "out"}),
              Ends(0, ::testing::_));
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
  // Missing frames are listed for this scene only.
  for (const char* gap :
       {"Frames by the shader quadratic of highlights, lights, matte, shadows, teapot:",
        "Frames by the shader spherical of highlights, lights, matte, shadows, spheres, teapot:"})
    EXPECT_THAT(page(), HasSubstr(gap));
  // A wrong picture is reported as wrong.
  const auto folder = at("out/spheres/quadratic");
  std::filesystem::copy_file(folder / "reference.png", folder / "verilator.png",
                             std::filesystem::copy_options::overwrite_existing);
  ASSERT_EQ(report().exit_code, 0);
  EXPECT_NE(image_of("golden"), image_of("verilator"));
}

}  // namespace
}  // namespace halfway::report
