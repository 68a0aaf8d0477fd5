// SPDX-License-Identifier: Apache-2.0
#include "sim/run/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "golden/processors_layout.hpp"
#include "golden/quadratic_layout.hpp"
#include "golden/spherical_layout.hpp"
#include "golden/word.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/run/open_engine.hpp"
#include "sim/run/rtl_frame.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/run/simulate.hpp"
#include "sim/run/stages.hpp"
#include "sim/run/vectors_around.hpp"

namespace halfway {
namespace {

// A field of a flat vector, with the position of its block.
struct PlacedField {
  std::string name;
  golden::Field field;
  int block_low;
};

// Inputs of both sides: the fields of a triangle's first vector and of a line's record.
struct Given {
  std::vector<PlacedField> init, record;
};

template <class P, int Degree>
Given quadratic_given(const HardwareKey& key) {
  using Layout = golden::QuadraticLayout<P, Degree>;
  Given given;
  for (const golden::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (unsigned c = 0; c < key.channels; ++c)
    for (const golden::Field& f : P::c_init_channel)
      if (Layout::has(f))
        given.init.push_back({fmt::format("{} {}", channel_name(c, key.channels), f.name), f,
                              Layout::channel_low(static_cast<int>(c))});
  return given;
}

template <class P>
Given spherical_given(const HardwareKey& key) {
  const golden::SphericalConfig config = golden_config(key);
  const golden::SphericalLayout<P> at(config);
  Given given;
  for (const golden::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (int c = 0; c < config.channels; ++c)
    given.init.push_back({channel_name(static_cast<unsigned>(c), key.channels) + " ambient",
                          P::ambient_channel_at::ambient, at.ambient_low(c)});
  // A slice's part of a record: the fields of its header, then one word per channel.
  const auto place = [&](std::span<const golden::Field> header, int header_bits,
                         std::span<const golden::Field> channel, int channel_bits, int channels,
                         const std::string& slice, int low) {
    for (const golden::Field& f : header)
      given.record.push_back({fmt::format("{} {}", slice, f.name), f, low});
    for (int c = 0; c < channels; ++c)
      for (const golden::Field& f : channel)
        given.record.push_back(
            {fmt::format("{} {}{}", slice,
                         channels == 1 ? "" : channel_name(static_cast<unsigned>(c), 3) + " ", f.name),
             f, low + header_bits + c * channel_bits});
  };
  for (int l = 0; l < config.lights; ++l) {
    const std::string light = fmt::format("light {}", l + 1);
    if (at.has_diffuse_part())
      place(P::c_diffuse_header, P::c_diffuse_header_bits, P::c_diffuse_channel, P::c_diffuse_channel_bits,
            at.diffuse_channels(), light + " diffuse", at.diffuse_low(l));
    if (config.specular)
      place(P::c_specular_header, P::c_specular_header_bits, P::c_specular_channel,
            P::c_specular_channel_bits, config.highlight_channels, light + " specular", at.specular_low(l));
  }
  return given;
}

template <class P>
Given processors_given(const HardwareKey& key) {
  using golden::Field;
  const golden::ProcessorsConfig config = processors_config(key);
  const golden::ProcessorsLayout<P> at(config);
  Given given;
  for (const Field& f : P::c_request_header) given.init.push_back({std::string(f.name), f, 0});
  for (const Field& f : golden::Exact::c_init_header)
    given.init.push_back({std::string(f.name), f, at.walk_low()});
  const std::vector<std::string> planes = plane_names(key);
  for (std::size_t p = 0; p < planes.size(); ++p)
    for (const Field& f : P::c_plane_header)
      given.init.push_back({fmt::format("{} {}", planes[p], f.name), f, at.plane_low(static_cast<int>(p))});
  const int material = at.init_material_low();
  if (config.specular)
    given.init.push_back({"exponent",
                          {"", at.exponent_low(), P::c_exponent_bits, false, P::c_exponent_fraction_bits},
                          material});
  const auto place_coefficient = [&](const char* name, int low, int channel) {
    given.init.push_back(
        {fmt::format("{} {}", channel_name(static_cast<unsigned>(channel), key.channels), name),
         {"", low, P::c_coefficient_bits, false, P::c_coefficient_fraction_bits},
         material});
  };
  for (int c = 0; c < config.channels; ++c) {
    place_coefficient("k ambient", at.ambient_low(c), c);
    if (config.diffuse) place_coefficient("k diffuse", at.diffuse_low(c), c);
    if (config.specular) place_coefficient("k specular", at.specular_low(c), c);
  }
  return given;
}

template <class P>
Given given_of(const HardwareKey& key) {
  if (key.shader == Shader::processors) return processors_given<P>(key);
  if (key.shader == Shader::spherical) return spherical_given<P>(key);
  return key.degree == 1 ? quadratic_given<P, 1>(key) : quadratic_given<P, 2>(key);
}

std::vector<StageValue> values_of(const std::vector<PlacedField>& fields,
                                  std::span<const std::uint32_t> vector) {
  std::vector<StageValue> values;
  for (const PlacedField& f : fields) {
    const std::uint64_t word = golden::get_bits(vector, f.field, f.block_low);
    values.push_back({f.name, word, word, f.field.bits, f.field.fraction_bits, f.field.is_signed});
  }
  return values;
}

std::string shown(const std::optional<std::uint64_t>& word, const StageWord& w) {
  if (!word) return "no number";
  const std::int64_t value = w.is_signed ? static_cast<std::int64_t>(*word << (64 - w.bits)) >> (64 - w.bits)
                                         : static_cast<std::int64_t>(*word);
  const std::string digits = fmt::format("{:0{}x}", *word, (w.bits + 3) / 4);
  if (w.fraction_bits == 0) return fmt::format("{} ({})", digits, value);
  return fmt::format("{} ({:.6f})", digits,
                     static_cast<double>(value) / static_cast<double>(std::uint64_t{1} << w.fraction_bits));
}

class Explainer {
 public:
  Explainer(const Scene& scene, const WhySettings& settings, const HardwareKey& key)
      : scene_(scene),
        s_(settings),
        key_(key),
        setup_(make_setup(scene, settings.size, key, settings.setup)),
        stages_(make_stages(key)),
        given_(key.preset == Preset::exact ? given_of<golden::Exact>(key) : given_of<golden::Published>(key)),
        expected_(stages_->stages().size()) {
    report_.key = key;
  }

  Result<WhyReport> run() {
    if (Status status = compare_frame(); !status) return status.error();
    const VectorsAround kept = choose_triangles();
    for (const VectorsAround::Triangle& triangle : kept.kept()) draw_golden(triangle);
    if (expected_.back().empty()) return report_;
    const auto rtl = trace_stages(key_, *stages_, s_.folders, {setup_->init_bits(), kept.words()},
                                  expected_.back().size());
    if (!rtl) return rtl.error();
    if (report_.fault.empty()) report_.fault = rtl->fault;
    for (std::size_t stage = expected_.size(); stage-- > 0;) check(stage, rtl->events[stage]);
    return report_;
  }

 private:
  // An event of the golden model, and the number of the story of its pixel.
  struct Expected {
    GoldenEvent event;
    std::optional<std::size_t> story;
  };

  std::size_t words_per_vector() const { return (setup_->init_bits() + 31) / 32; }

  // Compare the whole frame in Verilator, fragment by fragment.
  Status compare_frame() {
    auto engine = open_engine(EngineKind::verilator, key_, s_.folders);
    if (!engine) return engine.error();
    SceneStream stream(*setup_, key_, s_.threads);
    RtlFrame rtl(std::move(*engine), s_.size, scene_.background);
    for (Batch batch; rtl.alive() && stream.next(batch);) {
      s_.on_progress(batch.done);
      report_.fragments += batch.golden.size();
      if (Status status = rtl.add(batch.init_words, batch.golden); !status) return status;
    }
    if (Status status = rtl.finish(); !status) return status;
    report_.in_view = triangles_in_view(stream.counts());
    const SimulatorRun run = rtl.result();
    report_.fault = run.fault;
    if (run.first.empty()) return Ok{};
    report_.frame_difference = run.first.front();
    // A fragment after the last golden one belongs to the last triangle.
    if (report_.fragments > 0) first_wrong_ = std::min(run.first.front().index, report_.fragments - 1);
    return Ok{};
  }

  // Choose the triangles that cover the pixel, and the one with the first fragment that differs.
  VectorsAround choose_triangles() {
    const std::unique_ptr<GoldenModel> golden = make_golden_model(key_);
    VectorsAround kept(key_);
    SceneStream stream(*setup_, key_, s_.threads, {.golden = false});
    std::uint64_t drawn = 0;
    for (Batch batch; stream.next(batch);)
      for (auto rest = std::span<const std::uint32_t>(batch.init_words); !rest.empty();) {
        const std::size_t vectors = golden->group(rest);
        const auto words = rest.first(vectors * words_per_vector());
        rest = rest.subspan(words.size());
        const auto fragments = golden->draw(words);
        const std::uint64_t before = std::exchange(drawn, drawn + fragments.size());
        const bool covers =
            std::ranges::any_of(fragments, [&](const Fragment& f) { return is_asked(f.x, f.y); });
        kept.add(words, vectors, covers || (before <= first_wrong_ && first_wrong_ < drawn));
      }
    return kept;
  }

  bool is_asked(std::uint32_t x, std::uint32_t y) const { return x == s_.x && y == s_.y; }

  // Draw the expected events of each stage, and the golden part of the pixel's stories.
  void draw_golden(const VectorsAround::Triangle& triangle) {
    const std::vector<Stage>& stages = stages_->stages();
    std::vector<GoldenEvent> events = stages_->draw(triangle.words);
    std::size_t line = 0, pixel = 0;  // first events of this line and of this pixel
    std::vector<std::optional<std::size_t>> story(events.size());
    for (std::size_t i = 0; i < events.size(); ++i) {
      const GoldenEvent& event = events[i];
      if (event.stage == 0) line = i;
      if (event.stage == 1) pixel = i;
      if (event.stage + 1 < stages.size() || !is_asked(event.x, event.y)) continue;
      story[line] = report_.stories.size();
      for (std::size_t of_pixel = pixel; of_pixel <= i; ++of_pixel) story[of_pixel] = report_.stories.size();
      report_.stories.push_back(begin_story(triangle, event));
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      if (story[i]) show_golden(events[i], report_.stories[*story[i]].stages[events[i].stage]);
      expected_[events[i].stage].push_back({std::move(events[i]), story[i]});
    }
  }

  PixelStory begin_story(const VectorsAround::Triangle& triangle, const GoldenEvent& fragment) const {
    const std::span<const std::uint32_t> words = triangle.words;
    PixelStory story{triangle.first, fragment.triangle, values_of(given_.init, words), {}, {}};
    if (!given_.record.empty()) {
      const std::size_t line = fragment.y - get_bits(words, golden::Exact::init_header_at::y);
      story.record =
          values_of(given_.record, words.subspan((1 + line) * words_per_vector(), words_per_vector()));
    }
    for (const Stage& stage : stages_->stages()) story.stages.push_back({stage.name, std::nullopt, {}});
    return story;
  }

  void show_golden(const GoldenEvent& event, StageState& state) const {
    const std::vector<StageWord>& words = stages_->stages()[event.stage].words;
    for (std::size_t i = 0; i < words.size(); ++i)
      state.values.push_back({words[i].name, event.words[i], std::nullopt, words[i].bits,
                              words[i].fraction_bits, words[i].is_signed});
  }

  // Compare the events of a stage one by one.
  void check(std::size_t stage, const std::vector<RtlEvent>& rtl) {
    const std::string& name = stages_->stages()[stage].name;
    const std::string& entity = stages_->stages()[stage].entity;
    const std::vector<Expected>& golden = expected_[stage];
    for (std::size_t i = 0; i < std::min(golden.size(), rtl.size()); ++i) compare(golden[i], rtl[i]);
    if (rtl.size() > golden.size())
      differ({name, entity, fmt::format("a {} too many", name), rtl[golden.size()].cycle, 0, 0, 0, "nothing",
              "one"});
    if (golden.size() > rtl.size()) {
      const GoldenEvent& missing = golden[rtl.size()].event;
      differ({name, entity, fmt::format("a {} that never came", name), rtl.empty() ? 0 : rtl.back().cycle + 1,
              missing.triangle, missing.y, missing.x, "one", "nothing"});
    }
  }

  void compare(const Expected& golden, const RtlEvent& rtl) {
    const Stage& stage = stages_->stages()[golden.event.stage];
    if (golden.story) {
      StageState& state = report_.stories[*golden.story].stages[golden.event.stage];
      state.cycle = rtl.cycle;
      for (std::size_t i = 0; i < rtl.words.size(); ++i) state.values[i].rtl = rtl.words[i];
    }
    for (std::size_t i = 0; i < rtl.words.size(); ++i) {
      if (rtl.words[i] == golden.event.words[i]) continue;
      const StageWord& word = stage.words[i];
      differ({stage.name, word.entity, word.name, rtl.cycle, golden.event.triangle, golden.event.y,
              golden.event.x, shown(golden.event.words[i], word), shown(rtl.words[i], word)});
      return;
    }
  }

  // Keep the earliest difference; of equal cycles that of the later stage, because its pixel is earlier.
  void differ(FirstDifference difference) {
    if (!report_.first || difference.cycle < report_.first->cycle) report_.first = std::move(difference);
  }

  const Scene& scene_;
  const WhySettings& s_;
  HardwareKey key_;
  std::unique_ptr<Setup> setup_;
  std::unique_ptr<ShaderStages> stages_;
  Given given_;
  std::vector<std::vector<Expected>> expected_;  // by stage
  WhyReport report_;
  std::uint64_t first_wrong_ = UINT64_MAX;  // fragment of the frame
};

}  // namespace

Result<WhyReport> explain_pixel(const Scene& scene, const WhySettings& settings) {
  const auto plan = plan_scene(scene, settings.plan);
  if (!plan) return plan.error();
  return Explainer(scene, settings, plan->key).run();
}

}  // namespace halfway
