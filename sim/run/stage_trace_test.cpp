// SPDX-License-Identifier: Apache-2.0
// Golden model and RTL must have equal values in every stage of the table.
#include "sim/run/stage_trace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "plan/plan.hpp"
#include "sim/driver/frame_driver.hpp"
#include "sim/engines/ghdl/test/checkout.hpp"
#include "sim/files/test/built_in_scene.hpp"
#include "sim/os/must.hpp"

namespace halfway {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

struct Case {
  const char* scene;
  Shader shader;
  Preset preset;
  std::optional<ProcessorForm> form = {};
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.scene << ' ' << to_string(c.shader) << ' ' << to_string(c.preset)
       << (c.form == ProcessorForm::folded ? " folded" : "");
}

class Stages : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const Case& c = GetParam();
    const Scene scene = built_in_scene(c.scene);
    const auto plan = must(plan_scene(scene, {.shader = c.shader, .preset = c.preset, .form = c.form}));
    key_ = plan.key;
    FrameStream stream = must(whole_stream(scene, {24, 18}, key_));
    vectors_ = {stream.init_bits, std::move(stream.words)};
    golden_ = std::move(stream.golden);
    ASSERT_FALSE(golden_.empty());
  }

  HardwareKey key_;
  InitStream vectors_;
  std::vector<Fragment> golden_;
};

TEST_P(Stages, AreEqualInGoldenModelAndRtl) {
  const auto stages = make_stages(key_);
  std::vector<std::vector<GoldenEvent>> golden(stages->stages().size());
  for (GoldenEvent& event : stages->draw(vectors_.words)) golden[event.stage].push_back(std::move(event));
  // Observing the golden model does not change its fragments.
  ASSERT_THAT(golden.back(), SizeIs(golden_.size()));
  for (std::size_t i = 0; i < golden_.size(); ++i) {
    const Fragment& f = golden_[i];
    EXPECT_EQ(golden.back()[i].words,
              (std::vector<std::uint64_t>{f.triangle, f.y, f.x, f.z, f.red, f.green, f.blue}));
  }
  const StageTrace rtl = trace_stages(key_, *stages, c_checkout, vectors_, golden_.size());
  EXPECT_THAT(rtl.fault, IsEmpty());
  for (std::size_t s = 0; s < golden.size(); ++s) {
    const Stage& stage = stages->stages()[s];
    ASSERT_THAT(rtl.events[s], SizeIs(golden[s].size())) << stage.name;
    for (std::size_t i = 0; i < golden[s].size(); ++i)
      for (std::size_t w = 0; w < stage.words.size(); ++w)
        ASSERT_EQ(rtl.events[s][i].words[w], golden[s][i].words[w])
            << stage.name << " stage, " << stage.words[w].name << ", number " << i << ", cycle "
            << rtl.events[s][i].cycle;
  }
}

const auto c_name_of_case = [](const auto& test) {
  std::string name = ::testing::PrintToString(test.param);
  std::ranges::replace(name, ' ', '_');
  return name;
};
INSTANTIATE_TEST_SUITE_P(Quick, Stages,
                         ::testing::Values(Case{"spheres", Shader::quadratic, Preset::exact},
                                           Case{"lights", Shader::quadratic, Preset::published},
                                           Case{"matte", Shader::spherical, Preset::exact},
                                           Case{"spheres", Shader::spherical, Preset::published},
                                           Case{"matte", Shader::processors, Preset::exact},
                                           Case{"spheres", Shader::processors, Preset::published,
                                                ProcessorForm::folded}),
                         c_name_of_case);
INSTANTIATE_TEST_SUITE_P(Whole, Stages,
                         ::testing::Values(Case{"matte", Shader::quadratic, Preset::exact},
                                           Case{"lights", Shader::spherical, Preset::exact},
                                           Case{"lights", Shader::processors, Preset::exact},
                                           Case{"spheres", Shader::processors, Preset::exact,
                                                ProcessorForm::folded},
                                           Case{"lights", Shader::processors, Preset::published}),
                         c_name_of_case);

}  // namespace
}  // namespace halfway
