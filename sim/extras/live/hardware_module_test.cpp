// SPDX-License-Identifier: Apache-2.0
// Tests of hardware modules in a browser: each shader draws a scene's fragments as the golden model does.
#include "sim/extras/live/hardware_module.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/verilator/harness_api.h"
#include "sim/extras/live/test/base64.hpp"
#include "sim/extras/live_core/stream_parts.hpp"
#include "sim/files/headless_browser.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/test/source_folder.hpp"

namespace halfway {
namespace {

const SimulatorFolders c_folders{c_source_folder, c_source_folder / "build" / "cache"};

// A page with a module and the data of a frame. `draw` returns the status, then the words of the fragments.
constexpr const char* c_page = R"(<!DOCTYPE html><meta charset="utf-8"><title>module</title><script>
const bytesOf = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));
const wordsOf = text => new Uint32Array(bytesOf(text).buffer);
let hardware;
const start = async text => {{
  // Functions of an operating system, which the C library may import, are not called.
  const module = await WebAssembly.compile(bytesOf(text)), imports = {{}};
  for (const {{module: from, name}} of WebAssembly.Module.imports(module)) (imports[from] ??= {{}})[name] = () => {{ throw name; }};
  hardware = (await WebAssembly.instantiate(module, imports)).exports;
  hardware._initialize();
}};
const put = (room, words, count) => {{
  const address = hardware[room](count);
  new Uint32Array(hardware.memory.buffer, address, words.length).set(words);
}};
const text = address => {{
  const bytes = new Uint8Array(hardware.memory.buffer).subarray(address);
  return new TextDecoder().decode(bytes.slice(0, bytes.indexOf(0)));
}};
const registers = () => Array.from({{length: hardware.hardware_register_count()}}, (_, i) =>
  [text(hardware.hardware_register_name(i)), hardware.hardware_register_bits(i)]);
const draw = most => {{
  put('hardware_words', words, words.length);
  put('hardware_parts', parts, parts.length / 2);
  put('hardware_loads', loads, loads.length);
  const status = hardware.hardware_draw(most);
  return [status, ...new Uint32Array(hardware.memory.buffer, hardware.hardware_fragments(),
                                     4 * hardware.hardware_fragment_count())];
}};
const words = wordsOf('{}'), parts = wordsOf('{}'), loads = wordsOf('{}');
const started = start('{}');
</script>)";

struct Drawn {
  int status = 0;
  std::vector<Fragment> fragments;
};

struct Case {
  const char* scene;
  Shader shader;
  Preset preset;
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene << ' ' << to_string(c.shader) << ' ' << to_string(c.preset);
}

class HardwareModule : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    ASSERT_FALSE(HeadlessBrowser::program().empty()) << "no Chromium here: apt-get install chromium";
    const auto scene = must(load_scene(GetParam().scene, c_source_folder / "sim" / "scenes"));
    const auto plan = must(plan_scene(scene, {.shader = GetParam().shader, .preset = GetParam().preset}));
    ASSERT_NO_FATAL_FAILURE(open_page(scene, plan.key));
  }

  void open_page(const Scene& scene, const HardwareKey& key) {
    // The vectors of a frame, and what the golden model draws of them.
    const FrameStream frame = must(whole_stream(scene, {64, 48}, key));
    const std::vector<std::uint32_t>& words = frame.words;
    golden_ = frame.golden;
    ASSERT_GT(golden_.size(), 500U);

    const live::StreamParts stream = live::parts_of(*make_golden_model(key), words);
    const auto module = build_hardware_module(key, c_folders);
    const auto bytes = must(read_file(module));
    const auto page = folder_.path() / "page.html";
    ASSERT_TRUE(write_file(
        page, fmt::format(c_page, base64(words), base64(stream.parts), base64(stream.loads), base64(bytes))));
    browser_ = std::make_unique<HeadlessBrowser>(folder_.path());
    browser_->open(page);
    browser_->evaluate("started");
  }

  void TearDown() override {
    if (browser_) {
      EXPECT_THAT(browser_->complaints, testing::IsEmpty());
    }
  }

  Drawn draw(std::size_t most) {
    const auto answer = browser_->evaluate(fmt::format("draw({})", most)).get<std::vector<std::uint32_t>>();
    Drawn drawn{.status = static_cast<int>(answer.at(0)),
                .fragments = std::vector<Fragment>(answer.size() / 4)};
    std::memcpy(static_cast<void*>(drawn.fragments.data()), answer.data() + 1,
                drawn.fragments.size() * sizeof(Fragment));
    return drawn;
  }

  const TemporaryFolder folder_ = must(TemporaryFolder::make(testing::TempDir()));
  std::vector<Fragment> golden_;
  std::unique_ptr<HeadlessBrowser> browser_;
};

TEST_P(HardwareModule, DrawsWhatTheGoldenModelDraws) {
  EXPECT_TRUE(draw(golden_.size()).fragments == golden_);
  // The second frame starts with reset lanes.
  browser_->evaluate("hardware.hardware_reset()");
  const Drawn drawn = draw(golden_.size());
  EXPECT_EQ(drawn.status, halfway_done);
  EXPECT_TRUE(drawn.fragments == golden_);
  // Too many fragments: none are returned then or later.
  for (const std::size_t most : {golden_.size() - 1, std::size_t{0}}) {
    const Drawn cut = draw(most);
    EXPECT_EQ(cut.status, halfway_buffer_full);
    EXPECT_THAT(cut.fragments, testing::IsEmpty());
    EXPECT_TRUE(draw(golden_.size()).fragments == golden_);
  }
}

// The register of a fragment's line: all fragments are in lines with an odd number.
TEST_P(HardwareModule, ABitThatSticksIsSeenInTheFragments) {
  const auto registers = browser_->evaluate("registers()");
  std::size_t line = 0;
  while (line < registers.size() && !registers[line][0].get<std::string>().ends_with("walker/spans/r.y"))
    ++line;
  ASSERT_LT(line, registers.size()) << registers.dump(0);
  EXPECT_EQ(registers[line][1], 12);
  std::vector<Fragment> odd = golden_;
  for (Fragment& fragment : odd) fragment.y |= 1;
  ASSERT_FALSE(odd == golden_);

  browser_->evaluate(fmt::format("hardware.hardware_stick({}, 0, 1)", line));
  EXPECT_TRUE(draw(golden_.size()).fragments == odd);
  // Also in reset hardware, until it is healed.
  browser_->evaluate("hardware.hardware_reset()");
  EXPECT_TRUE(draw(golden_.size()).fragments == odd);
  browser_->evaluate("hardware.hardware_heal()");
  EXPECT_TRUE(draw(golden_.size()).fragments == golden_);

  // A register of one bit: no span has a pixel.
  std::size_t valid = 0;
  while (!registers[valid][0].get<std::string>().ends_with("walker/spans/r.valid")) ++valid;
  browser_->evaluate(fmt::format("hardware.hardware_stick({}, 0, 0)", valid));
  EXPECT_THAT(draw(golden_.size()).fragments, testing::IsEmpty());
  browser_->evaluate("hardware.hardware_heal(), hardware.hardware_reset()");
  EXPECT_TRUE(draw(golden_.size()).fragments == golden_);
}

INSTANTIATE_TEST_SUITE_P(Quick, HardwareModule,
                         testing::Values(Case{"spheres", Shader::quadratic, Preset::exact},
                                         Case{"spheres", Shader::spherical, Preset::exact},
                                         Case{"spheres", Shader::processors, Preset::exact}));
INSTANTIATE_TEST_SUITE_P(Whole, HardwareModule,
                         testing::Values(Case{"matte", Shader::quadratic, Preset::published},
                                         Case{"lights", Shader::spherical, Preset::published},
                                         Case{"matte", Shader::processors, Preset::published}));

}  // namespace
}  // namespace halfway
