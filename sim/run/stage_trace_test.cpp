// SPDX-License-Identifier: Apache-2.0
// Golden model and RTL must have equal values in every stage of the table.
#include "sim/run/stage_trace.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "golden/word.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/scene_files/load_scene.hpp"
#include "sim/system/test/source_folder.hpp"

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
    auto scene = load_scene(c.scene, c_source_folder / "sim" / "scenes");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto plan = plan_scene(*scene, {.shader = c.shader, .preset = c.preset, .form = c.form});
    ASSERT_TRUE(plan) << plan.error().message;
    key_ = plan->key;
    const auto setup = make_setup(*scene, {24, 18}, key_, {});
    vectors_.bits = setup->init_bits();
    SceneStream stream(*setup, key_, 1);
    for (Batch batch; stream.next(batch);) {
      vectors_.words.insert(vectors_.words.end(), batch.init_words.begin(), batch.init_words.end());
      golden_.insert(golden_.end(), batch.golden.begin(), batch.golden.end());
    }
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
  const auto rtl = trace_stages(key_, *stages, {c_source_folder, c_source_folder / "build" / "cache"},
                                vectors_, golden_.size());
  ASSERT_TRUE(rtl) << rtl.error().message;
  EXPECT_THAT(rtl->fault, IsEmpty());
  for (std::size_t s = 0; s < golden.size(); ++s) {
    const Stage& stage = stages->stages()[s];
    ASSERT_THAT(rtl->events[s], SizeIs(golden[s].size())) << stage.name;
    for (std::size_t i = 0; i < golden[s].size(); ++i)
      for (std::size_t w = 0; w < stage.words.size(); ++w)
        ASSERT_EQ(rtl->events[s][i].words[w], golden[s][i].words[w])
            << stage.name << " stage, " << stage.words[w].name << ", number " << i << ", cycle "
            << rtl->events[s][i].cycle;
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
                                           Case{"shadows", Shader::processors, Preset::exact},
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

// Vectors of random bits with few lines: registers wrap, and spans run in both directions and outside the
// frame.
template <class Preset>
void expect_watch_changes_nothing(const HardwareKey& key) {
  SCOPED_TRACE(key.name());
  using At = typename Preset::init_header_at;
  const auto golden = make_golden_model(key);
  const std::size_t words = (golden->init_bits() + 31) / 32;
  std::mt19937 random(20260229);
  std::vector<std::uint32_t> vectors;
  const auto add = [&] {
    for (std::size_t word = 0; word < words; ++word) vectors.push_back(static_cast<std::uint32_t>(random()));
  };
  for (int i = 0; i < 6; ++i) {
    const std::size_t begin = vectors.size();
    add();
    const auto vector = std::span(vectors).subspan(begin);
    golden::set_bits(vector, At::upper_lines, 1 + random() % 3);
    if constexpr (std::is_same_v<Preset, golden::Exact>)
      golden::set_bits(vector, At::lower_lines, random() % 3);
    for (std::size_t records = golden->group(vector) - 1; records > 0; --records) add();
  }
  const auto drawn = golden->draw(vectors);
  ASSERT_GT(drawn.size(), 1000U);
  const auto stages = make_stages(key);
  std::size_t fragments = 0;
  for (const GoldenEvent& event : stages->draw(vectors)) {
    ASSERT_THAT(event.words, SizeIs(stages->stages()[event.stage].words.size()));
    if (event.stage + 1 < stages->stages().size()) continue;
    const Fragment& f = drawn[fragments++];
    ASSERT_EQ(event.words, (std::vector<std::uint64_t>{f.triangle, f.y, f.x, f.z, f.red, f.green, f.blue}));
  }
  EXPECT_EQ(fragments, drawn.size());
}

TEST(GoldenStages, DrawWhatTheGoldenModelDraws) {
  HardwareKey key;
  for (const unsigned channels : {1U, 3U}) {
    key.channels = channels;
    key.preset = Preset::exact;
    expect_watch_changes_nothing<golden::Exact>(key);
    key.preset = Preset::published;
    expect_watch_changes_nothing<golden::Published>(key);
  }
  key.shader = Shader::spherical;
  for (const unsigned lights : {0U, 1U, 3U})
    for (const bool diffuse : {false, true})
      for (const bool specular : {false, true})
        for (const unsigned highlights : {1U, key.channels}) {
          key.spherical = {lights, diffuse, specular, highlights, 0x16, {9, 8}};
          key.preset = Preset::exact;
          expect_watch_changes_nothing<golden::Exact>(key);
          key.spherical.powers = 2;
          key.spherical.tables = {6, 6};
          key.preset = Preset::published;
          expect_watch_changes_nothing<golden::Published>(key);
        }
}

}  // namespace
}  // namespace halfway
