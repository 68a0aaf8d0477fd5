// SPDX-License-Identifier: Apache-2.0
// Tests of the page's core as native code: its frames are those of the program.
#include "sim/extras/live_core/live_frame.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <tuple>

#include "common/test/is_error.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/driver/shader_stages.hpp"
#include "sim/driver/test/golden_engine.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/file.hpp"

namespace halfway::live {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

constexpr double c_width = 96, c_height = 72;

double no_clock() {
  return 0.0;
}

Settings small() {
  Settings settings;
  settings.width = c_width;
  settings.height = c_height;
  return settings;
}

// What `halfway sim` draws: the golden model's frame of the scene's stream.
struct Drawn {
  std::vector<std::uint32_t> words;
  Frame frame;
};
Drawn drawn_by_program(const std::string& name, const HardwareKey& key) {
  const Scene scene = built_in_scene(name);
  const FrameSize size = small().size();
  FrameStream stream = must(whole_stream(scene, size, key));
  FrameAssembler assembler(size, scene.background);
  EXPECT_TRUE(assembler.add(stream.golden));
  return {std::move(stream.words), assembler.frame()};
}

LiveFrame loaded_frame(const std::string& scene) {
  LiveFrame live(no_clock);
  const std::string file = scene + ".toml";
  must(live.load(file, must(read_file(c_built_in_scenes / file))));
  return live;
}

TEST(LiveFrame, DrawsTheFramesOfTheProgram) {
  for (const char* scene : c_built_in_names) {
    LiveFrame live = loaded_frame(scene);
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const auto key = must(live.plan({.shader = shader, .preset = preset}));
        SCOPED_TRACE(std::string(scene) + " " + key.name());
        const Drawn expected = drawn_by_program(scene, key);
        GoldenEngine engine(key);
        must(live.draw(small(), engine));
        EXPECT_EQ(engine.words, expected.words);
        EXPECT_EQ(live.picture(Picture::hardware)->rgb, expected.frame.rgb);
        EXPECT_EQ(live.picture(Picture::golden)->rgb, expected.frame.rgb);
        const Figures& figures = live.figures();
        EXPECT_EQ(figures.fragments, engine.fragments.size());
        EXPECT_EQ(figures.words, engine.words.size());
        EXPECT_EQ(figures.mismatches, 0U);
      }
  }
}

// Hardware without events: the way has the golden model's values alone.
TEST(LiveFrame, TheWayOfAPixelIsThatOfItsTriangles) {
  LiveFrame live = loaded_frame("teapot");
  const auto key = must(live.plan({}));
  GoldenEngine engine(key);
  engine.change = [](std::vector<Fragment>& fragments) { fragments.back().green ^= 1; };
  ASSERT_EQ(live.draw(small(), engine).error().code, ExitCode::differs);
  const Fragment seen = engine.fragments.front(), wrong = engine.fragments.back();
  std::vector<Fragment> observed;
  const Observe observe = [&](std::span<const std::uint32_t> words, const ShaderStages& stages,
                              std::uint64_t most) -> Result<Observation> {
    const auto golden = make_golden_model(key);
    const auto drawn = golden->draw(words);
    observed.assign(drawn.begin(), drawn.end());
    EXPECT_GE(most, observed.size());
    return Observation{word_trace(stages.parts(), {}), "no events"};
  };
  const auto way = must(live.way({seen.x, seen.y}, observe));
  // The triangles of the pixel and that of the first fragment that differs are drawn, and not all others.
  const auto has = [&](const Fragment& of) {
    return std::count_if(observed.begin(), observed.end(),
                         [&](const Fragment& f) { return f.triangle == of.triangle; }) > 0;
  };
  EXPECT_TRUE(has(seen));
  EXPECT_TRUE(has(wrong));
  EXPECT_LT(observed.size(), engine.fragments.size() / 2);
  // The story ends with the pixel's fragment.
  ASSERT_FALSE(way.stories.empty());
  EXPECT_EQ(way.stories.front().triangle, seen.triangle);
  const StageState& fragment = way.stories.front().stages.back();
  EXPECT_EQ(fragment.cycle, std::nullopt);
  ASSERT_EQ(fragment.values.size(), 7U);
  EXPECT_EQ(fragment.values[1].golden, seen.y);
  EXPECT_EQ(fragment.values[2].golden, seen.x);
  EXPECT_EQ(fragment.values[4].golden, seen.red);
  EXPECT_EQ(way.fault, "no events");
  ASSERT_TRUE(way.first);
  EXPECT_THAT(way.first->text(), HasSubstr("never came"));
  EXPECT_THAT(lines_of(way), StartsWith(fmt::format("triangle\t{}\t", seen.triangle)));
  EXPECT_THAT(lines_of(way), HasSubstr("fault\tno events\n"));
}

TEST(LiveFrame, ReportsAFaultWithTheFirstFragmentThatDiffers) {
  LiveFrame live = loaded_frame("matte");
  const auto key = live.plan({});
  GoldenEngine engine(*key);
  engine.change = [](std::vector<Fragment>& fragments) { fragments.at(150).blue ^= 4; };
  const Status wrong = live.draw(small(), engine);
  const Fragment& first = engine.fragments.at(150);
  EXPECT_TRUE(is_error(wrong, ExitCode::differs,
                       fmt::format("  triangle {}, line {}, pixel {}, blue: golden {}, RTL {}\n",
                                   first.triangle, first.y, first.x, first.blue, first.blue ^ 4)));
  EXPECT_EQ(live.figures().mismatches, 1U);
  EXPECT_NE(live.picture(Picture::hardware)->rgb, live.picture(Picture::golden)->rgb);

  engine.change = [](std::vector<Fragment>& fragments) { fragments.resize(100); };
  engine.end = Error{ExitCode::differs, "the hardware hangs"};
  const Status hung = live.draw(small(), engine);
  EXPECT_TRUE(is_error(hung, "the hardware hangs\n"));
  EXPECT_TRUE(is_error(hung, "golden has it, RTL ended before"));

  engine.change = [](std::vector<Fragment>& fragments) { fragments.at(7).x = 5000; };
  engine.end.reset();
  EXPECT_TRUE(is_error(live.draw(small(), engine), "a fragment lies outside the frame\n"));

  // A fault does not change the next frame.
  engine.change = [](std::vector<Fragment>&) {};
  EXPECT_TRUE(live.draw(small(), engine));
}

TEST(LiveFrame, RefusesBadTextAndDrawsTheNextScene) {
  LiveFrame live = loaded_frame("matte");
  const auto refusal = [&](const std::string& file, const std::string& text, double tessellation = 1.0) {
    const Status status = live.load(file, text, tessellation);
    if (status) return std::string("loaded");
    EXPECT_EQ(status.error().code, ExitCode::bad_input);
    EXPECT_FALSE(live.plan({})) << "a scene is left";
    return status.error().message;
  };
  EXPECT_THAT(refusal("bad.obj", "v 0 0 0\nv 1 0\n"), StartsWith("bad.obj:2: "));
  EXPECT_THAT(refusal("bad.toml", "\nambient = true\n"), StartsWith("bad.toml:2: "));
  EXPECT_THAT(refusal("bad.toml", "\na = \n"), StartsWith("bad.toml:2: bad TOML: "));
  EXPECT_EQ(refusal("file.toml", "[[mesh]]\nfile = \"x.obj\"\n"),
            "file.toml:2: file of mesh names another file, which cannot be read here; open the mesh itself");
  EXPECT_THAT(refusal("scene.dae", "{}"), StartsWith("scene.dae: not a scene by its name"));
  EXPECT_THAT(refusal("bad.glb", "glTF"), StartsWith("bad.glb: byte 0: "));
  EXPECT_EQ(refusal("file.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,"uri":"x.bin"}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]})"),
            "file.gltf: buffers[0].uri: 'x.bin' is another file, which cannot be read here; export a .glb, "
            "which has its buffers");
  EXPECT_EQ(refusal("empty.obj", ""), "empty.obj: the file is empty");
  EXPECT_THAT(refusal("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 2.0), HasSubstr("tessellation"));

  // One triangle more than a scene may have.
  std::string huge = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (std::uint32_t i = 0; i <= c_max_triangles; ++i) huge += "f 1 2 3\n";
  EXPECT_THAT(refusal("huge.obj", huge), StartsWith("huge.obj:"));

  ASSERT_TRUE(live.load("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
  const auto key = must(live.plan({}));
  GoldenEngine engine(key);
  ASSERT_TRUE(live.draw(small(), engine));
  EXPECT_GT(live.figures().fragments, 100U);
}

TEST(LiveFrame, RefusesSettingsOutOfRange) {
  LiveFrame live = loaded_frame("matte");
  GoldenEngine engine(*live.plan({}));
  for (double Settings::* value :
       {&Settings::width, &Settings::height, &Settings::azimuth, &Settings::elevation,
        &Settings::distance_factor, &Settings::exponent_factor, &Settings::light_azimuth,
        &Settings::light_elevation, &Settings::threshold}) {
    Settings settings = small();
    settings.*value = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(is_error(live.draw(settings, engine), ExitCode::bad_input));
  }
  Settings settings = small();
  settings.width = 4097;
  EXPECT_FALSE(live.draw(settings, engine));
  settings.width = 0.5;
  EXPECT_FALSE(live.draw(settings, engine));
  EXPECT_TRUE(live.draw(small(), engine));
}

// Settings change the frame, not the hardware, and their neutral values bring the scene's own frame back.
TEST(LiveFrame, SettingsNeedNoOtherHardware) {
  for (const Shader shader : c_shaders) {
    LiveFrame live = loaded_frame("spheres");
    GoldenEngine engine(*live.plan({.shader = shader}));
    ASSERT_TRUE(live.draw(small(), engine));
    const auto own = live.picture(Picture::hardware)->rgb;
    for (double Settings::* value :
         {&Settings::azimuth, &Settings::elevation, &Settings::distance_factor, &Settings::exponent_factor,
          &Settings::light_azimuth, &Settings::light_elevation}) {
      Settings settings = small();
      settings.*value += 3.0;
      must(live.draw(settings, engine));
      EXPECT_NE(live.picture(Picture::hardware)->rgb, own);
      EXPECT_EQ(live.picture(Picture::hardware)->rgb, live.picture(Picture::golden)->rgb);
      // The picture is that of the changed scene.
      ASSERT_TRUE(live.draw_reference());
      EXPECT_LT(live.figures().error->rms, 3.0);
    }
    ASSERT_TRUE(live.draw(small(), engine));
    EXPECT_EQ(live.picture(Picture::hardware)->rgb, own);
  }
}

TEST(LiveFrame, ReferenceAndDifference) {
  LiveFrame live = loaded_frame("spheres");
  GoldenEngine engine(*live.plan({}));
  EXPECT_FALSE(live.draw_reference());
  ASSERT_TRUE(live.draw(small(), engine));
  EXPECT_FALSE(live.picture(Picture::reference));
  ASSERT_TRUE(live.draw_reference());
  const FrameDistance& error = *live.figures().error;
  EXPECT_GT(error.rms, 0.0);
  EXPECT_LE(error.max_lsb, 2U);  // the threshold
  const Frame difference = *live.picture(Picture::difference);
  EXPECT_EQ(*std::ranges::max_element(difference.rgb), error.max_lsb * c_difference_scale);
  EXPECT_NE(live.picture(Picture::reference)->rgb, live.picture(Picture::hardware)->rgb);
  // The reference of another frame is not kept.
  ASSERT_TRUE(live.draw(small(), engine));
  EXPECT_FALSE(live.picture(Picture::reference));
  EXPECT_FALSE(live.figures().error);
}

TEST(LiveFrame, AHigherThresholdSplitsLessAndTrianglesHaveColoursOfTheirOwn) {
  LiveFrame live = loaded_frame("spheres");
  for (const Shader shader : {Shader::quadratic, Shader::spherical}) {
    GoldenEngine engine(*live.plan({.shader = shader}));
    // The numbers of leaves and of colours.
    const auto split = [&](double threshold) {
      Settings settings = small();
      settings.threshold = threshold;
      EXPECT_TRUE(live.draw(settings, engine));
      const Frame picture = *live.picture(Picture::split);
      std::set<std::tuple<int, int, int>> colours;
      for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
        colours.insert({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
      return std::pair(live.figures().setup.leaves, colours.size());
    };
    const auto whole = split(200.0), parts = split(0.5);
    EXPECT_GT(parts.first, whole.first);
    EXPECT_GT(whole.second, 100U);
    EXPECT_GT(parts.second, shader == Shader::quadratic ? 2 * whole.second : whole.second);
  }
}

}  // namespace
}  // namespace halfway::live
