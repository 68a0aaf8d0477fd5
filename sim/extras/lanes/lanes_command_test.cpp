// SPDX-License-Identifier: Apache-2.0
// Tests of `halfway sim`, `compare` and `view` with lanes.
#include <gmock/gmock.h>

#include "sim/cli/command_test.hpp"
#include "sim/files/image.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

using LanesCommand = CommandTest;

TEST_F(LanesCommand, SimDrawsTheSameWithoutCycles) {
  for (const std::string threads : {"1", "3"}) {
    EXPECT_THAT(run({"sim", "matte", "--size", "64x48", "--simulator", "lanes", "--threads", threads, "--out",
                     "out"}),
                Ends(0, AllOf(ContainsRegex("[1-9][0-9]* fragments \\| lanes: 0 mismatches, "),
                              Not(HasSubstr("cycles")), Not(HasSubstr("verilator")))));
    const std::filesystem::path folder = at("out/matte/quadratic");
    EXPECT_EQ(must(read_png(folder / "golden.png")).rgb, must(read_png(folder / "lanes.png")).rgb);
    EXPECT_THAT(text_of(folder / "summary.json"),
                ContainsRegex("\"simulator\": \"lanes\",\n *\"cycles\": null"));
    EXPECT_THAT(run({"compare", "matte", "--out", "out"}),
                Ends(0, ContainsRegex("lanes +[a-z0-9_-]+ 64x48 +[1-9][0-9]* fragments, 0 mismatch")));
  }
}

TEST_F(LanesCommand, RefusesObjectProcessors) {
  EXPECT_THAT(run({"sim", "shadows", "--simulator", "lanes", "--shader", "processors", "--size", "64x48",
                   "--out", "out"}),
              Ends(2, HasSubstr("lanes do not simulate object processors")));
}

TEST_F(LanesCommand, ViewDrawsTheFramesOfVerilator) {
  const auto view = [&](const std::string& shader, const std::string& threads, const std::string& simulator) {
    return run({"view", "matte", "--size", "64x48", "--frames", "3", "--shader", shader, "--threads", threads,
                "--simulator", simulator, "--out", simulator});
  };
  for (const std::string shader : {"quadratic", "spherical", "processors"}) {
    EXPECT_THAT(view(shader, "2", "verilator"), Ends(0, ::testing::_));
    for (const std::string threads : {"1", "3"}) {
      EXPECT_THAT(view(shader, threads, "lanes"),
                  Ends(0, AllOf(ContainsRegex("[1-9][0-9]* fragments \\| lanes: 0 mismatches"),
                                ContainsRegex("golden model [0-9.]+, lanes [0-9.]+, comparison"))));
      for (const std::string name : {"frame_0000.png", "frame_0001.png", "frame_0002.png"})
        EXPECT_EQ(must(read_png(at("lanes/" + name))).rgb, must(read_png(at("verilator/" + name))).rgb)
            << shader << name;
    }
  }
}

TEST_F(LanesCommand, SimDrawsOwnTables) {
  EXPECT_THAT(run({"sim", "spheres", "--shader", "spherical", "--own-tables", "--size", "64x48",
                   "--simulator", "lanes", "--out", "out"}),
              Ends(0, ContainsRegex("lanes: 0 mismatches")));
}

// A fault of the RTL that is visible in frame 2 only: Verilator draws this frame again.
TEST_F(LanesCommand, VerilatorFindsTheDifference) {
  const std::filesystem::path copy = copy_checkout();
  replace_in(copy / "rtl/interpolation/part_interpolator.vhd", "sum_of(value, addend",
             "sum_of(value, not addend");
  write_averted();
  EXPECT_THAT(run({"--source", copy, "view", "averted.toml", "--frames", "4", "--size", "40x30", "--threads",
                   "3", "--simulator", "lanes"}),
              Ends(1, AllOf(HasSubstr("averted: frame 2: verilator differs from the golden model\n"),
                            ContainsRegex("3 frames of 1 triangles.*lanes, verilator in frame 2: "
                                          "[1-9][0-9]* mismatches in frame 2 "))));
}

// Lanes that stop in the middle of frame 0's triangles. Verilator draws the frame without a fault.
TEST_F(LanesCommand, AFaultOfTheLanesIsAnError) {
  const std::filesystem::path copy = copy_checkout();
  replace_in(copy / "sim/extras/lanes/lane_runner.hpp", "      const std::uint32_t moved = block();\n",
             "      const std::uint32_t moved = block();\n      static bool broken = false;\n"
             "      if (!broken) {\n        broken = true;\n        return halfway_hang;\n      }\n");
  for (const bool compare : {true, false}) {
    std::vector<std::string> arguments = {"--source",  copy,       "view",  "matte",       "--size",
                                          "320x240",   "--frames", "3",     "--simulator", "lanes",
                                          "--threads", "1",        "--out", "turn"};
    if (!compare) arguments.push_back("--no-compare");
    EXPECT_THAT(run(arguments),
                Ends(1, ContainsRegex("matte: frame 0: [^\n]* in lanes: hang: [^\n]*; Verilator draws it "
                                      "without a difference. The lanes are wrong")));
  }
}

// Also with `auto`, which selects lanes for this amount of work.
TEST_F(LanesCommand, VerilatorDrawsIfLanesAreUnavailable) {
  const std::filesystem::path copy = copy_checkout();
  write(copy / "sim/extras/lanes/lane_harness.cpp", "#error spoilt\n");
  EXPECT_THAT(run({"--source", copy, "view", "matte", "--size", "64x48", "--simulator", "lanes"}),
              Ends(3, HasSubstr("spoilt")));
  write_averted();
  EXPECT_THAT(run({"--source", copy, "view", "averted.toml", "--size", "2048x2048", "--frames", "64",
                   "--video", "turn.mp4", "--no-compare"},
                  path_with_ffmpeg(c_copy)),
              Ends(0, AllOf(HasSubstr("averted: Verilator draws, for lanes cannot be had: "),
                            ContainsRegex("fragments \\| verilator: not compared"))));
}

}  // namespace
}  // namespace halfway
