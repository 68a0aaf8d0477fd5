// SPDX-License-Identifier: Apache-2.0
// Tests of the page of make live in headless Chromium, used with mouse, keys and touch.
#include "sim/extras/live/live_page.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "frame/assemble.hpp"
#include "plan/plan.hpp"
#include "sim/cli/command_test.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/extras/live/test/base64.hpp"
#include "sim/extras/live_core/live_frame.hpp"
#include "sim/files/headless_browser.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/run/why.hpp"

namespace halfway::live {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using Json = nlohmann::json;

const std::filesystem::path c_source = HALFWAY_SOURCE_DIR;
constexpr FrameSize c_size{320, 240};
const std::vector<std::string> c_scenes = {"highlights", "lights", "matte", "shadows", "spheres", "teapot"};
// The hardware of `spheres` draws it, because it has colours.
constexpr const char* c_coloured_scene = R"(
[camera]
eye = [0.0, 0.0, 6.0]
target = [0.0, 0.0, 0.0]
[[directional]]
to_light = [0.0, 0.0, 1.0]
[[material]]
name = "copper"
colour = [0.8, 0.4, 0.2]
[[mesh]]
kind = "sphere"
slices = 12
stacks = 8
material = "copper"
)";

class LiveInBrowser : public CommandTest {
 protected:
  /// Make the page for all tests: with one scene, because each kind of hardware is compiled for the browser.
  static void SetUpTestSuite() { make_page({"spheres"}); }
  static void make_page(const std::vector<std::string>& scenes) {
    auto folder = must(TemporaryFolder::make(std::filesystem::temp_directory_path()));
    made_folder.emplace(std::move(folder));
    Command command{.arguments = {HALFWAY_PROGRAM, "live", "--out", page()}};
    command.arguments.insert(command.arguments.end(), scenes.begin(), scenes.end());
    const auto end = run_process(command, "");
    failure = !end ? end.error().message : end->succeeded() ? "" : end->output;
  }
  static void TearDownTestSuite() { made_folder.reset(); }

  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_FALSE(HeadlessBrowser::program().empty()) << "no Chromium here: apt-get install chromium";
    ASSERT_EQ(failure, "");
    browser_ = std::make_unique<HeadlessBrowser>(here());
    browser_->resize(1440, 900);
    browser_->open(page().string() + "#size=320x240");
  }
  void TearDown() override {
    if (!browser_) return;
    EXPECT_THAT(browser_->complaints, IsEmpty());
    // Only the workers' script, which is on the page.
    EXPECT_THAT(browser_->requests, Each(StartsWith("blob:")));
  }

  /// Follow a link to the page and wait for a frame with its error.
  void open(const std::string& link) {
    evaluate(fmt::format("(history.replaceState(null, '', '#{}'), followLink())", link));
    ASSERT_TRUE(is_drawn()) << evaluate("document.body.innerText");
  }
  static std::filesystem::path page() { return made_folder->path() / "live.html"; }
  Json evaluate(const std::string& expression) { return browser_->evaluate(expression); }
  /// The current state is drawn, with its error against the reference.
  bool is_drawn() { return browser_->becomes_true("globalThis.halfwayIsStill && halfwayIsStill()"); }
  std::string text_of(const std::string& selector) {
    return evaluate(fmt::format("document.querySelector('{}').textContent", selector));
  }
  double figure(const std::string& name) { return evaluate("last.figures." + name); }
  bool has_hardware(const HardwareKey& key) {
    return evaluate(fmt::format("at('module-{}') !== null", key.name()));
  }
  /// The golden model's picture in the program.
  static std::vector<std::uint8_t> golden_of(const Scene& scene, const HardwareKey& key) {
    FrameDriver driver(scene, c_size, key, {}, {.golden_picture = true});
    must(driver.draw());
    return driver.golden_frame().frame().rgb;
  }
  /// A picture of the page: red, green and blue of each pixel.
  Frame picture(const std::string& canvas) {
    const Json size = evaluate(fmt::format("[{0}.width, {0}.height]", canvas));
    Frame frame({size[0], size[1]});
    const std::string hex =
        evaluate(fmt::format("(() => {{ const copy = new OffscreenCanvas({0}.width, "
                             "{0}.height).getContext('2d', {{willReadFrequently: true}}); "
                             "copy.drawImage({0}, 0, 0); const p = copy.getImageData(0, 0, {0}.width, "
                             "{0}.height).data; let text = ''; "
                             "for (let i = 0; i < p.length; ++i) if (i % 4 < 3) text += "
                             "p[i].toString(16).padStart(2, '0'); return text; "
                             "}})()",
                             canvas));
    for (std::size_t i = 0; i < frame.rgb.size(); ++i)
      frame.rgb[i] = static_cast<std::uint8_t>(std::stoi(hex.substr(2 * i, 2), nullptr, 16));
    return frame;
  }
  void choose(const std::string& id, const std::string& value) {
    evaluate(
        fmt::format("(() => {{ const e = document.getElementById('{}'); e.value = '{}'; "
                    "e.dispatchEvent(new Event('input')); e.dispatchEvent(new Event('change')); }})()",
                    id, value));
  }
  /// Drop a file with these bytes on the page.
  void drop(const std::string& name, const std::string& bytes) {
    evaluate(
        fmt::format("(() => {{ const data = new DataTransfer(); const text = atob('{}'); "
                    "data.items.add(new File([Uint8Array.from(text, (c) => c.charCodeAt(0))], '{}')); "
                    "dispatchEvent(new DragEvent('drop', {{dataTransfer: data, cancelable: true}})); }})()",
                    base64(bytes), name));
  }

  /// Drop a file with these bytes on the page, which draws it.
  void draw_dropped(const std::string& name, const std::string& bytes) {
    drop(name, bytes);
    ASSERT_TRUE(browser_->becomes_true(fmt::format("state.scene === '{}'", name)));
    ASSERT_TRUE(is_drawn());
    EXPECT_EQ(evaluate("last.state.scene"), name);
    EXPECT_GT(figure("fragments"), 1000);
    EXPECT_EQ(figure("mismatches"), 0);
  }
  /// Compare the pictures of the page with the golden model's.
  void draw_by_every_shader(const std::vector<std::string>& scenes) {
    for (const std::string& scene : scenes) {
      const auto loaded = must(load_scene(scene, c_source / "sim/scenes"));
      for (const Shader shader : c_shaders)
        for (const Preset preset : {Preset::exact, Preset::published}) {
          const std::string of = fmt::format("{} {} {}", scene, to_string(shader), to_string(preset));
          const auto key = planned_key(loaded, {.shader = shader, .preset = preset});
          ASSERT_TRUE(key) << of << ": " << key.error().message;
          EXPECT_EQ(has_hardware(*key), key->processors.objects == 0) << of;
          if (key->processors.objects > 0) continue;
          const std::vector<std::uint8_t> expected = golden_of(loaded, *key);
          ASSERT_NO_FATAL_FAILURE(
              open(fmt::format("scene={}.toml&shader={}&preset={}&size=320x240&kind=golden", scene,
                               to_string(shader), to_string(preset))))
              << of;
          EXPECT_EQ(picture("left").rgb, expected) << of;
          EXPECT_EQ(picture("right").rgb, expected) << of;
          EXPECT_THAT(text_of("#verdict"), HasSubstr("0 differ")) << of;
          EXPECT_GT(figure("fragments"), 1000) << of;
        }
    }
  }
  struct Way {
    Shader shader;
    Preset preset;
    FramePixel pixel;
  };
  /// Compare the ways of pixels on the page with the values of `make why`, which simulates in GHDL.
  void show_way(std::initializer_list<Way> ways);

  std::unique_ptr<HeadlessBrowser> browser_;
  static inline std::optional<TemporaryFolder> made_folder;
  static inline std::string failure;  ///< of making the page
};

/// The page of `make live`, with all scenes.
class WholeLivePage : public LiveInBrowser {
 protected:
  static void SetUpTestSuite() { make_page({}); }
};

TEST_F(LiveInBrowser, DrawsTheGoldenFrameByEveryShader) {
  draw_by_every_shader({"spheres"});
}

TEST_F(WholeLivePage, DrawsTheGoldenFrameOfEverySceneByEveryShader) {
  draw_by_every_shader(c_scenes);
}

TEST_F(LiveInBrowser, ABrokenRegisterIsFound) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  ASSERT_GT(evaluate("document.querySelectorAll('#register option').length"), 10);
  // Break registers until one is found to change the picture.
  const std::string whole = text_of("#verdict");
  int found = 0;
  for (int i = 0; i < 8; ++i) {
    choose("register", std::to_string(3 * i));
    evaluate("document.getElementById('break').click()");
    ASSERT_TRUE(is_drawn());
    if (figure("mismatches") > 0) {
      ++found;
      EXPECT_EQ(evaluate("document.getElementById('verdict').className"), "differs");
      EXPECT_THAT(text_of("#differences"), HasSubstr("golden"));
    }
    evaluate("document.getElementById('mend').click()");
    ASSERT_TRUE(is_drawn());
    EXPECT_EQ(text_of("#verdict"), whole);
  }
  EXPECT_GT(found, 2);
}

TEST_F(LiveInBrowser, ListsRegistersIfTheFirstFrameComesTooLate) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  // The frame that is requested now is older than the shown one.
  evaluate("(at('register').replaceChildren(), forgetFault(), change({}), shown = requested)");
  ASSERT_TRUE(is_drawn());
  EXPECT_GT(evaluate("document.querySelectorAll('#register option').length"), 10);
}

TEST_F(LiveInBrowser, NamesTheStageOfABrokenRegister) {
  struct Case {
    const char *shader, *name;
    int bit;  // sticks at 1
    const char* first;
  };
  for (const Case& c :
       {Case{"quadratic", "walker/spans/r.y", 0,
             "span stage (triangle_walker, or quadratic_shader around it)"},
        Case{"quadratic", "channels(1)/colour/interpolator/value_along_span/parts(1)/interpolator/value", 10,
             "span stage (quadratic_interpolator, or quadratic_shader around it)"},
        Case{"spherical", "lights(0)/light/diffuse/slice/along_line/r(31 downto 0)", 20,
             "span stage (line_interpolator, or diffuse_slice around it)"},
        Case{"processors", "pipeline/chain(1)/form/unrolled/radiance_sum/result(65 downto 44)", 18,
             "diffuse 1 stage (unrolled_shading_processor)"}}) {
    SCOPED_TRACE(c.name);
    ASSERT_NO_FATAL_FAILURE(open(fmt::format("scene=spheres.toml&size=320x240&shader={}", c.shader)));
    EXPECT_EQ(evaluate("document.getElementById('first-stage').hidden"), true);
    // GHDL 5 does not name the only field of a record.
    const int option = evaluate(
        fmt::format("[...document.querySelectorAll('#register option')].findIndex(({{textContent}}) => "
                    "textContent.replace('/r.value(', '/r(').startsWith('{},'))",
                    c.name));
    ASSERT_GE(option, 0);
    choose("register", std::to_string(option));
    choose("bit", std::to_string(c.bit));
    evaluate("document.getElementById('break').click()");
    ASSERT_TRUE(is_drawn());
    EXPECT_GT(figure("mismatches"), 0);
    EXPECT_THAT(text_of("#first-stage"), HasSubstr(std::string("stages: ") + c.first + ", cycle "));
    evaluate("document.getElementById('mend').click()");
    ASSERT_TRUE(is_drawn());
    EXPECT_EQ(evaluate("document.getElementById('first-stage').hidden"), true);
  }
}

TEST_F(LiveInBrowser, EndsHardwareThatDrawsTooManyFragments) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  const int option = evaluate(
      "[...document.querySelectorAll('#register option')].findIndex(({textContent}) => "
      "textContent.startsWith('walker/spans/r.valid,'))");
  ASSERT_GE(option, 0);
  choose("register", std::to_string(option));
  evaluate("document.getElementById('break').click()");
  ASSERT_TRUE(is_drawn());
  EXPECT_THAT(text_of("#differences"),
              StartsWith("the hardware draws more fragments than its triangles have"));
  evaluate("document.getElementById('mend').click()");
  ASSERT_TRUE(is_drawn());
  EXPECT_EQ(figure("mismatches"), 0);
}

TEST_F(LiveInBrowser, TurnsByMouseKeysAndTouchAndKeepsTheStateInTheLink) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  const std::vector<std::uint8_t> before = picture("left").rgb;
  const auto [x, y] = browser_->middle_of("#picture");
  browser_->drag({x, y}, {x + 60, y + 20});
  ASSERT_TRUE(is_drawn());
  const std::vector<std::uint8_t> dragged = picture("left").rgb;
  EXPECT_NE(dragged, before);
  EXPECT_EQ(evaluate("state.azimuth"), -30);
  EXPECT_EQ(evaluate("state.elevation"), 10);
  evaluate("document.getElementById('picture').focus()");
  browser_->press("ArrowLeft");
  browser_->press("+");
  ASSERT_TRUE(is_drawn());
  EXPECT_EQ(evaluate("state.azimuth"), -35);
  EXPECT_EQ(evaluate("state.distance"), 0.9);
  browser_->touch("touchStart", {{x - 20, y}, {x + 20, y}});
  browser_->touch("touchMove", {{x - 40, y}, {x + 40, y}});
  browser_->touch("touchEnd", {});
  ASSERT_TRUE(is_drawn());
  EXPECT_LT(evaluate("state.distance").get<double>(), 0.6);
  const std::vector<std::uint8_t> turned = picture("left").rgb;
  const std::string link = evaluate("location.hash");
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  ASSERT_NO_FATAL_FAILURE(open(link.substr(1)));
  EXPECT_EQ(picture("left").rgb, turned);
}

TEST_F(LiveInBrowser, SlidersChangeTheFrame) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  std::vector<std::uint8_t> before = picture("left").rgb;
  for (const auto& [id, value] : std::vector<std::pair<std::string, std::string>>{
           {"exponent", "2"}, {"lightAzimuth", "60"}, {"lightElevation", "20"}, {"tessellation", "-1"}}) {
    choose(id, value);
    ASSERT_TRUE(is_drawn()) << id;
    const std::vector<std::uint8_t> after = picture("left").rgb;
    EXPECT_NE(after, before) << id;
    EXPECT_EQ(figure("mismatches"), 0) << id;
    before = after;
  }
}

TEST_F(LiveInBrowser, TheLineSeparatesTwoPictures) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240&kind=reference"));
  const Frame hardware = picture("left"), reference = picture("right");
  EXPECT_NE(hardware.rgb, reference.rgb);
  const auto clip = [&] { return evaluate("getComputedStyle(document.getElementById('right')).clipPath"); };
  const Json half = clip();
  choose("wipe", "900");
  EXPECT_NE(clip(), half);
  // The difference is 32 times that of the two pictures.
  choose("kind", "difference");
  ASSERT_TRUE(is_drawn());
  const Frame difference = picture("right");
  for (std::size_t i = 0; i < difference.rgb.size(); ++i)
    ASSERT_EQ(difference.rgb[i], std::min(255, 32 * std::abs(hardware.rgb[i] - reference.rgb[i]))) << i;
  choose("kind", "triangles");
  ASSERT_TRUE(is_drawn());
  EXPECT_NE(picture("right").rgb, difference.rgb);
}

TEST_F(LiveInBrowser, DrawsDroppedFilesAndRefusesBadOnes) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  choose("tessellation", "-1");
  ASSERT_TRUE(is_drawn());
  ASSERT_NO_FATAL_FAILURE(draw_dropped("copper.toml", c_coloured_scene));
  const std::string glb = must(read_file(c_source / "tb/inputs/random/seeds/glb/triangle.glb"));
  ASSERT_NO_FATAL_FAILURE(draw_dropped("triangle.glb", glb));
  EXPECT_EQ(figure("triangles"), 2);
  for (const auto& [name, bytes, place] :
       {std::tuple("bad.obj", std::string("v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n"), "bad.obj:2: "),
        std::tuple("bad.glb", glb.substr(0, glb.size() - 1), "bad.glb: byte 8: ")}) {
    drop(name, bytes);
    ASSERT_TRUE(browser_->becomes_true("!document.getElementById('refusal').hidden"));
    EXPECT_THAT(text_of("#refusal"), HasSubstr(place));
    choose("scene", "copper.toml");
    ASSERT_TRUE(is_drawn());
  }
  // The page goes on.
  choose("scene", "spheres.toml");
  ASSERT_TRUE(is_drawn());
  EXPECT_EQ(evaluate("document.getElementById('refusal').hidden"), true);
  EXPECT_EQ(figure("mismatches"), 0);
}

TEST_F(LiveInBrowser, ShowsThePixelThatIsClicked) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240&kind=golden"));
  const auto [x, y] = browser_->middle_of("#picture");
  // On the upper sphere: 120 - 0.24 * 240 is in line 62.
  const double height = evaluate("document.getElementById('left').getBoundingClientRect().height");
  browser_->click(x, y - 0.24 * height);
  ASSERT_TRUE(browser_->becomes_true("document.querySelectorAll('#pixel-values tr').length > 2"));
  const Frame shown = picture("left");
  const std::size_t at = shown.offset(160, 62);
  EXPECT_THAT(text_of("#pixel-title"), HasSubstr("160, 62"));
  EXPECT_THAT(text_of("#pixel-values"),
              HasSubstr(fmt::format("{}{}{}", shown.rgb[at], shown.rgb[at + 1], shown.rgb[at + 2])));
}

void LiveInBrowser::show_way(std::initializer_list<Way> ways) {
  for (const Way& c : ways) {
    SCOPED_TRACE(fmt::format("{} {}", to_string(c.shader), to_string(c.preset)));
    const auto scene = must(load_scene("spheres", c_source / "sim/scenes"));
    WhySettings settings;
    settings.plan.shader = c.shader;
    settings.plan.preset = c.preset;
    settings.size = c_size;
    settings.pixel = c.pixel;
    settings.folders = {c_source, c_source / "build" / "cache"};
    const auto why = explain_pixel(scene, settings);
    ASSERT_FALSE(why.stories.empty());

    ASSERT_NO_FATAL_FAILURE(
        open(fmt::format("scene=spheres.toml&size=320x240&shader={}&preset={}&pixel={},{}",
                         to_string(c.shader), to_string(c.preset), c.pixel.x, c.pixel.y)));
    EXPECT_EQ(evaluate("last.way.map((line) => line.join('\\t') + '\\n').join('')"),
              lines_of({why.stories, why.first, why.fault}));
    // Each value of each stage is marked as equal.
    std::size_t values = 0;
    for (const PixelStory& story : why.stories)
      for (const StageState& stage : story.stages) values += stage.values.size();
    EXPECT_GT(values, 10U);
    EXPECT_EQ(evaluate("[...document.querySelectorAll('#way-values td.agrees')].filter(({textContent}) => "
                       "textContent === '=').length"),
              values);
    EXPECT_EQ(evaluate("document.querySelectorAll('#way-values td.differs').length"), 0);
  }
}

TEST_F(LiveInBrowser, ShowsTheWayOfAPixelThroughTheStages) {
  show_way({{Shader::quadratic, Preset::exact, {160, 60}},
            {Shader::spherical, Preset::published, {100, 60}},
            {Shader::processors, Preset::published, {100, 60}}});
  // No triangle covers this pixel.
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240&pixel=0,0"));
  EXPECT_THAT(text_of("#way-note"), HasSubstr("No triangle"));
}

TEST_F(WholeLivePage, ShowsTheWayOfAPixelThroughTheOtherStages) {
  show_way({{Shader::quadratic, Preset::published, {100, 60}},
            {Shader::spherical, Preset::exact, {100, 60}},
            {Shader::processors, Preset::exact, {100, 60}}});
}

// The published preset has a second size of tables.
TEST_F(LiveInBrowser, DrawsWithTablesOfAnotherSize) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240&shader=spherical&preset=published"));
  const std::vector<std::uint8_t> before = picture("left").rgb;
  const double error = figure("rms");
  ASSERT_EQ(evaluate("document.querySelectorAll('#tables option').length"), 2);
  choose("tables", "4x4");
  ASSERT_TRUE(is_drawn());
  EXPECT_THAT(evaluate("last.key").get<std::string>(), HasSubstr("-rom4x4"));
  EXPECT_NE(picture("left").rgb, before);
  EXPECT_EQ(figure("mismatches"), 0);
  EXPECT_GT(figure("rms"), error);
  // The other preset has one size.
  choose("preset", "exact");
  ASSERT_TRUE(is_drawn());
  EXPECT_EQ(evaluate("document.getElementById('tables').disabled"), true);
  EXPECT_EQ(figure("mismatches"), 0);
}

TEST_F(LiveInBrowser, FitsPhonesAndDarkMode) {
  ASSERT_NO_FATAL_FAILURE(open("scene=spheres.toml&size=320x240"));
  for (const int width : {390, 1440}) {
    browser_->resize(width, 844);
    EXPECT_LE(evaluate("document.documentElement.scrollWidth").get<int>(), width);
  }
  std::vector<std::string> papers;
  for (const char* scheme : {"light", "dark"}) {
    browser_->prefer(scheme);
    papers.push_back(evaluate("getComputedStyle(document.body).backgroundColor"));
  }
  EXPECT_NE(papers[0], papers[1]);
}

TEST_F(WholeLivePage, DrawsADroppedGreyMesh) {
  ASSERT_NO_FATAL_FAILURE(open("scene=matte.toml&size=320x240"));
  choose("tessellation", "-1");
  ASSERT_TRUE(is_drawn());
  ASSERT_NO_FATAL_FAILURE(draw_dropped("roof.obj", "v 0 0 0\nv 2 0 0\nv 2 1 1\nv 0 1 1\nf 1 2 3 4\n"));
  EXPECT_EQ(figure("triangles"), 2);
}

TEST_F(WholeLivePage, TheFileIsSmall) {
  EXPECT_LE(std::filesystem::file_size(page()), 4'000'000U);
}

}  // namespace
}  // namespace halfway::live
