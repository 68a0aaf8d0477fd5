// SPDX-License-Identifier: Apache-2.0
// Tests of `halfway view`: it draws the same frames as `halfway sim`, and handles missing, wrong and
// interrupted output.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "scene/turntable.hpp"
#include "sim/cli/command_test.hpp"
#include "sim/files/image.hpp"
#include "sim/files/terminal_picture.hpp"
#include "sim/files/test/built_in_scene.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class ViewCommand : public CommandTest {
 protected:
  /// Runs at 64x48.
  Outcome view(std::vector<std::string> arguments, Environment environment = {}) const {
    arguments.insert(arguments.begin(), {"view", "--size", "64x48"});
    return run(std::move(arguments), std::move(environment));
  }

  std::set<std::string> names(const std::string& folder) const {
    std::set<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(at(folder)))
      if (entry.path().filename() != ".lock") found.insert(entry.path().filename().string());
    return found;
  }
  Frame frame(const std::string& name) const { return must(read_png(at(name))); }
};

// Equal bit for bit, for each shader and any number of threads. The hardware is not reset between frames.
TEST_F(ViewCommand, DrawsTheFramesOfSimFromEachPosition) {
  const std::string text = text_of(c_built_in_scenes / "matte.toml");
  const Scene scene = built_in_scene("matte");
  for (const std::string shader : {"quadratic", "spherical", "processors"}) {
    for (const std::string threads : {"1", "2"}) {
      const Outcome drawn =
          view({"matte", "--frames", "3", "--shader", shader, "--threads", threads, "--out", threads});
      ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
      EXPECT_THAT(drawn.output,
                  AllOf(ContainsRegex("matte +" + shader +
                                      " +exact +64x48 +3 frames of [0-9]+ triangles, "
                                      "[1-9][0-9]* fragments \\| verilator: 0 mismatches \\| "
                                      "[0-9.]+ frames a second, [0-9.]+ s on " +
                                      threads + " threads?\n"),
                        ContainsRegex("a frame: setup [0-9.]+ ms, golden model [0-9.]+, Verilator [0-9.]+, "
                                      "comparison [0-9.]+, assembly [0-9.]+, images [0-9.]+\n"),
                        HasSubstr(threads + "/frame_0000.png to frame_0002.png\n")));
      EXPECT_THAT(names(threads), ElementsAre("frame_0000.png", "frame_0001.png", "frame_0002.png"));
    }
    for (const std::uint32_t n : {0, 1, 2}) {
      const glm::dvec3 eye = turned(scene.camera, n, 3).eye_world;
      std::string moved = text;
      const std::size_t line = moved.find("eye = ");
      moved.replace(line, moved.find('\n', line) - line,
                    fmt::format("eye = [{:.17g}, {:.17g}, {:.17g}]", eye.x, eye.y, eye.z));
      write("moved.toml", moved);
      const Outcome sim = run({"sim", "moved.toml", "--size", "64x48", "--shader", shader, "--simulator",
                               "verilator", "--out", "out"});
      ASSERT_EQ(sim.exit_code, 0) << sim.output;
      const Frame expected = frame("out/moved/" + shader + "/verilator.png");
      for (const char* threads : {"1", "2"})
        EXPECT_EQ(frame(fmt::format("{}/frame_{:04}.png", threads, n)).rgb, expected.rgb) << shader << n;
    }
    EXPECT_NE(frame("2/frame_0000.png").rgb, frame("2/frame_0001.png").rgb);
  }
}

TEST_F(ViewCommand, ReplacesOlderFramesAndNothingElse) {
  write("turn/frame_0002.png", "old");
  write("turn/frame_0009.ppm.part-1-0", "broken off");
  write("turn/frame_x.png", "mine");
  EXPECT_THAT(view({"matte", "--frames", "2", "--format", "ppm", "--out", "turn"}), Ends(0, ::testing::_));
  EXPECT_THAT(names("turn"), ElementsAre("frame_0000.ppm", "frame_0001.ppm", "frame_x.png"));
  // The default folder is next to sim's results, named by scene and shader.
  EXPECT_EQ(view({"matte", "--frames", "1"}).exit_code, 0);
  EXPECT_THAT(names("build/out/matte/quadratic/view"), ElementsAre("frame_0000.png"));
}

TEST_F(ViewCommand, BadUsageExitsTwoAndSaysWhatToDo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"matte", "--simulator", "ghdl"}, "--simulator: 'ghdl' is none of auto, verilator and lanes"},
      {{"matte", "--frames", "0"}, "--frames: Value 0 not in range 1 to 10000"},
      {{"matte", "--format", "gif"}, "--format: gif not in {png,ppm}"},
      {{"matte", "--format", "ppm", "--terminal", "--columns", "9"}, "give --out as well"},
      {{"matte", "--rate", "16"}, "--rate requires --video"},
      {{"matte", "--video", "turn"}, "--video: 'turn' is not the name of a video"},
      {{"matte", "--video", "turn.xyz"},
       "--video: 'turn.xyz' does not have the ending of a video; take one of .mp4"},
      // Image formats: ffmpeg would overwrite one file, or write several, and no file with the given name.
      {{"matte", "--video", "turn%d.png"}, "--video: 'turn%d.png' does not have the ending of a video"},
      {{"matte", "--columns", "20"}, "--columns requires --terminal"},
      {{"matte", "--terminal", "--columns", "9", "--colours", "16"}, "--colours: 16 not in {24bit,256}"},
      {{"matte", "--terminal"}, "standard output is no terminal"},
      // No user, not even root, can write to this folder.
      {{"matte", "--out", "/proc/sys"}, "/proc/sys"},
      {{"matte", "--out", "file/out"}, "file/out"}};
  write("file", "not a folder");
  for (const auto& [arguments, expected] : cases) EXPECT_THAT(view(arguments), Ends(2, HasSubstr(expected)));
  EXPECT_THAT(names("."), ElementsAre("file"));
  EXPECT_THAT(view({"matte", "--video", "/proc/sys/turn.mp4"}, path_with_ffmpeg(c_copy)),
              Ends(2, ::testing::_));
}

TEST_F(ViewCommand, NoFfmpegExitsThreeBeforeAnythingIsDrawn) {
  ASSERT_TRUE(make_folders(at("empty")));
  EXPECT_THAT(view({"matte", "--video", "turn.mp4", "--out", "turn"}, {{"PATH", at("empty").string()}}),
              Ends(3, HasSubstr("apt-get install ffmpeg")));
  EXPECT_THAT(names("."), ElementsAre("empty"));
}

// ffmpeg fails early, or only at the end. Its message is printed, and an older video stays.
TEST_F(ViewCommand, AFailedVideoLeavesNoPartialFile) {
  write("films/turn.mp4", "old");
  for (const std::string& script :
       {std::string("echo no such encoder; exit 1\n"), c_copy + "echo no such encoder; exit 1\n"}) {
    EXPECT_THAT(view({"matte", "--frames", "3", "--video", "films/turn.mp4"}, path_with_ffmpeg(script)),
                Ends(3, AllOf(HasSubstr("films/turn.mp4: ffmpeg could not make it (exit status 1)"),
                              HasSubstr("no such encoder"))));
    EXPECT_EQ(text_of("films/turn.mp4"), "old");
    EXPECT_THAT(names("films"), ElementsAre("turn.mp4"));
  }
}

// Each frame in order, with every ending that the error message offers.
TEST_F(ViewCommand, AVideoByTheRealFfmpegPlays) {
  ASSERT_FALSE(find_program("ffmpeg").empty()) << "no ffmpeg: apt-get install ffmpeg";
  const std::string refused = view({"matte", "--video", "turn.xyz"}).output, offer = "take one of ";
  ASSERT_THAT(refused, HasSubstr(offer));
  std::istringstream endings(refused.substr(refused.find(offer) + offer.size()));
  int played = 0;
  for (std::string ending; endings >> ending; ++played) {
    const std::string video = "turn 100%d" + ending;
    const Outcome drawn = view({"spheres", "--frames", "3", "--threads", "3", "--video", video, "--rate",
                                "24", "--out", "turn", "--format", "ppm"});
    ASSERT_THAT(drawn, Ends(0, HasSubstr(video + ": 24 frames a second\n")));
    const Outcome decoded =
        run_as({"ffmpeg", "-nostdin", "-loglevel", "error", "-y", "-i", at(video).string(), "-f", "rawvideo",
                "-pix_fmt", "rgb24", "-fps_mode", "passthrough", at("decoded").string()});
    ASSERT_EQ(decoded.exit_code, 0) << decoded.output;
    std::string frames;
    for (int n = 0; n < 3; ++n) frames += text_of(fmt::format("turn/frame_{:04}.ppm", n)).substr(13);
    const std::string shown = text_of("decoded");
    ASSERT_EQ(shown.size(), frames.size()) << ending;
    double off = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
      off += std::abs(static_cast<unsigned char>(shown[i]) - static_cast<unsigned char>(frames[i]));
    EXPECT_LT(off / static_cast<double>(shown.size()), 6.0) << ending << ": lossy, but close";
  }
  EXPECT_GT(played, 5);
}

TEST_F(ViewCommand, DrawsInTheTerminal) {
  const Outcome drawn = view(
      {"matte", "--frames", "2", "--terminal", "--columns", "20", "--colours", "24bit", "--out", "turn"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.output;
  std::size_t from = 0;
  for (int n = 0; n < 2; ++n) {
    const std::string picture =
        terminal_picture(frame(fmt::format("turn/frame_{:04}.png", n)), {20, 15}, TerminalColours::full) +
        fmt::format("frame {} of 2, ", n + 1);
    from = drawn.output.find(picture, from);
    EXPECT_NE(from, std::string::npos) << n;
  }
  // No cursor movement without a terminal.
  EXPECT_THAT(drawn.output, Not(HasSubstr("\033[H")));
  EXPECT_THAT(view({"matte", "--frames", "1", "--terminal", "--columns", "20", "--colours", "256"}).output,
              AllOf(HasSubstr("\033[38;5;"), Not(HasSubstr("\033[38;2;"))));
}

// A signal between two frames or during one: every existing file is complete, and the shell sees the signal.
TEST_F(ViewCommand, AnInterruptedRunLeavesNoPartialFile) {
  for (const std::string signal : {"INT", "TERM"}) {
    // With job control, because a shell without it ignores INT in background processes.
    EXPECT_THAT(
        run_as(
            {"bash", "-c",
             fmt::format(
                 "set -m; '{}' view matte --size 320x240 --frames 10000 --out turn --video films/turn.mp4 & "
                 "until [ -e turn/frame_0009.png ]; do sleep 0.05; kill -0 $! || exit 9; done; "
                 "kill -{} $!; wait $!; exit $?",
                 HALFWAY_PROGRAM, signal)},
            path_with_ffmpeg(c_copy)),
        Ends(signal == "INT" ? 130 : 143, Not(HasSubstr("frames a second"))));
    const auto left = names("turn");
    EXPECT_GE(left.size(), 10U);
    EXPECT_LT(left.size(), 10'000U);
    for (const std::string& name : left) {
      EXPECT_TRUE(name.ends_with(".png")) << name;
      EXPECT_EQ(frame("turn/" + name).size.height, 240U) << name;
    }
    EXPECT_THAT(names("films"), IsEmpty());
  }
}

// Hardware with a fault that is visible in frame 2 only: before it the only triangle is back-facing.
TEST_F(ViewCommand, ReportsTheFrameWhereTheRtlDiffers) {
  const std::filesystem::path copy = copy_checkout();
  replace_in(copy / "rtl/interpolation/part_interpolator.vhd", "sum_of(value, addend",
             "sum_of(value, not addend");
  write_averted();
  EXPECT_THAT(
      run({"--source", copy, "view", "averted.toml", "--frames", "4", "--size", "40x30", "--threads", "3",
           "--simulator", "verilator", "--out", "turn", "--video", "turn.mp4"},
          path_with_ffmpeg(c_copy)),
      Ends(1, AllOf(HasSubstr("averted: frame 2: verilator differs from the golden model\n"),
                    ContainsRegex("triangle 0, line [0-9]+, pixel [0-9]+, [a-z]+: golden [0-9]+, Verilator"),
                    HasSubstr("of the scene with eye = [0.3, 0.3, 3] in [camera]"),
                    ContainsRegex("3 frames of 1 triangles.*verilator: [1-9][0-9]* mismatches in frame 2 "),
                    HasSubstr("2 of 3 frames show no triangle"))));
  EXPECT_FALSE(std::filesystem::exists(at("turn.mp4")));

  // The golden model is not run, and the output does not mention it.
  EXPECT_THAT(run({"--source", copy, "view", "averted.toml", "--frames", "4", "--size", "40x30",
                   "--no-compare", "--out", "turn"}),
              Ends(0, AllOf(HasSubstr("verilator: not compared with the golden model"),
                            Not(HasSubstr("mismatches")), Not(HasSubstr("golden model 0")))));
}

}  // namespace
}  // namespace halfway
