// SPDX-License-Identifier: Apache-2.0
// Packets that are none, at the ports of words_to_fragments in Verilator: random words, random vectors,
// faults in good packets, and frames without their last packets. Each frame must end within a bounded number
// of clocks. The next good frame must have the golden model's fragments, without a reset in between.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "golden_run/packets.hpp"
#include "inputs/ports/axi_harness.hpp"
#include "inputs/ports/bad_packets.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/verilator/netlist.hpp"
#include "sim/engines/verilator/shader_netlist.hpp"
#include "sim/engines/verilator/verilated_library.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

static_assert(sizeof(AxiFragment) == sizeof(Fragment));

const SimulatorFolders c_folders{HALFWAY_SOURCE_DIR, HALFWAY_CACHE_DIR};

struct Case {
  const char* name;
  const char* scene;
  PlanRequest plan;
  /// At least twice the clocks of a triangle of the scene, or of a strip.
  int limit_bits;
  int frames;  ///< bad ones
  FrameSize size{16, 12};
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.name;
}

SharedLibrary build(const HardwareKey& key, int limit_bits) {
  const std::string top = c_stream_top;
  auto generics = key.stream_generics();
  generics.emplace_back("g_limit_bits", std::to_string(limit_bits));
  const std::filesystem::path folder = c_folders.source / "tb/inputs/ports";
  return must(
      open_verilated({.name = key.name() + "-axi",
                      .netlist = must(mend_netlist(must(rtl_library(c_folders).synthesize(top, generics)))),
                      .top = top,
                      .harness = folder / "axi_harness.cpp",
                      .include_folder = c_folders.source,
                      .harness_headers = {folder / "axi_harness.hpp"},
                      .fast = false},
                     c_folders.cache));
}

class BadInput : public testing::TestWithParam<Case> {
 protected:
  ~BadInput() override {
    if (model_ != nullptr) destroy_(model_);
  }
  void SetUp() override {
    const Scene scene = must(load_scene(fmt::format(fmt::runtime(GetParam().scene), HALFWAY_SOURCE_DIR),
                                        c_folders.source / "sim/scenes"));
    const HardwareKey key = must(plan_scene(scene, GetParam().plan)).key;
    FrameStream stream = must(whole_stream(scene, GetParam().size, key));
    PacketWriter(key).append(good_, stream.words);
    golden_ = std::move(stream.golden);
    ASSERT_GT(golden_.size(), 40U);
    library_.emplace(build(key, GetParam().limit_bits));
    must(library_->bind(draw_, "halfway_axi_draw", create_, "halfway_axi_create", destroy_,
                        "halfway_axi_destroy"));
    model_ = create_();
  }

  std::uint32_t random() { return static_cast<std::uint32_t>(engine_()); }

  /// Draws the frame. Every wait must end within the limit and the clocks of a reset and of an idle shader.
  AxiFrame draw(std::vector<std::uint32_t> words, bool pauses) {
    constexpr std::uint64_t c_more_clocks = 20;
    PacketWriter::append_end(words);
    fragments_.resize(2 * golden_.size());
    AxiFrame frame{.words = words.data(),
                   .count_words = words.size(),
                   .stall_seed = pauses ? random() | 1U : 0U,
                   .most_wait = (std::uint64_t{1} << GetParam().limit_bits) + c_more_clocks,
                   .fragments = fragments_.data(),
                   .capacity = fragments_.size()};
    const char* wrong = draw_(model_, &frame);
    if (wrong != nullptr) ADD_FAILURE() << wrong << " after " << frame.count << " fragments";
    return frame;
  }

  void draw_good_frame(bool pauses) {
    const AxiFrame frame = draw(good_, pauses);
    EXPECT_EQ(frame.cause, 0);
    EXPECT_EQ(frame.ends, 1U);
    ASSERT_EQ(frame.count, golden_.size());
    for (std::size_t i = 0; i < golden_.size(); ++i)
      ASSERT_EQ(std::memcmp(&fragments_[i], &golden_[i], sizeof(Fragment)), 0) << "fragment " << i;
  }

  std::vector<std::uint32_t> good_;
  std::vector<Fragment> golden_;
  std::vector<AxiFragment> fragments_;
  std::mt19937_64 engine_{1};
  std::optional<SharedLibrary> library_;
  decltype(&halfway_axi_draw) draw_ = nullptr;
  decltype(&halfway_axi_create) create_ = nullptr;
  decltype(&halfway_axi_destroy) destroy_ = nullptr;
  void* model_ = nullptr;
};

TEST_P(BadInput, EndsAndTheNextFrameIsGolden) {
  draw_good_frame(false);
  int faults = 0;
  for (int i = 0; i < GetParam().frames; ++i) {
    const bool pauses = i % 4 == 3;
    faults += draw(bad_packets(good_, engine_), pauses).cause != 0 ? 1 : 0;
    draw_good_frame(pauses);
    if (HasFailure()) FAIL() << "bad frame " << i;
  }
  // Some bad frames are faulty, others only draw wrong fragments. Object processors may refuse each of them.
  EXPECT_GT(faults, GetParam().frames / 20);
  if (GetParam().name != std::string_view("shadows") && GetParam().plan.objects == 0) {
    EXPECT_LT(faults, GetParam().frames);
  }
  RecordProperty("faulty", faults);
  fmt::print("{}: {} of {} bad frames are faulty\n", GetParam().name, faults, GetParam().frames);
}

const char* const c_timing = "{}/sim/report/timing.toml";

INSTANTIATE_TEST_SUITE_P(
    Tops, BadInput,
    testing::Values(
        Case{"quadratic", c_timing, {.shader = Shader::quadratic}, 12, 200},
        Case{"quadratic_published",
             c_timing,
             {.shader = Shader::quadratic, .preset = Preset::published},
             12,
             200},
        Case{"spherical", c_timing, {.shader = Shader::spherical}, 12, 200},
        Case{"processors", c_timing, {.shader = Shader::processors}, 12, 60},
        Case{"shadows", "shadows", {.shader = Shader::processors, .preset = Preset::published}, 14, 20},
        Case{"filter",
             c_timing,
             {.shader = Shader::processors, .preset = Preset::published, .objects = 2, .subpixels = 4},
             14,
             40}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
}  // namespace halfway
