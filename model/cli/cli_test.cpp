// SPDX-License-Identifier: Apache-2.0
// The program as a user meets it: exit codes, what stands where, and every kind of bad input.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "common/file.hpp"
#include "common/subprocess.hpp"

namespace halfway {
namespace {

using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

class CliTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto folder = TemporaryFolder::make(std::filesystem::temp_directory_path());
    ASSERT_TRUE(folder) << folder.error().message;
    folder_.emplace(std::move(*folder));
  }

  struct Outcome {
    int exit_code;
    std::string output;  // both streams
  };
  Outcome run(std::vector<std::string> arguments,
              std::vector<std::pair<std::string, std::string>> environment = {}) const {
    arguments.insert(arguments.begin(), HALFWAY_PROGRAM);
    return run_as(std::move(arguments), std::move(environment));
  }
  Outcome run_as(std::vector<std::string> arguments,
                 std::vector<std::pair<std::string, std::string>> environment = {}) const {
    Command command;
    command.arguments = std::move(arguments);
    command.working_folder = folder_->path();
    command.environment = std::move(environment);
    command.timeout = std::chrono::minutes(5);
    const auto end = run_process(command, "");
    if (!end) return {-1, end.error().message};
    if (end->signal != 0 || end->timed_out) return {-2, end->how() + "\n" + end->output};
    return {end->exit_status, end->output};
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const std::filesystem::path path = folder_->path() / name;
    EXPECT_TRUE(write_file(path, text));
    return path;
  }
  std::filesystem::path out() const { return folder_->path() / "out"; }

  std::optional<TemporaryFolder> folder_;
};

const std::string c_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

TEST_F(CliTest, HelpGoesToStandardOutputAndExitsZero) {
  for (const std::string command : {"sim", "plan", "render", "init", "compare", "why", "tables"}) {
    const Outcome help = run({command, "--help"});
    EXPECT_EQ(help.exit_code, 0) << help.output;
    EXPECT_THAT(help.output, HasSubstr("Usage: "));
  }
  EXPECT_EQ(run({"--help"}).exit_code, 0);
  // With standard output closed to us, nothing of the help may be left on standard error.
  const Outcome quiet = run_as({"sh", "-c", std::string("exec '") + HALFWAY_PROGRAM + "' --help >/dev/null"});
  EXPECT_EQ(quiet.output, "");
}

TEST_F(CliTest, BadUsageExitsTwoAndSaysWhatToDo) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{}, "halfway --help"},
      {{"simulate"}, "halfway --help"},
      {{"sim", "--nonsense"}, "--nonsense"},
      {{"sim", "spheres", "--shader", "toon"}, "--shader: 'toon' is not a shader"},
      {{"sim", "spheres", "--preset", "best"}, "--preset: 'best' is not a preset"},
      {{"sim", "spheres", "--size", "0x10"}, "--size: 0x10 is out of range"},
      {{"sim", "spheres", "--size", "10x0"}, "--size: 10x0 is out of range"},
      {{"sim", "spheres", "--size", "4097x10"}, "1 to 4096"},
      {{"sim", "spheres", "--size", "99999999999x10"}, "is not WIDTHxHEIGHT"},
      {{"sim", "spheres", "--size", "-4x10"}, "is not WIDTHxHEIGHT"},
      {{"sim", "spheres", "--size", "640"}, "is not WIDTHxHEIGHT"},
      {{"sim", "spheres", "--simulator", "modelsim"}, "is not a simulator"},
      {{"sim", "spheres", "--threshold", "nan"}, "--threshold"},
      {{"sim", "spheres", "--threshold", "-1"}, "--threshold: -1 is not above 0"},
      {{"sim", "spheres", "--max-level", "6"}, "--max-level: 6 is not 0 to 5"},
      {{"sim", "spheres", "--highlight-test", "x"}, "is not a test"},
      {{"why", "spheres"}, "--pixel"},
      {{"why", "spheres", "--pixel", "12"}, "is not x,y"},
      {{"why", "spheres", "--pixel", "640,0"}, "outside the frame"},
      {{"render", "spheres", "--method", "oil"}, "--method: 'oil' is not a method"},
      {{"compare", "spheres"}, "run `make sim SCENE=spheres` first"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(expected));
  }
}

TEST_F(CliTest, BadScenesAndMeshesExitTwoAndLeaveNothing) {
  const std::string scene =
      "[[directional]]\nto_light = [0, 0, 1]\n[[material]]\nname = \"m\"\nexponent = 20\n";
  const std::string mesh = "[[mesh]]\nkind = \"sphere\"\nslices = 8\nstacks = 6\nmaterial = \"m\"\n";
  const std::vector<std::tuple<std::string, std::string, std::string>> cases = {
      {"empty.obj", "", "empty.obj"},
      {"faceless.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "faceless.obj"},
      {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "range.obj:4:"},
      {"nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", "nan.obj:2:"},
      {"inf.obj", "v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n", "inf.obj:2:"},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "flat.obj"},
      {"noise.ply", std::string("ply\0\1\2\3garbage", 14), "noise.ply"},
      {"noise.stl", "solid nothing", "noise.stl"},
      {"noise.glb", "glTFxxxx", "noise.glb"},
      {"broken.toml", "[camera\nfov = 3\n", "broken.toml:1:"},
      {"key.toml", scene + mesh + "colour = 3\n", "key.toml:11:"},
      {"n.toml", "[[material]]\nname = \"m\"\nexponent = 0.5\n" + mesh, "n.toml:3:"},
      {"k.toml", "[[material]]\nname = \"m\"\nk_d = -1\n" + mesh, "k.toml:3:"},
      {"none.toml", scene, "none.toml"},
      {"many.toml",
       scene + "[[mesh]]\nkind = \"sphere\"\nslices = 100000\nstacks = 100000\nmaterial = \"m\"\n",
       "many.toml"},
      {"missing.toml", scene + "[[mesh]]\nfile = \"gone.obj\"\nmaterial = \"m\"\n", "gone.obj"},
  };
  for (const auto& [name, text, expected] : cases) {
    const std::filesystem::path path = write(name, text);
    const Outcome outcome = run({"sim", path, "--out", out()});
    EXPECT_EQ(outcome.exit_code, 2) << name << ": " << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(expected)) << name;
    EXPECT_FALSE(std::filesystem::exists(out())) << name;
  }
  EXPECT_EQ(run({"sim", "no-such-scene", "--out", out()}).exit_code, 2);
  EXPECT_EQ(run({"sim", folder_->path(), "--out", out()}).exit_code, 2);
}

TEST_F(CliTest, CameraInsideTheMeshOrBehindItStillDraws) {
  const std::string common =
      "[[directional]]\nto_light = [0, 0, 1]\n[[material]]\nname = \"m\"\n[[mesh]]\nkind = "
      "\"sphere\"\nslices = 8\n"
      "stacks = 6\nradius = 1\nmaterial = \"m\"\n";
  const auto inside =
      write("inside.toml", "[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\nup = [0, 1, 0]\n" + common);
  const auto behind =
      write("behind.toml", "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 9]\nup = [0, 1, 0]\n" + common);
  const auto through =
      write("through.toml", "[camera]\neye = [0, 0, 0.99]\ntarget = [0, 0.3, 5]\nup = [0, 1, 0]\n" + common);
  for (const auto& scene : {inside, behind, through}) {
    const Outcome outcome =
        run({"sim", scene, "--out", out(), "--size", "64x48", "--simulator", "verilator"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    EXPECT_THAT(outcome.output, HasSubstr(" 0 mismatches"));
  }
}

TEST_F(CliTest, SummaryHoldsWhatTheRunWas) {
  const auto mesh = write("one.obj", c_triangle);
  const Outcome outcome = run({"sim", mesh, "--out", out(), "--size", "40x30"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const auto text = read_file(out() / "one" / "quadratic" / "summary.json");
  ASSERT_TRUE(text) << text.error().message;
  const auto json = nlohmann::json::parse(*text);
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
  for (const char* file : {"reference.png", "golden.png", "ghdl.png", "verilator.png", "diff.png", "init.txt",
                           "golden.trace", "ghdl.trace", "verilator.trace"})
    EXPECT_TRUE(std::filesystem::exists(out() / "one" / "quadratic" / file)) << file;
  EXPECT_EQ(run({"compare", mesh, "--out", out()}).exit_code, 0);
}

// Both kinds of hardware leave their results side by side, with the same fragments and frames.
TEST_F(CliTest, AllEffectsHaveAFolderOfTheirOwn) {
  const auto mesh = write("one.obj", c_triangle);
  for (const std::string shader : {"quadratic", "spherical"}) {
    const auto sim = [&](std::vector<std::string> more) {
      std::vector<std::string> arguments = {"sim",    mesh,    "--out",    out(),
                                            "--size", "40x30", "--shader", shader};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    };
    sim({});
    sim({"--all-effects"});
    const auto lean = out() / "one" / shader, all = out() / "one" / (shader + "-all-effects");
    for (const char* file : {"golden.png", "ghdl.png", "verilator.png", "reference.png", "diff.png"}) {
      const auto a = read_file(lean / file), b = read_file(all / file);
      ASSERT_TRUE(a && b) << file;
      EXPECT_EQ(*a, *b) << shader << " " << file;
    }
    const auto lean_text = read_file(lean / "summary.json"), all_text = read_file(all / "summary.json");
    ASSERT_TRUE(lean_text && all_text);
    const auto lean_json = nlohmann::json::parse(*lean_text), all_json = nlohmann::json::parse(*all_text);
    EXPECT_EQ(lean_json["hardware"]["all_effects"], false);
    EXPECT_EQ(all_json["hardware"]["all_effects"], true);
    EXPECT_NE(lean_json["hardware"]["key"], all_json["hardware"]["key"]);
    EXPECT_EQ(lean_json["fragments"], all_json["fragments"]);
    EXPECT_EQ(run({"compare", mesh, "--out", out(), "--shader", shader, "--all-effects"}).exit_code, 0);
    std::filesystem::remove_all(all);
    EXPECT_EQ(run({"compare", mesh, "--out", out(), "--shader", shader, "--all-effects"}).exit_code, 2);
    EXPECT_EQ(run({"compare", mesh, "--out", out(), "--shader", shader}).exit_code, 0);
  }
}

TEST_F(CliTest, CompareSeesAChangedTraceAndRefusesADamagedOne) {
  const auto mesh = write("one.obj", c_triangle);
  ASSERT_EQ(run({"sim", mesh, "--out", out(), "--size", "20x15", "--simulator", "verilator"}).exit_code, 0);
  const std::filesystem::path path = out() / "one" / "quadratic" / "verilator.trace";
  const auto whole = read_file(path);
  ASSERT_TRUE(whole);

  // The first fragment's blue, one step off.
  const std::size_t line_end = whole->find('\n', whole->find('\n') + 1);
  const std::size_t blue = whole->rfind(' ', line_end) + 1;
  const int value = std::stoi(whole->substr(blue, line_end - blue));
  std::string changed = *whole;
  changed.replace(blue, line_end - blue, std::to_string(value == 255 ? 254 : value + 1));
  ASSERT_TRUE(write_file(path, changed));
  const Outcome differs = run({"compare", "one", "--out", out()});
  EXPECT_EQ(differs.exit_code, 1) << differs.output;
  EXPECT_THAT(differs.output,
              ContainsRegex("triangle 0, line [0-9]+, pixel [0-9]+, blue: golden [0-9]+, verilator"));

  for (const std::string& damaged :
       {whole->substr(0, whole->size() / 2), std::string("P6\n20 15\n"), std::string(),
        *whole + "1 2 3 4 5 6 7\n", std::string("halfway-trace 1 other-key\nend 0\n")}) {
    ASSERT_TRUE(write_file(path, damaged));
    const Outcome refused = run({"compare", "one", "--out", out()});
    EXPECT_EQ(refused.exit_code, 2) << refused.output;
    EXPECT_THAT(refused.output, HasSubstr("verilator.trace"));
  }
}

TEST_F(CliTest, AMissingOrDyingToolExitsThree) {
  const auto mesh = write("one.obj", c_triangle);
  const auto fake = folder_->path() / "bin";
  ASSERT_TRUE(make_folders(fake));
  const Outcome missing =
      run({"sim", mesh, "--out", out(), "--size", "8x6", "--simulator", "ghdl"}, {{"PATH", fake}});
  EXPECT_EQ(missing.exit_code, 3) << missing.output;
  EXPECT_THAT(missing.output, HasSubstr("apt-get install ghdl"));

  ASSERT_TRUE(write_file(fake / "ghdl", "#!/bin/sh\nkill -SEGV $$\n"));
  std::filesystem::permissions(fake / "ghdl", std::filesystem::perms::all);
  const Outcome dying = run({"sim", mesh, "--out", out(), "--size", "8x6", "--simulator", "ghdl"},
                            {{"PATH", fake.string() + ":/usr/bin:/bin"}});
  EXPECT_EQ(dying.exit_code, 3) << dying.output;
  EXPECT_THAT(dying.output, HasSubstr("ghdl"));
}

TEST_F(CliTest, AFullDiskExitsThreeAndLeavesNothingHalfWritten) {
  // A limit on file sizes stands for the full disk: writes fail in the same place.
  const Outcome outcome = run_as({"bash", "-c",
                                  std::string("trap '' XFSZ; ulimit -f 16; exec '") + HALFWAY_PROGRAM +
                                      "' sim spheres --size 320x240 --simulator verilator --out out"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  for (const char* file : {"summary.json", "init.txt", "golden.trace", "verilator.trace"})
    EXPECT_FALSE(std::filesystem::exists(out() / "spheres" / "quadratic" / file)) << file;
}

TEST_F(CliTest, AnUnwritableFolderIsBadInput) {
  write("file", "not a folder");
  const Outcome outcome = run({"sim", "spheres", "--size", "8x6", "--out", folder_->path() / "file" / "out"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("file"));
}

TEST_F(CliTest, WhyAgreesOnRightHardware) {
  const auto mesh = write("one.obj", c_triangle);
  const Outcome outcome = run({"why", mesh, "--pixel", "16,18", "--size", "40x30"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("line stage, cycle "), HasSubstr("span stage, cycle "),
                                    HasSubstr("fragment stage, cycle "), HasSubstr("agree at every stage"),
                                    Not(HasSubstr("differs"))));
  const Outcome nothing = run({"why", mesh, "--pixel", "0,0", "--size", "40x30"});
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_THAT(nothing.output, HasSubstr("0 triangles cover it"));
}

// Wrong hardware: a copy of the sources with one thing changed.
struct Fault {
  const char *name, *shader, *file, *from, *to, *stage;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class WrongRtl : public CliTest, public ::testing::WithParamInterface<Fault> {
 protected:
  std::filesystem::path copy() const { return folder_->path() / "source"; }
  /// The sources with the first `from` after `after` changed in a file of rtl/.
  void change(const std::string& file, const std::string& after, const std::string& from,
              const std::string& to) const {
    const std::filesystem::path source = HALFWAY_SOURCE_DIR;
    ASSERT_TRUE(make_folders(copy() / "model"));
    for (const char* part : {"rtl", "tb", "sim", "model/golden"})
      std::filesystem::copy(source / part, copy() / part, std::filesystem::copy_options::recursive);
    const auto text = read_file(copy() / "rtl" / file);
    ASSERT_TRUE(text);
    const std::size_t at = text->find(from, text->find(after));
    ASSERT_NE(at, std::string::npos) << "mend this test's list: '" << from << "' is not in " << file;
    std::string changed = *text;
    changed.replace(at, from.size(), to);
    ASSERT_TRUE(write_file(copy() / "rtl" / file, changed));
  }
  Outcome sim(const std::string& shader, const std::string& simulator) const {
    return run({"--source", copy(), "sim", "spheres", "--shader", shader, "--size", "96x72", "--simulator",
                simulator, "--out", out()});
  }
};

TEST_P(WrongRtl, IsCaughtAndLocated) {
  const Fault& fault = GetParam();
  ASSERT_NO_FATAL_FAILURE(change(fault.file, "", fault.from, fault.to));
  const Outcome drawn = sim(fault.shader, "ghdl");
  EXPECT_EQ(drawn.exit_code, 1) << drawn.output;
  EXPECT_THAT(drawn.output, HasSubstr("ghdl differs from the golden model"));
  const Outcome why = run({"--source", copy(), "why", "spheres", "--shader", fault.shader, "--pixel", "20,20",
                           "--size", "96x72"});
  EXPECT_EQ(why.exit_code, 1) << why.output;
  EXPECT_THAT(why.output, AllOf(HasSubstr("first difference in the frame: "), HasSubstr(fault.stage)));
}

using WrongTable = WrongRtl;

// A bit of a table that the scene's hardware has, and one of a table that it has not.
TEST_F(WrongTable, AFlippedBitOfARomIsCaught) {
  ASSERT_NO_FATAL_FAILURE(change("tables/cosine_pkg.vhd", "c_exact_cosine_16_9_8", "245, 244,", "245, 116,"));
  const Outcome used = sim("spherical", "verilator");
  EXPECT_EQ(used.exit_code, 1) << used.output;
  EXPECT_THAT(used.output, AllOf(HasSubstr("verilator differs from the golden model"),
                                 ContainsRegex("rtl/tables/cosine_pkg.vhd:[0-9]+: not what the generator")));
  const Outcome why = run(
      {"--source", copy(), "why", "spheres", "--shader", "spherical", "--pixel", "20,20", "--size", "96x72"});
  EXPECT_THAT(why.output, HasSubstr("first difference in the frame: sample stage (cosine_rom)"))
      << why.output;
}
TEST_F(WrongTable, AFlippedBitOfAnUnusedRomIsCaught) {
  ASSERT_NO_FATAL_FAILURE(change("tables/cosine_pkg.vhd", "c_exact_cosine_2_9_8", "250, ", "251, "));
  const Outcome unused = sim("spherical", "verilator");
  EXPECT_EQ(unused.exit_code, 1) << unused.output;
  EXPECT_THAT(unused.output,
              AllOf(HasSubstr(" 0 mismatches"),
                    ContainsRegex("rtl/tables/cosine_pkg.vhd:[0-9]+: not what the generator")));
}

INSTANTIATE_TEST_SUITE_P(
    Mutants, WrongRtl,
    ::testing::Values(Fault{"line_interpolator_sign", "quadratic", "interpolation/line_interpolator.vhd",
                            "r.value + signed(increment)", "r.value - signed(increment)", "line stage"},
                      Fault{"edge_without_carry", "quadratic", "raster/edge_walker.vhd",
                            "v.x := r.x + r.quotient + 1;", "v.x := r.x + r.quotient;", "edge_walker"},
                      Fault{"saturate_off_by_a_bit", "quadratic", "arithmetic/saturate.vhd",
                            "value(c_result_high downto g_fraction_bits)",
                            "value(c_result_high + 1 downto g_fraction_bits + 1)", "fragment stage"},
                      Fault{"span_one_pixel_long", "quadratic", "raster/triangle_walker.vhd",
                            "v.span.valid := not span_last;", "v.span.valid := '1';", "triangle_walker"},
                      Fault{"angle_not_folded", "spherical", "arithmetic/angle_address.vhd",
                            "not angle when angle(c_sign) = '1' else angle", "angle", "sample stage"},
                      Fault{"product_of_the_wrong_operand", "spherical", "arithmetic/multiplier.vhd",
                            "unsigned(a) * unsigned(b)", "unsigned(a) * unsigned(not b)",
                            "product stage (multiplier)"},
                      Fault{"sum_without_its_first_term", "spherical", "arithmetic/saturating_sum.vhd",
                            "for i in 1 to g_terms - 1 loop", "for i in 2 to g_terms - 1 loop",
                            "fragment stage (saturating_sum"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace halfway
