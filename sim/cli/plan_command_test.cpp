// SPDX-License-Identifier: Apache-2.0
// Tests of `halfway plan`, and of --all-effects in the commands that draw.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <string_view>

#include "sim/cli/command_test.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

using PlanCommand = CommandTest;

// A replacement for Yosys that reports one LUT per kilobyte of netlist.
constexpr const char* c_yosys = R"(#!/bin/sh
[ $# = 1 ] && { echo stand-in; exit; }
luts=$(($(wc -c <netlist.v) / 1024))
echo '{"design": {"num_cells_by_type": {"$lut": '$luts', "$_DFF_P_": 5}}}' >cells.json
)";

TEST_F(PlanCommand, ListsEveryEffectAndWhatIsLeftOut) {
  EXPECT_THAT(
      run({"plan", "matte", "--shader", "spherical"}),
      Ends(0, AllOf(HasSubstr("as needed      spherical_shader-exact-c1-l1-d-rom9x8\n"),
                    HasSubstr("all effects    spherical_shader-exact-c3-l1-d-s3-cos1.2.4.8.16-rom9x8\n"),
                    ContainsRegex("\nspecular +no +hardware +every k_s is 0\n +left out: .*1 specular_slice"),
                    ContainsRegex("\nhighlight colour +no +hardware +there is no highlight\n"),
                    ContainsRegex("\npositional +no +hardware +the scene has no positional light\n"),
                    ContainsRegex("\nshadow +no +- +the scene has no shadows; not by this shader\n"),
                    ContainsRegex("\nperspective correction +yes +host .*; at both ends of a span\n"),
                    ContainsRegex("\n  specular_slice +0 +1 +100 %\n"), Not(HasSubstr("measured")))));
  EXPECT_THAT(run({"plan", "lights"}).output,
              AllOf(ContainsRegex("\ncolour channels +yes +hardware +directional light 1 is coloured"),
                    ContainsRegex("\nperspective correction +yes +host .*; at each sample\n")));
  // All effects are elaborated, although the scene does not need them.
  const Outcome all = run({"plan", "matte", "--shader", "spherical", "--all-effects", "--lights", "4"});
  EXPECT_THAT(all.output,
              AllOf(HasSubstr("all effects    spherical_shader-exact-c3-l4-d-s3-cos1.2.4.8.16-rom9x8\n"),
                    ContainsRegex("\nspecular +no +hardware +every k_s is 0; one slice per light\n"
                                  " +not needed, but present: .*4 specular_slice")));
}

TEST_F(PlanCommand, ComparesPlanesWithQuadratics) {
  // A matte sphere needs fewer samples than a glossy one, and a plane for more of its triangles.
  const auto lines = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    const std::size_t at = outcome.output.find("\nplanes (--degree 1");
    return at == std::string::npos ? std::string() : outcome.output.substr(at);
  };
  const std::string few = lines({"plan", "matte", "--size", "160x120"});
  EXPECT_THAT(few, AllOf(ContainsRegex("160x120: [1-9][0-9]* of [1-9][0-9]* triangles are within 2 steps"),
                         ContainsRegex("\nbits of an init vector +640 +880 +27 %\n"),
                         ContainsRegex("\nsamples shaded +[0-9]+ +[0-9]+"), Not(HasSubstr("LUTs"))));
  // The clocks of the default preset and one channel are stored, for each device.
  EXPECT_THAT(few, ContainsRegex("\nstored clock, MHz, ECP5 LFE5U-85F +[0-9]+[.][0-9] +[0-9]+[.][0-9]"));
  EXPECT_THAT(lines({"plan", "matte", "--size", "80x60", "--device", "hx8k"}),
              ContainsRegex("\nstored clock, MHz, iCE40 HX8K +[0-9]+[.][0-9] +[0-9]+[.][0-9]"));
  // Split planes are within the threshold 2, and rounding.
  EXPECT_THAT(few, AllOf(ContainsRegex("\nlargest error, split +[0-3] "),
                         ContainsRegex("\nlargest error, never split +([4-9]|[1-9][0-9]+) "),
                         ContainsRegex("\nrms error, steps of 1/255, never split +[0-9.]+ +[0-9.]+ *\n")));
  const std::string all = lines({"plan", "matte", "--size", "160x120", "--threshold", "255"});
  EXPECT_THAT(all, HasSubstr(" triangles are within 255 steps, so planes are enough\n"));
  EXPECT_EQ(lines({"plan", "matte", "--shader", "spherical"}), "");
}

// The printed generics select the netlist that --netlist writes.
TEST_F(PlanCommand, WritesTheRepairedNetlist) {
  EXPECT_THAT(run({"plan", "matte", "--netlist", "matte.v"}),
              Ends(0, HasSubstr("\n  generics       g_exact=true g_channels=1 g_degree=2\n")));
  // One channel of preset exact: 880 bits. The text went through mend_netlist, which also removes GHDL's
  // comments.
  EXPECT_THAT(text_of("matte.v"),
              AllOf(HasSubstr("module quadratic_shader\n"), HasSubstr("input  [879:0] init_data"),
                    Not(HasSubstr("/*")), Not(HasSubstr("//")), Not(HasSubstr("\"")), Not(HasSubstr("'bZ"))));
}

// Its formulas are tested with the plan.
TEST_F(PlanCommand, Table5OfTheLights) {
  EXPECT_THAT(run({"plan", "lights", "--objects-per-pixel", "3", "--rate", "30", "--size", "1000x1000"}),
              Ends(0, AllOf(HasSubstr("R = 5 directional lights, P = 5 positional ones"),
                            ContainsRegex("p \\(2 R \\+ 2 P \\+ 1\\) +1239 \\(21 a pipeline\\)\n"),
                            ContainsRegex("\\(14 R \\+ 26 P \\+ 6\\) O dt +30900 ns\n"),
                            // The clocks of this scene's own pipeline, from table 4.
                            ContainsRegex("exact +folded +positional specular +51 +230 \\(229.50\\) +4830 "),
                            ContainsRegex("exact +unrolled +all alike +1 +5 \\(4.50\\) +105 "))));
  // Either option suffices.
  EXPECT_THAT(run({"plan", "lights", "--rate", "60"}).output, HasSubstr("60 frames a second, O = 1"));
  EXPECT_THAT(run({"plan", "lights"}).output, Not(HasSubstr("table 5")));
}

// Behind object processors each covered pixel has one object; with the filter, pixels at outlines have more.
TEST_F(PlanCommand, MeasuresObjectsBehindObjectProcessors) {
  const auto plan = [&](const char* subpixels, int objects = 32) {
    return run({"plan", "matte", "--shader", "processors", "--objects", std::to_string(objects),
                "--subpixels", subpixels, "--size", "160x120", "--rate", "30"});
  };
  const Outcome plain = plan("1"), filtered = plan("16");
  EXPECT_EQ(plain.exit_code, 0) << plain.output;
  EXPECT_THAT(
      plain.output,
      ContainsRegex(
          "measured behind 32 object processors, 1 subpixel: [0-9]+ objects a frame, O = 0\\.[0-9]+"));
  const auto objects_of = [](const std::string& output) {
    const std::string_view before = "objects a frame";
    const std::size_t end = output.find(before);
    const std::size_t start = end == std::string::npos ? 0 : output.rfind(": ", end) + 2;
    return std::atoi(output.c_str() + start);
  };
  EXPECT_GT(objects_of(plain.output), 1000);
  // R = 1, version I: 30 frames, 7 clocks of 50 ns per object, 3 processors a pipeline.
  EXPECT_THAT(plain.output,
              HasSubstr(fmt::format("version I, with this O: 1 ({:.2f}) pipelines, 3 processors\n",
                                    30 * 7 * 50e-9 * objects_of(plain.output))));
  // One object processor fewer is refused, with this number.
  const std::string_view needs = "the scene needs ";
  ASSERT_THAT(filtered.output, HasSubstr(needs));
  const int fewest = std::atoi(filtered.output.c_str() + filtered.output.find(needs) + needs.size());
  EXPECT_THAT(plan("16", fewest - 1), Ends(2, HasSubstr(fmt::format("{} pieces of triangles", fewest))));
  EXPECT_GT(objects_of(filtered.output), objects_of(plain.output));
}

TEST_F(PlanCommand, BadUsageExitsTwo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"plan", "matte", "--shader", "spherical", "--lights", "3"}, "--lights goes with --all-effects"},
      {{"plan", "matte", "--all-effects", "--lights", "3"},
       "--lights belongs to the spherical shader and the processors shader, and does not apply to the "
       "quadratic shader"},
      {{"plan", "matte", "--shader", "spherical", "--all-effects", "--lights", "0"}, "0 is not 1 to 16"},
      {{"plan", "lights", "--shader", "spherical", "--all-effects", "--lights", "9"}, "9 is not 10 to 16"},
      {{"plan", "matte", "--rate", "1001"}, "--rate: Value 1001 not in range 1 to 1000"},
      {{"plan", "matte", "--objects-per-pixel", "0"}, "--objects-per-pixel: Value 0 not in range 1 to 1000"},
      {{"plan", "matte", "--form", "folded"},
       "--form belongs to the processors shader, and does not apply to the quadratic shader"},
      {{"plan", "matte", "--shader", "processors", "--form", "flat"}, "take unrolled or folded"},
      {{"plan", "matte", "--objects", "4"},
       "--objects belongs to the processors shader, and does not apply to the quadratic shader"},
      {{"plan", "matte", "--shader", "processors", "--objects", "257"}, "257 is not 0 to 256"},
      {{"plan", "matte", "--shader", "processors", "--objects", "4", "--subpixels", "9"},
       "9 is not 1, 4 or 16"},
      {{"plan", "matte", "--shader", "processors", "--subpixels", "4"},
       "--subpixels goes with objects above 0"},
      {{"plan", "matte", "--measure", "--simulator", "modelsim"}, "is not a simulator"},
  };
  for (const auto& [arguments, expected] : cases) EXPECT_THAT(run(arguments), Ends(2, HasSubstr(expected)));
}

TEST_F(PlanCommand, AMissingToolExitsThree) {
  const Environment nowhere = {{"PATH", at("empty").string()}};
  EXPECT_THAT(run({"plan", "matte"}, nowhere),
              Ends(0, AllOf(HasSubstr("units are not counted: "), HasSubstr("apt-get install ghdl-llvm"))));
  EXPECT_THAT(run({"plan", "matte", "--measure"}, nowhere), Ends(3, HasSubstr("apt-get install yosys")));
}

TEST_F(PlanCommand, MeasuresCellsCyclesAndSeconds) {
  EXPECT_THAT(
      run({"plan", "matte", "--shader", "spherical", "--measure", "--size", "64x48"},
          path_with("yosys", c_yosys)),
      Ends(0, AllOf(ContainsRegex("1 specular_slice: [1-9][0-9]* LUTs, 0 flip-flops\n"),
                    ContainsRegex("LUTs of 4 inputs[^\n]* [1-9][0-9]* +[1-9][0-9]* +[1-9][0-9]? %\n"),
                    ContainsRegex("\nflip-flops +5 +5 +0 %\n"), ContainsRegex("\ncycles +[1-9][0-9]* +[1-9]"),
                    ContainsRegex("\nprocessor seconds in GHDL +[0-9]"),
                    ContainsRegex("\nprocessor seconds in Verilator +[0-9]"),
                    HasSubstr("are equal bit for bit"))));
}

// RTL with a fault that only appears in hardware with all effects: factors that should be zero are not.
TEST_F(PlanCommand, MeasuringReportsFramesThatDiffer) {
  const std::filesystem::path copy = copy_checkout();
  replace_in(copy / "rtl/illumination/specular_slice.vhd", "start => part(part'high downto c_factors_low)",
             "start => not part(part'high downto c_factors_low)");
  EXPECT_THAT(run({"--source", copy, "plan", "matte", "--shader", "spherical", "--measure", "--size", "64x48",
                   "--simulator", "verilator"},
                  path_with("yosys", c_yosys)),
              Ends(1, AllOf(HasSubstr("the two frames DIFFER"), Not(HasSubstr("seconds in GHDL")))));
}

}  // namespace
}  // namespace halfway
