// SPDX-License-Identifier: Apache-2.0
// Tests of the core in a browser: it makes the init vectors of the program.
#include "sim/extras/live/core_module.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mesh_files/test/spelling.hpp"
#include "sim/driver/test/golden_engine.hpp"
#include "sim/extras/live/test/base64.hpp"
#include "sim/extras/live_core/live_frame.hpp"
#include "sim/files/headless_browser.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway::live {
namespace {

constexpr int c_core_width = 96, c_core_height = 72;

// A page with the core, and hardware without fragments. `drawn` are the words that the core gives to the
// hardware; `end` is what the hardware returns.
constexpr const char* c_script = R"(
const bytes_of = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
const base64 = bytes => {
  let text = '';
  for (let i = 0; i < bytes.length; i += 32768) text += String.fromCharCode(...bytes.subarray(i, i + 32768));
  return btoa(text);
};
let core, drawn = [], end = 0;
const bytes_at = (address, count) => new Uint8Array(core.memory.buffer, address, count);
const live = {
  hardware_draw: (words, count) => { drawn.push(bytes_at(words, 4 * count).slice()); return end; },
  hardware_count: () => 0,
  hardware_take: () => {},
  hardware_reset: () => {},
  hardware_observe: () => 0,
  hardware_trace_words: () => 0,
  hardware_take_trace: () => {},
  now: () => performance.now()
};
// The functions of a system are linked, but not called.
const missing = new Proxy({}, { get: (_, name) => () => { throw new Error(name); } });
const start = async text => {
  const made = await WebAssembly.instantiate(bytes_of(text), { live, wasi_snapshot_preview1: missing });
  core = made.instance.exports;
  core._initialize();
};
const text = () => new TextDecoder().decode(bytes_at(core.live_text(), core.live_text_size()));
const scene = (name, content) => {
  const parts = [name, content].map(part => new TextEncoder().encode(part));
  const room = core.live_input(parts[0].length + parts[1].length);
  bytes_at(room, parts[0].length).set(parts[0]);
  bytes_at(room + parts[0].length, parts[1].length).set(parts[1]);
  return core.live_scene(parts[0].length, parts[1].length, 1);
};
const draw = (width, height) => {
  new Float64Array(core.memory.buffer, core.live_settings(), 9).set([width, height]);
  drawn = [];
  return core.live_draw();
};
const words = async () => base64(new Uint8Array(await new Blob(drawn).arrayBuffer()));
const pixels = (kind, count) => base64(bytes_at(core.live_pixels(kind), 4 * count));
)";

std::vector<std::uint8_t> with_alpha(const Frame& frame) {
  std::vector<std::uint8_t> rgba;
  for (std::size_t i = 0; i < frame.rgb.size(); i += 3)
    rgba.insert(rgba.end(), {frame.rgb[i], frame.rgb[i + 1], frame.rgb[i + 2], 255});
  return rgba;
}

class CoreModule : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_FALSE(HeadlessBrowser::program().empty()) << "no Chromium here: apt-get install chromium";
    const auto module = build_core_module({c_source_folder, c_source_folder / "build" / "cache"});
    const auto bytes = must(read_file(module));
    const auto page = folder_.path() / "page.html";
    ASSERT_TRUE(write_file(page, "<!DOCTYPE html><meta charset=\"utf-8\"><title>core</title><script>" +
                                     std::string(c_script) + "const started = start('" + base64(bytes) +
                                     "');</script>"));
    browser_ = std::make_unique<HeadlessBrowser>(folder_.path());
    browser_->open(page);
    browser_->evaluate("started");
  }
  void TearDown() override {
    if (!browser_) return;
    EXPECT_THAT(browser_->complaints, testing::IsEmpty());
  }

  /// Load a scene natively and in the browser.
  void load(const std::string& name, const std::string& content) {
    const Status loaded = live_.load(name, content);
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(evaluate("scene(" + quoted(name) + ", " + quoted(content) + ")"), 0) << text();
  }
  void load_built_in(const std::string& name) {
    load(name + ".toml", *read_file(c_source_folder / "sim/scenes" / (name + ".toml")));
  }
  HardwareKey plan(Shader shader, Preset preset) {
    const auto key = must(live_.plan({.shader = shader, .preset = preset}));
    EXPECT_EQ(evaluate("core.live_plan(" + std::to_string(static_cast<int>(shader)) + ", " +
                       std::to_string(static_cast<int>(preset)) + ", 0)"),
              0)
        << text();
    EXPECT_EQ(text(), key.name());
    return key;
  }
  HeadlessBrowser::Json evaluate(const std::string& expression) { return browser_->evaluate(expression); }
  int draw() {
    return evaluate("draw(" + std::to_string(c_core_width) + ", " + std::to_string(c_core_height) + ")")
        .get<int>();
  }
  std::string text() { return evaluate("text()").get<std::string>(); }
  static std::string quoted(const std::string& content) { return HeadlessBrowser::Json(content).dump(); }
  static Settings settings() {
    Settings small;
    small.width = c_core_width;
    small.height = c_core_height;
    return small;
  }

  LiveFrame live_{[] { return 0.0; }};
  const TemporaryFolder folder_ = must(TemporaryFolder::make(testing::TempDir()));
  std::unique_ptr<HeadlessBrowser> browser_;
};

// The libraries' functions, such as sine and power, and the compilers differ. The vectors do not.
TEST_F(CoreModule, MakesTheVectorsOfTheProgram) {
  for (const char* scene : {"spheres", "highlights", "teapot", "lights", "matte", "shadows"}) {
    ASSERT_NO_FATAL_FAILURE(load_built_in(scene));
    for (const Shader shader : c_shaders)
      for (const Preset preset : {Preset::exact, Preset::published}) {
        const HardwareKey key = plan(shader, preset);
        SCOPED_TRACE(std::string(scene) + " " + key.name());
        GoldenEngine engine(key);
        ASSERT_TRUE(live_.draw(settings(), engine));
        // Hardware without fragments differs.
        ASSERT_EQ(draw(), 1) << text();
        EXPECT_TRUE(evaluate("words()") == base64(engine.words)) << "the vectors differ";
        EXPECT_TRUE(evaluate("pixels(1, " + std::to_string(c_core_width * c_core_height) + ")") ==
                    base64(with_alpha(*live_.picture(Picture::golden))))
            << "the golden pictures differ";
      }
  }
}

TEST_F(CoreModule, ReadsGltfAsTheProgramDoes) {
  const std::string triangle = must(read_file(c_source_folder / "tb/inputs/random/seeds/gltf/triangle.gltf"));
  ASSERT_NO_FATAL_FAILURE(load("triangle.gltf", triangle));
  GoldenEngine engine(plan(Shader::quadratic, Preset::exact));
  ASSERT_TRUE(live_.draw(settings(), engine));
  ASSERT_EQ(draw(), 1) << text();
  EXPECT_TRUE(evaluate("words()") == base64(engine.words)) << "the vectors differ";
  for (const std::string& damaged :
       {std::string("glTF"), std::string("{\n1e999}"), triangle.substr(1), changed(triangle, "VEC3", "VEC2"),
        changed(triangle, "\"count\": 3", "\"count\": 4000000000")}) {
    const Status refused = live_.load("bad.gltf", damaged);
    ASSERT_FALSE(refused);
    EXPECT_EQ(evaluate("scene('bad.gltf', " + quoted(damaged) + ")"), 2);
    EXPECT_EQ(text(), refused.error().message);
  }
}

TEST_F(CoreModule, ReportsTheEndOfTheHardware) {
  ASSERT_NO_FATAL_FAILURE(load_built_in("spheres"));
  plan(Shader::quadratic, Preset::exact);
  for (const auto& [end, text_of_end] : {std::pair(1, "the hardware draws more fragments"),
                                         {2, "the hardware hangs"},
                                         {4, "the hardware reports"}}) {
    evaluate("end = " + std::to_string(end) + ", 0");
    EXPECT_EQ(draw(), 1);
    EXPECT_THAT(text(), testing::StartsWith(text_of_end));
  }
}

}  // namespace
}  // namespace halfway::live
