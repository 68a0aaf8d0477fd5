// SPDX-License-Identifier: Apache-2.0
// Tests the program as a user runs it: exit codes, outputs and their places, and every kind of bad input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "sim/cli/command_test.hpp"
#include "sim/files/trace.hpp"
#include "sim/os/sanitizers.hpp"
#include "sim/run/draw_knobs.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class CliTest : public CommandTest {
 protected:
  std::filesystem::path out() const { return at("out"); }
  nlohmann::json summary_of(const std::filesystem::path& folder) const {
    return nlohmann::json::parse(text_of(out() / folder / "summary.json"));
  }
};

const std::string c_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(CliTest, HelpGoesToStandardOutputAndExitsZero) {
  for (const std::string command :
       {"sim", "view", "plan", "render", "init", "compare", "why", "tables", "study"}) {
    EXPECT_THAT(run({command, "--help"}), Ends(0, HasSubstr("halfway " + command + " [OPTIONS]")));
  }
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  EXPECT_THAT(run({"view", "--help"}).output, HasSubstr("threads, each of which draws whole frames"));
  // If standard output is closed, no part of the help may appear on standard error.
  const Outcome quiet = run_as({"sh", "-c", std::string("exec '") + HALFWAY_PROGRAM + "' --help >/dev/null"});
  EXPECT_EQ(quiet.output, "");
}

TEST_F(CliTest, AProgramInACopiedCheckoutReadsTheCopy) {
  const std::filesystem::path copy = at("copy"), program = copy / "build" / "halfway";
  write("copy/rtl/files.f", "");
  create_directories(program.parent_path());
  copy_file(HALFWAY_PROGRAM, program);
  EXPECT_THAT(run_as({program, "--help"}), Ends(0, HasSubstr(copy.string())));
  remove(copy / "rtl" / "files.f");
  EXPECT_THAT(run_as({program, "--help"}), Ends(0, Not(HasSubstr(copy.string()))));
}

TEST_F(CliTest, BadUsageExitsTwoAndSaysWhatToDo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"simulate"}, "halfway --help"},
      {{"sim", "--nonsense"}, "--nonsense"},
      {{"sim", "spheres", "--shader", "toon"}, "--shader: 'toon' is not a shader"},
      {{"sim", "spheres", "--preset", "best"}, "--preset: best not in {exact,published}"},
      {{"sim", "spheres", "--size", "4097x10"}, "1 to 4096"},
      {{"sim", "spheres", "--size", "640"}, "is not WIDTHxHEIGHT"},
      {{"sim", "spheres", "--simulator", "modelsim"}, "is not a simulator"},
      {{"sim", "spheres", "--threshold", "-1"}, "--threshold: -1 is not above 0"},
      {{"sim", "spheres", "--max-level", "6"}, "--max-level: 6 is not 0 to 5"},
      {{"sim", "spheres", "--degree", "2.0"}, "--degree: '2.0' is not a whole number"},
      {{"sim", "spheres", "--threshold", "1x"}, "--threshold: '1x' is not a number"},
      {{"sim", "spheres", "--max-level", "99999999999"}, "--max-level: 99999999999 is not 0 to 5"},
      {{"sim", "spheres", "--highlight-test", "x"},
       "--highlight-test: 'x' is not one of its values; take none or centroid or conservative"},
      {{"why", "spheres", "--pixel", "12"}, "is not x,y"},
      {{"why", "matte", "--shader", "processors", "--objects", "9", "--pixel", "1,2"},
       "why explains pixels of the rasterizer"},
      {{"init", "teapot", "--shader", "processors", "--objects", "2", "--size", "40x30"},
       "pieces of triangles lie on one line of one column, and the hardware has 2 object processors"},
      {{"sim", "teapot", "--shader", "processors", "--objects", "2", "--size", "40x30"},
       "give more by --objects (make: OBJECTS; a space: objects), up to 256, or leave them out"},
      {{"why", "spheres", "--pixel", "640,0"}, "outside the frame"},
      {{"render", "spheres", "--method", "oil"}, "--method: oil not in {reference,gouraud,"},
      {{"sim", "spheres", "--shader", "spherical", "--cosine", "9x13"}, "'9x13' is not ADDRESSxDATA bits"},
      {{"sim", "spheres", "--shader", "spherical", "--cosine", "11x3"},
       "make tables PRESET=exact COSINE=11x3"},
      {{"compare", "spheres"}, "run `make sim SCENE=spheres` first"},
      {{"compare", "spheres", "--all-effects", "--out", "o"},
       "run `make sim SCENE=spheres ALL_EFFECTS=1 OUT=o` first"},
  };
  for (const auto& [arguments, expected] : cases) {
    EXPECT_THAT(run(arguments), Ends(2, HasSubstr(expected)));
  }
}

TEST_F(CliTest, EveryKnobRefusesAWrongValue) {
  for (const DrawKnob& knob : draw_knobs())
    EXPECT_THAT(
        run({"sim", "spheres", "--shader", to_string(knob.belongs_to.front().first), knob.option(), "?"}),
        Ends(2, HasSubstr(knob.option() + ": '?' is not")));
}

TEST_F(CliTest, OptionsOfOtherHardwareExitTwo) {
  const auto mesh = write("one.obj", c_triangle);
  const std::string q = "quadratic", s = "spherical", exact = "exact", published = "published";
  // Without a message the option is taken.
  const std::vector<std::array<std::string, 5>> cases = {
      {q, exact, "--span-ends", "surface", "--span-ends belongs to the spherical shader in preset exact"},
      {s, exact, "--span-ends", "slerp", ""},
      {s, published, "--span-ends", "slerp", "not apply to the spherical shader in preset published\n"},
      {s, published, "--threshold", "2",
       "--threshold belongs to the quadratic shader and the spherical shader in preset exact, and does not "
       "apply to"},
      {q, published, "--threshold", "1", ""},
      {q, exact, "--max-level", "0", ""},
      {s, exact, "--max-level", "5", "--max-level belongs to the quadratic shader, and does not apply to"}};
  for (const auto& [shader, preset, option, value, message] : cases)
    EXPECT_THAT(run({"init", mesh, "--shader", shader, "--preset", preset, option, value, "--size", "20x15"}),
                Ends(message.empty() ? 0 : 2, HasSubstr(message)));
  EXPECT_THAT(run({"init", mesh, "--shader", s, "--threshold", "1", "--span-ends", "slerp"}),
              Ends(2, HasSubstr("--threshold goes with span ends on the surface")));
  // This method in double is always spherical, for any hardware named by --shader.
  EXPECT_EQ(run({"render", mesh, "--method", "spherical-fixed", "--span-ends", "slerp", "--size", "20x15"})
                .exit_code,
            0);
}

TEST_F(CliTest, BadScenesAndMeshesExitTwoAndLeaveNothing) {
  const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
      {"empty.obj", "", "empty.obj"},
      {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "range.obj:4:"},
      {"noise.ply", std::string("ply\0\1\2\3garbage", 14), "noise.ply"},
      {"noise.glb", "glTFxxxx", "noise.glb"},
      {"broken.toml", "[camera\nfov = 3\n", "broken.toml:1:"},
      {"missing.toml", "[[mesh]]\nfile = \"gone.obj\"\n", "gone.obj"},
  };
  for (const auto& [name, text, expected] : cases) {
    const std::filesystem::path path = write(name, text);
    EXPECT_THAT(run({"sim", path, "--out", out()}), Ends(2, HasSubstr(expected))) << name;
    EXPECT_FALSE(std::filesystem::exists(out())) << name;
  }
  EXPECT_EQ(run({"sim", "no-such-scene", "--out", out()}).exit_code, 2);
  EXPECT_EQ(run({"sim", here(), "--out", out()}).exit_code, 2);
}

TEST_F(CliTest, RenderingTheGoldenModelNotesClampedValues) {
  const auto scene = write("bright.toml",
                           "[[directional]]\nto_light = [0, 0, 1]\nintensity = [100, 1, 1]\n[[material]]\n"
                           "name = \"m\"\n[[mesh]]\nkind = \"box\"\nmaterial = \"m\"\n");
  const auto image = at("bright.png").string();
  EXPECT_THAT(run({"render", scene, "--method", "golden", "--shader", "processors", "--size", "20x15",
                   "--file", image}),
              Ends(0, HasSubstr("directional light 1 is 100 times white and was clamped")));
}

TEST_F(CliTest, MissingShadowsAreNotedIfALightCastsThem) {
  const std::string rest = "[[material]]\nname = \"m\"\n[[mesh]]\nkind = \"box\"\nmaterial = \"m\"\n";
  const auto lit = write("lit.toml", "shadows = true\n[[directional]]\nto_light = [0, 0, 1]\n" + rest);
  const auto unlit = write("unlit.toml", "shadows = true\n" + rest);
  const auto note = HasSubstr("its shadows are drawn by the shading processors alone");
  const auto sim = [&](const std::filesystem::path& scene) {
    return run({"sim", scene, "--size", "20x15", "--simulator", "verilator", "--out", out()});
  };
  EXPECT_THAT(sim(lit), Ends(0, note));
  EXPECT_THAT(sim(unlit), Ends(0, Not(note)));
}

// A triangle between the centres of pixels, a triangle smaller than 1/16 pixel, and a back-facing triangle.
TEST_F(CliTest, ARunThatComparesNothingExitsOne) {
  const std::string corners = "v 0 0 0\nv {0} 0 0\nv 0 {0} 0\n";
  write("small.obj", fmt::format(fmt::runtime(corners), "0.1") + "f 1 2 3\n");
  write("tiny.obj", fmt::format(fmt::runtime(corners), "0.00002") + "f 1 2 3\n");
  write("averted.obj", fmt::format(fmt::runtime(corners), "1") + "f 1 3 2\n");
  for (const std::string name : {"small", "tiny", "averted"}) {
    SCOPED_TRACE(name);
    const auto scene = write(name + ".toml",
                             "[camera]\neye = [0.01, 0.013, 4]\ntarget = [0.01, 0.013, 0]\n[[directional]]\n"
                             "to_light = [0, 0, 1]\n[[material]]\nname = \"m\"\n[[mesh]]\nfile = \"" +
                                 name + ".obj\"\nmaterial = \"m\"\ncull = \"back\"\n");
    const std::vector<std::string> size = {"--size", "8x8", "--simulator", "verilator", "--out", out()};
    const auto with_size = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.end(), size.begin(), size.end());
      return run(arguments);
    };
    const bool in_view = name != "averted";
    const std::string nothing = name + ": nothing was compared: ";
    const Outcome sim = with_size({"sim", scene});
    for (const Outcome& outcome :
         {sim, run({"compare", name, "--out", out()}), with_size({"view", scene, "--frames", "1"})}) {
      EXPECT_THAT(outcome, Ends(in_view ? 1 : 0,
                                AllOf(HasSubstr("nothing compared"), Not(HasSubstr("0 mismatches")))));
      EXPECT_EQ(outcome.output.find(nothing + "1 triangle is in view, but no pixel is drawn; take a larger "
                                              "--size") != std::string::npos,
                in_view);
    }
    const std::string left_out = "1 triangles of surfaces that are not closed show their back";
    EXPECT_EQ(sim.output.find(left_out) != std::string::npos, !in_view) << sim.output;
    EXPECT_EQ(with_size({"view", scene, "--frames", "1", "--no-compare"}).exit_code, 0);
    EXPECT_THAT(run({"why", scene, "--pixel", "3,3", "--size", "8x8"}),
                Ends(1, AllOf(HasSubstr(nothing + (in_view ? "1 triangle is in" : "no triangle is in view")),
                              Not(HasSubstr("agree")))));
    EXPECT_EQ(run({"sim", scene, "--size", "640x480", "--simulator", "verilator", "--out", out()}).exit_code,
              name == "tiny" ? 1 : 0);
  }

  // A summary changed by hand: the reference covers pixels, but setup found no triangle.
  const auto path = out() / "averted/quadratic/summary.json";
  auto json = summary_of("averted/quadratic");
  json["accuracy"]["pixels"] = 7;
  write(path, json.dump());
  EXPECT_THAT(run({"compare", "averted", "--out", out()}),
              Ends(1, HasSubstr("no triangle in view, but the reference covers 7 pixels")));
  json["runs"] = nlohmann::json::array();
  write(path, json.dump());
  EXPECT_THAT(run({"compare", "averted", "--out", out()}),
              Ends(1, HasSubstr("nothing was compared: no simulator drew; run `make sim SCENE=averted")));
}

TEST_F(CliTest, SummaryHoldsWhatTheRunWas) {
  const auto mesh = write("one.obj", c_triangle);
  const Outcome outcome = run({"sim", mesh, "--out", out(), "--size", "40x30"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto json = summary_of("one/quadratic");
  EXPECT_EQ(json["scene"], "one");
  EXPECT_EQ(json["shader"], "quadratic");
  EXPECT_EQ(json["preset"], "exact");
  EXPECT_EQ(json["width"], 40);
  EXPECT_EQ(json["height"], 30);
  EXPECT_EQ(json["triangles"], 1);
  EXPECT_GT(json["fragments"], 100);
  ASSERT_EQ(json["runs"].size(), 2U);
  EXPECT_EQ(json["runs"][0]["simulator"], "ghdl");
  EXPECT_EQ(json["runs"][1]["simulator"], "verilator");
  for (const auto& entry : json["runs"]) {
    EXPECT_EQ(entry["mismatches"], 0);
    EXPECT_EQ(entry["fragments"], json["fragments"]);
  }
  EXPECT_EQ(json["runs"][0]["cycles"], json["runs"][1]["cycles"]);
  EXPECT_GT(json["runs"][0]["cycles"], 100);
  EXPECT_GT(json["runs"][0]["seconds"], 0.0);
  for (const char* file : {"reference.png", "golden.png", "ghdl.png", "verilator.png", "diff.png", "init.txt",
                           "golden.trace", "ghdl.trace", "verilator.trace"})
    EXPECT_TRUE(std::filesystem::exists(out() / "one" / "quadratic" / file)) << file;
  EXPECT_EQ(run({"compare", mesh, "--out", out()}).exit_code, 0);
}

TEST_F(CliTest, UnresolvedLeavesAreCounted) {
  const auto drawn = [&](const std::string& level) {
    return run({"sim", "highlights", "--size", "160x120", "--max-level", level, "--highlight-test", "proved",
                "--simulator", "verilator", "--out", out()});
  };
  EXPECT_THAT(drawn("5"), Ends(0, Not(HasSubstr("unresolved"))));
  const Outcome rough = drawn("0");
  const auto summary = summary_of("highlights/quadratic");
  EXPECT_GT(summary["setup"]["unresolved"], 10);
  EXPECT_THAT(rough, Ends(0, HasSubstr(fmt::format(" | {} unresolved | reference: ",
                                                   summary["setup"]["unresolved"].get<int>()))));
}

// Results of both kinds of hardware are in separate folders.
TEST_F(CliTest, AllEffectsHaveAFolderOfTheirOwn) {
  const auto mesh = write("one.obj", c_triangle);
  const std::vector<std::string> sim = {"sim",    mesh,    "--out",       out(),
                                        "--size", "40x30", "--simulator", "verilator"};
  const std::vector<std::string> compare = {"compare", "one", "--out", out()};
  const auto all_effects = [&](std::vector<std::string> arguments) {
    arguments.emplace_back("--all-effects");
    return run(arguments).exit_code;
  };
  EXPECT_EQ(run(sim).exit_code, 0);
  EXPECT_EQ(all_effects(compare), 2);
  EXPECT_EQ(all_effects(sim), 0);
  EXPECT_EQ(all_effects(compare), 0);
  EXPECT_EQ(run(compare).exit_code, 0);
  EXPECT_EQ(summary_of("one/quadratic")["hardware"]["all_effects"], false);
  EXPECT_EQ(summary_of("one/quadratic-all-effects")["hardware"]["all_effects"], true);
}

TEST_F(CliTest, TheLineNamesTablesOfAnUnusualSize) {
  EXPECT_THAT(run({"sim", "highlights", "--out", "out", "--size", "40x30", "--shader", "spherical",
                   "--simulator", "verilator", "--preset", "published", "--cosine", "4x4"}),
              Ends(0, HasSubstr(" fragments, tables 4x4 | verilator: ")));
}

// Bit for bit, with the tables of two exponents.
TEST_F(CliTest, OwnTablesDrawInBothSimulators) {
  const auto drawn = run({"sim", "spheres", "--shader", "spherical", "--own-tables", "--size", "64x48",
                          "--simulator", "ghdl", "--simulator", "verilator", "--out", "out"});
  EXPECT_THAT(drawn,
              Ends(0, AllOf(HasSubstr(", own tables 10x11 |"), ContainsRegex("ghdl: .* 0 mismatches"),
                            ContainsRegex("verilator: .* 0 mismatches"), HasSubstr("largest error 1/255"))));
  for (const auto& [shader, preset] : {std::pair("quadratic", "exact"), {"spherical", "published"}})
    EXPECT_THAT(run({"sim", "spheres", "--shader", shader, "--preset", preset, "--own-tables"}),
                Ends(2, HasSubstr("--own-tables belongs to the spherical shader in preset exact")));
}

TEST_F(CliTest, CompareSeesAChangedTraceAndRefusesADamagedOne) {
  const auto mesh = write("one.obj", c_triangle);
  ASSERT_EQ(run({"sim", mesh, "--out", out(), "--size", "20x15", "--simulator", "verilator"}).exit_code, 0);
  const std::filesystem::path path = out() / "one" / "quadratic" / "verilator.trace";
  const std::string whole = text_of(path);

  // Change the first fragment's blue by one step.
  const std::size_t line_end = whole.find('\n', whole.find('\n') + 1);
  const std::size_t blue = whole.rfind(' ', line_end) + 1;
  const int value = std::stoi(whole.substr(blue, line_end - blue));
  std::string changed = whole;
  changed.replace(blue, line_end - blue, std::to_string(value == 255 ? 254 : value + 1));
  write(path, changed);
  EXPECT_THAT(
      run({"compare", "one", "--out", out()}),
      Ends(1, ContainsRegex("triangle 0, line [0-9]+, pixel [0-9]+, blue: golden [0-9]+, verilator")));
  EXPECT_EQ(
      run_as({"sh", "-c", fmt::format("'{}' compare one --out out >/dev/full", HALFWAY_PROGRAM)}).exit_code,
      1);

  for (const std::string& damaged :
       {whole.substr(0, whole.size() / 2), std::string("P6\n20 15\n"), std::string(),
        whole + "1 2 3 4 5 6 7\n", std::string("halfway-trace 1 other-key\nend 0\n")}) {
    write(path, damaged);
    EXPECT_THAT(run({"compare", "one", "--out", out()}), Ends(2, HasSubstr("verilator.trace")));
  }
}

// If some results are missing, the output must not report that all are equal.
TEST_F(CliTest, CompareSaysWhatIsNotThere) {
  const auto mesh = write("one.obj", c_triangle);
  const std::vector<std::string> sim = {"sim", mesh, "--out", out(), "--size", "20x15"},
                                 compare = {"compare", "one", "--out", out()};
  const auto folder = out() / "one" / "quadratic";
  auto verilator_alone = sim;
  verilator_alone.insert(verilator_alone.end(), {"--simulator", "verilator"});
  ASSERT_EQ(run(verilator_alone).exit_code, 0);
  EXPECT_THAT(run(compare), Ends(0, AllOf(ContainsRegex("one +ghdl +not compared: it was not run\n"),
                                          ContainsRegex("one +verilator +quadratic_shader.* 0 mismatches"))));

  ASSERT_EQ(run(sim).exit_code, 0);
  auto json = summary_of("one/quadratic");
  EXPECT_THAT(run(compare).output, Not(HasSubstr("not compared")));
  std::filesystem::remove(folder / "ghdl.trace");
  EXPECT_THAT(run(compare), Ends(2, HasSubstr("ghdl.trace is gone; run `make sim SCENE=one OUT=")));

  // The same folder as after an interrupted `sim`, and as after a fault in GHDL.
  std::filesystem::remove(folder / "summary.json");
  EXPECT_THAT(run(compare), Ends(2, HasSubstr("the run was interrupted, or has not reached this scene yet; "
                                              "run `make sim SCENE=one OUT=")));
  json["runs"][0]["fault"] = "it hangs";
  write(folder / "summary.json", json.dump());
  EXPECT_THAT(run(compare), Ends(1, AllOf(ContainsRegex("one +ghdl +differs, as sim found: it hangs\n"),
                                          ContainsRegex("one +verilator .* 0 mismatches"))));
  write(folder / "summary.json", "{}");
  EXPECT_THAT(run(compare), Ends(2, HasSubstr("summary.json: not a summary")));
}

TEST_F(CliTest, InitSaysWhatSetupMade) {
  EXPECT_THAT(
      run({"init", "spheres", "--size", "64x48"}).output,
      ContainsRegex("^init.txt: ([0-9]+) init vectors and 0 line records, of [0-9]+ bits, for quadratic"
                    "[^\n]*\n.* [1-9][0-9]* of them split in four: [0-9]+ pieces in all, in [0-9]+ init "
                    "vectors and 0 line records; [0-9]+ points shaded\n"));
  EXPECT_THAT(run({"init", "spheres", "--size", "64x48", "--shader", "spherical"}).output,
              ContainsRegex(" 0 of them cut into strips: [0-9]+ pieces in all, in [0-9]+ init vectors and "
                            "[1-9][0-9]* line records; [0-9]+ points where vectors were computed\n"));
}

TEST_F(CliTest, AMissingOrDyingToolExitsThree) {
  const auto mesh = write("one.obj", c_triangle);
  const std::vector<std::string> sim = {"sim", mesh, "--out", out(), "--size", "8x6", "--simulator", "ghdl"};
  EXPECT_THAT(run(sim, {{"PATH", at("empty")}}), Ends(3, HasSubstr("apt-get install ghdl")));
  EXPECT_THAT(run(sim, path_with("ghdl", "#!/bin/sh\nkill -SEGV $$\n")), Ends(3, HasSubstr("ghdl")));
}

// Printed output is a result, too.
TEST_F(CliTest, AFullStandardOutputExitsThreeAndIsReported) {
  const auto full = [&](const std::string& arguments) {
    return run_as({"sh", "-c", fmt::format("exec '{}' {} >/dev/full", HALFWAY_PROGRAM, arguments)});
  };
  const std::string small = " matte --size 40x30 --out out --simulator verilator";
  for (const std::string& arguments :
       {std::string("--help"), std::string("plan matte"), "sim" + small, "view --frames 1" + small}) {
    EXPECT_THAT(full(arguments), Ends(3, AllOf(HasSubstr("standard output: not all could be written"),
                                               Not(HasSubstr("please report it")))))
        << arguments;
  }
  EXPECT_THAT(full("view --frames 1" + small).output, HasSubstr("(No space left on device)"));
}

// A scene's name is that of a file, so it may contain any bytes. The texts of summary.json are UTF-8.
TEST_F(CliTest, AScenesNameMayBeAnyBytes) {
  const auto scene = write("caf\xe9.toml", "[[mesh]]\nkind = \"box\"\n");
  EXPECT_THAT(run({"sim", scene, "--size", "20x15", "--simulator", "verilator", "--out", out()}),
              Ends(0, ::testing::_));
  EXPECT_EQ(summary_of("caf\xe9/quadratic").at("scene"), "caf\xef\xbf\xbd");
}

TEST_F(CliTest, WhatAFileSaysDoesNotReachTheTerminalRaw) {
  const auto scene = write("red.toml", "\"\\u001b[31mred\" = 1\n");
  EXPECT_THAT(run({"sim", scene, "--out", out()}),
              Ends(2, AllOf(HasSubstr("unknown key '?[31mred'"), Not(HasSubstr("\x1b")))));
}

TEST_F(CliTest, TooLittleMemoryExitsThree) {
  if (c_sanitized) GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
  // The memory that the libraries need when loaded, plus a little more.
  EXPECT_THAT(run_as({"bash", "-c",
                      std::string("ulimit -c 0; ulimit -v 700000; exec '") + HALFWAY_PROGRAM +
                          "' sim spheres --size 4096x4096 --simulator verilator --out out"}),
              Ends(3, HasSubstr("out of memory")));
}

// The last fragment is output in the last of the clocks that `sim` counts, for any latency of the shader.
TEST_F(CliTest, WhyAgreesOnRightHardwareAndPrintsTheFragmentsClock) {
  const auto mesh = write("one.obj", c_triangle);
  const auto given = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--size", "40x30", "--out", out()});
    return run(arguments);
  };
  ASSERT_EQ(given({"sim", mesh, "--simulator", "verilator"}).exit_code, 0);
  const auto trace = must(read_trace(out() / "one" / "quadratic" / "verilator.trace", ""));
  ASSERT_TRUE(trace.cycles);
  const Fragment& last = trace.fragments.back();
  EXPECT_THAT(given({"why", mesh, "--pixel", fmt::format("{},{}", last.x, last.y)}),
              Ends(0, AllOf(HasSubstr("line stage, cycle "), HasSubstr("span stage, cycle "),
                            HasSubstr(fmt::format("fragment stage, cycle {}\n", *trace.cycles - 1)),
                            HasSubstr("agree at every stage"), Not(HasSubstr("differs")))));
  EXPECT_THAT(given({"why", mesh, "--pixel", "0,0"}), Ends(0, HasSubstr("0 triangles cover it")));
}

// Wrong hardware: a copy of the sources with one change.
struct Fault {
  const char *name, *shader, *file, *from, *to, *stage;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class WrongRtl : public CliTest, public ::testing::WithParamInterface<Fault> {
 protected:
  std::filesystem::path copy() const { return at("source"); }
  /// Changes the first `from` after `after` in a file of rtl/.
  void change(const std::string& file, const std::string& after, const std::string& from,
              const std::string& to) const {
    replace_in(copy_checkout() / "rtl" / file, from, to, after);
  }
  Outcome sim(const std::string& shader, const std::string& simulator) const {
    return run({"--source", copy(), "sim", "spheres", "--shader", shader, "--size", "96x72", "--simulator",
                simulator, "--out", out()});
  }
};

TEST_P(WrongRtl, IsCaughtAndLocated) {
  const Fault& fault = GetParam();
  change(fault.file, "", fault.from, fault.to);
  EXPECT_THAT(sim(fault.shader, "ghdl"), Ends(1, HasSubstr("ghdl differs from the golden model")));
  EXPECT_THAT(run({"--source", copy(), "why", "spheres", "--shader", fault.shader, "--pixel", "20,20",
                   "--size", "96x72"}),
              Ends(1, AllOf(HasSubstr("first difference in the frame: "), HasSubstr(fault.stage))));
}

using WrongTable = WrongRtl;

TEST_F(WrongTable, AFlippedBitOfARomIsCaught) {
  change("tables/cosine_pkg.vhd", "c_exact_cosine_16_9x8", "245, 244,", "245, 116,");
  EXPECT_THAT(sim("spherical", "verilator"),
              Ends(1, AllOf(HasSubstr("verilator differs from the golden model"),
                            ContainsRegex("rtl/tables/cosine_pkg.vhd:[0-9]+: not what the generator"))));
}

// If the hardware does not stop, GHDL's testbench ends the run and reports no cycles.
using RunawayRtl = WrongRtl;
TEST_F(RunawayRtl, UncountedCyclesAreNull) {
  change("raster/span_stage.vhd", "", "r.remaining - 1;", "r.remaining;");
  EXPECT_THAT(sim("quadratic", "ghdl"),
              Ends(1, AllOf(ContainsRegex("\\| ghdl: [0-9]+ mismatches \\| "), Not(HasSubstr("cycles,")))));
  const auto json = summary_of("spheres/quadratic");
  EXPECT_TRUE(json["runs"][0]["cycles"].is_null()) << json;
  EXPECT_TRUE(json["runs"][0]["seconds"].is_null()) << json;
  EXPECT_NE(json["runs"][0]["fault"], "");
  EXPECT_THAT(run({"compare", "spheres", "--out", out()}), Ends(1, HasSubstr("differs, as sim found: ")));
}

// A line stage and a sample stage in `make test`, because each fault is analysed with all of the RTL.
const auto c_name_of_fault = [](const auto& test) { return std::string(test.param.name); };
INSTANTIATE_TEST_SUITE_P(
    Quick, WrongRtl,
    ::testing::Values(Fault{"part_interpolator_sign", "quadratic", "interpolation/part_interpolator.vhd",
                            "sum_of(value, addend", "sum_of(value, not addend", "line stage"},
                      Fault{"angle_not_folded", "spherical", "arithmetic/angle_address.vhd",
                            "not angle when angle(c_sign) = '1' else angle", "angle", "sample stage"}),
    c_name_of_fault);
INSTANTIATE_TEST_SUITE_P(
    Whole, WrongRtl,
    ::testing::Values(Fault{"edge_without_carry", "quadratic", "raster/edge_walker.vhd",
                            "r.quotient & r.carry", "r.quotient & '0'", "edge_walker"},
                      Fault{"saturate_off_by_a_bit", "quadratic", "arithmetic/saturate.vhd",
                            "value(c_result_high downto g_fraction_bits)",
                            "value(c_result_high + 1 downto g_fraction_bits + 1)", "fragment stage"},
                      Fault{"factors_of_the_slice_inverted", "spherical", "illumination/specular_slice.vhd",
                            "start => part(part'high downto c_factors_low)",
                            "start => not part(part'high downto c_factors_low)",
                            "product stage (multiplier, or specular_slice around it)"}),
    c_name_of_fault);

}  // namespace
}  // namespace halfway
