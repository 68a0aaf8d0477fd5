// SPDX-License-Identifier: Apache-2.0
#include "sim/run/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <span>
#include <type_traits>

#include "golden/spherical_layout.hpp"
#include "golden/word.hpp"
#include "golden_run/golden_run.hpp"
#include "plan/plan.hpp"
#include "sim/compare/limits.hpp"
#include "sim/compare/stream_comparator.hpp"
#include "sim/run/scene_stream.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

// Walks the triangles of every shader.
constexpr const char* c_walker = "triangle_walker";

// A field of a flat vector, wherever its block lies.
struct PlacedField {
  std::string name;
  golden::Field field;
  int block_low;
  Stage stage = Stage::line;  // of the probe's fields: with which event it is valid
  std::string entity = {};    // whose register it shows, and what gives that its inputs
};

// A stage of which the probe tells what it does, in the order of Stage.
struct ProbedStage {
  std::string name;
  int event;                // its bit of the probe
  std::string_view entity;  // that makes it happen
};

// What a hardware key's flat vectors hold.
struct Layouts {
  std::vector<PlacedField> init, record, probe;
  std::vector<ProbedStage> stages;
  unsigned clocks_to_fragment = 1;  ///< from the last stage's event, where nothing waits
};

std::vector<ProbedStage> walked_stages(std::initializer_list<const char*> names) {
  std::vector<ProbedStage> stages;
  for (const char* name : names) stages.push_back({name, static_cast<int>(stages.size()), c_walker});
  return stages;
}

std::string channel_name(unsigned channel, unsigned channels) {
  static constexpr const char* c_colours[] = {"red", "green", "blue"};
  return channels == 1 ? "grey" : c_colours[channel];
}

// A register shows what its entity did with what it was given: a fault may lie on either side.
std::string within(std::string_view entity, std::string_view around) {
  return fmt::format("{}, or {} around it", entity, around);
}

template <class P>
std::string walk_entity(std::string_view field, const HardwareKey& key) {
  if (field == "line_start" || field == "line_stop" || field == "line_carry")
    return within(std::is_same_v<P, golden::Exact> ? "edge_walker" : "slope_walker", c_walker);
  return within(field.ends_with("_z") ? "z_interpolator" : c_walker, key.entity());
}

template <class P>
void place_probe_header(Layouts& layouts, const HardwareKey& key) {
  for (const golden::Field& f : P::c_probe_header)
    if (!f.name.ends_with("_event"))
      layouts.probe.push_back({std::string(f.name), f, 0,
                               f.name.starts_with("line_") ? Stage::line : Stage::span,
                               walk_entity<P>(f.name, key)});
}

template <class P>
Layouts quadratic_layouts(const HardwareKey& key) {
  const unsigned channels = key.channels;
  Layouts layouts;
  layouts.stages = walked_stages({"line", "span"});
  layouts.clocks_to_fragment = 2;  // a span's pixel goes into the queue
  for (const golden::Field& f : P::c_init_header) layouts.init.push_back({std::string(f.name), f, 0});
  place_probe_header<P>(layouts, key);
  for (unsigned c = 0; c < channels; ++c) {
    const auto name = [&](const golden::Field& f) {
      return fmt::format("{} {}", channel_name(c, channels), f.name);
    };
    for (const golden::Field& f : P::c_init_channel)
      layouts.init.push_back(
          {name(f), f, P::c_init_header_bits + static_cast<int>(c) * P::c_init_channel_bits});
    for (const golden::Field& f : P::c_probe_channel)
      layouts.probe.push_back({name(f), f,
                               P::c_probe_header_bits + static_cast<int>(c) * P::c_probe_channel_bits,
                               f.name.starts_with("line_") ? Stage::line : Stage::span,
                               within("quadratic_interpolator", key.entity())});
  }
  return layouts;
}

template <class P>
Layouts spherical_layouts(const HardwareKey& key) {
  const golden::SphericalConfig config = golden_config(key);
  const golden::SphericalLayout<P> at(config);
  Layouts layouts;
  layouts.stages = walked_stages({"line", "span", "sample", "product"});
  for (const golden::Field& f : P::c_init_header) layouts.init.push_back({std::string(f.name), f, 0});
  for (int c = 0; c < config.channels; ++c)
    layouts.init.push_back({channel_name(static_cast<unsigned>(c), key.channels) + " ambient",
                            P::ambient_channel_at::ambient, at.ambient_low(c)});
  place_probe_header<P>(layouts, key);
  // One slice's part of a record or of the probe: its header's fields, then a word a channel.
  const auto place = [](std::vector<PlacedField>& fields, std::span<const golden::Field> header,
                        int header_bits, std::span<const golden::Field> channel, int channel_bits,
                        int channels, const std::string& slice, int low, std::string_view around) {
    const auto add = [&](const golden::Field& f, int block_low, const std::string& of) {
      const Stage stage = f.name == "product"                          ? Stage::product
                          : f.name == "sample" || f.name == "in_range" ? Stage::sample
                                                                       : Stage::span;
      fields.push_back({fmt::format("{} {}{}", slice, of, f.name), f, block_low, stage,
                        within(stage == Stage::span     ? "line_interpolator"
                               : f.name == "in_range"   ? "angle_address"
                               : stage == Stage::sample ? "cosine_rom"
                                                        : "multiplier",
                               around)});
    };
    for (const golden::Field& f : header) add(f, low, "");
    for (int c = 0; c < channels; ++c)
      for (const golden::Field& f : channel)
        add(f, low + header_bits + c * channel_bits,
            channels == 1 ? "" : channel_name(static_cast<unsigned>(c), 3) + " ");
  };
  for (int l = 0; l < config.lights; ++l) {
    const std::string light = fmt::format("light {}", l + 1);
    if (at.has_diffuse_part()) {
      place(layouts.record, P::c_diffuse_header, P::c_diffuse_header_bits, P::c_diffuse_channel,
            P::c_diffuse_channel_bits, at.diffuse_channels(), light + " diffuse", at.diffuse_low(l), "");
      place(layouts.probe, P::c_diffuse_probe_header, P::c_diffuse_probe_header_bits,
            P::c_diffuse_probe_channel, P::c_diffuse_probe_channel_bits, at.diffuse_channels(),
            light + " diffuse", at.diffuse_probe_low(l), "diffuse_slice");
    }
    if (config.specular) {
      place(layouts.record, P::c_specular_header, P::c_specular_header_bits, P::c_specular_channel,
            P::c_specular_channel_bits, config.highlight_channels, light + " specular", at.specular_low(l),
            "");
      place(layouts.probe, P::c_specular_probe_header, P::c_specular_probe_header_bits,
            P::c_specular_probe_channel, P::c_specular_probe_channel_bits, config.highlight_channels,
            light + " specular", at.specular_probe_low(l), "specular_slice");
    }
  }
  return layouts;
}

template <class P>
Layouts processors_layouts(const HardwareKey& key) {
  using golden::Field;
  const golden::ProcessorsConfig config = processors_config(key);
  const golden::ProcessorsLayout<P> at(config);
  const bool folded = key.processors.form == ProcessorForm::folded;
  const std::string_view processor = folded ? "shading_processor" : "unrolled_shading_processor";
  Layouts layouts;
  layouts.stages = walked_stages({"line", "span"});
  const auto colour = [&](int channel) { return channel_name(static_cast<unsigned>(channel), key.channels); };
  // What the planes are of.
  std::vector<std::string> planes;
  for (const char* axis : {"x", "y", "z"}) planes.push_back(std::string("N ") + axis);
  if (at.has_place())
    for (const char* axis : {"x", "y", "z"})
      planes.push_back(std::string(key.preset == Preset::exact ? "view ray " : "P ") + axis);
  if (at.has_distance()) planes.emplace_back("1/w");

  for (const Field& f : P::c_request_header) layouts.init.push_back({std::string(f.name), f, 0});
  for (const Field& f : golden::Exact::c_init_header)
    layouts.init.push_back({std::string(f.name), f, at.walk_low()});
  for (std::size_t p = 0; p < planes.size(); ++p)
    for (const Field& f : P::c_plane_header)
      layouts.init.push_back({fmt::format("{} {}", planes[p], f.name), f, at.plane_low(static_cast<int>(p))});
  const int material = at.init_material_low();
  if (config.specular)
    layouts.init.push_back({"exponent",
                            {"", at.exponent_low(), P::c_exponent_bits, false, P::c_exponent_fraction_bits},
                            material});
  const auto place_coefficient = [&](const char* name, int low, int channel) {
    layouts.init.push_back({fmt::format("{} {}", colour(channel), name),
                            {"", low, P::c_coefficient_bits, false, P::c_coefficient_fraction_bits},
                            material});
  };
  for (int c = 0; c < config.channels; ++c) {
    place_coefficient("k ambient", at.ambient_low(c), c);
    if (config.diffuse) place_coefficient("k diffuse", at.diffuse_low(c), c);
    if (config.specular) place_coefficient("k specular", at.specular_low(c), c);
  }

  place_probe_header<golden::Exact>(layouts, key);
  for (std::size_t p = 0; p < planes.size(); ++p)
    layouts.probe.push_back({planes[p],
                             {"", 0, P::c_vector_bits, true, P::c_vector_fraction_bits},
                             at.probe_plane_low(static_cast<int>(p)),
                             Stage::span,
                             "plane_interpolator"});
  int number = 0;
  const auto add_processor = [&](std::string name) {
    const int low = at.probe_processor_low(number);
    const Stage stage = processor_stage(number++);
    using At = typename P::processor_probe_header_at;
    layouts.stages.push_back({std::move(name), low + At::leaves.low, processor});
    layouts.probe.push_back({"command", At::command, low, stage, "processors_shader"});
    for (int c = 0; c < config.channels; ++c)
      layouts.probe.push_back({colour(c) + " so far", P::processor_probe_channel_at::radiance,
                               low + P::c_processor_probe_header_bits + c * P::c_processor_probe_channel_bits,
                               stage, std::string(processor)});
  };
  add_processor("ambient");
  for (int light = 1; light <= config.lights(); ++light) {
    if (config.diffuse) add_processor(fmt::format("diffuse {}", light));
    if (config.specular) add_processor(fmt::format("specular {}", light));
  }
  return layouts;
}

template <class P>
Layouts layouts_of(const HardwareKey& key) {
  if (key.shader == Shader::processors) return processors_layouts<P>(key);
  return key.shader == Shader::spherical ? spherical_layouts<P>(key) : quadratic_layouts<P>(key);
}

std::string shown(std::uint64_t word, const PlacedField& f) {
  const int digits = (f.field.bits + 3) / 4;
  const std::int64_t value =
      f.field.is_signed ? static_cast<std::int64_t>(word << (64 - f.field.bits)) >> (64 - f.field.bits)
                        : static_cast<std::int64_t>(word);
  if (f.field.fraction_bits == 0) return fmt::format("{:0{}x} ({})", word, digits, value);
  return fmt::format(
      "{:0{}x} ({:.6f})", word, digits,
      static_cast<double>(value) / static_cast<double>(std::uint64_t{1} << f.field.fraction_bits));
}

StageValue value_of(const PlacedField& f, std::span<const std::uint32_t> golden,
                    std::span<const std::uint32_t> rtl) {
  return {f.name,
          golden::get_bits(golden, f.field, f.block_low),
          golden::get_bits(rtl, f.field, f.block_low),
          f.field.bits,
          f.field.fraction_bits,
          f.field.is_signed};
}

// As c_fragment_fields; the same in both presets.
constexpr std::array<int, 7> c_fragment_bits = {golden::Exact::c_triangle_bits, golden::Exact::c_pixel_y_bits,
                                                golden::Exact::c_pixel_x_bits,  golden::Exact::c_depth_bits,
                                                golden::Exact::c_colour_bits,   golden::Exact::c_colour_bits,
                                                golden::Exact::c_colour_bits};

class Explainer {
 public:
  Explainer(const Scene& scene, const WhySettings& settings) : scene_(scene), s_(settings) {}

  Result<WhyReport> run(HardwareKey key) {
    report_.key = key;
    key.probe = true;
    layouts_ =
        key.preset == Preset::exact ? layouts_of<golden::Exact>(key) : layouts_of<golden::Published>(key);
    expected_.resize(layouts_.stages.size());
    auto simulator =
        VerilatorSimulator::open(key, s_.folders, {.idle_limit = c_idle_limit, .record_probes = true});
    if (!simulator) return simulator.error();
    const std::unique_ptr<Setup> setup = make_setup(scene_, s_.size, report_.key, s_.setup);
    const std::unique_ptr<GoldenModel> golden = make_golden_model(report_.key);
    words_per_vector_ = (setup->init_bits() + 31) / 32;

    SceneStream stream(*setup, report_.key, s_.threads);
    bool alive = true;
    for (Batch batch; alive && stream.next(batch);) {
      s_.on_progress(batch.done);
      for (auto rest = std::span<const std::uint32_t>(batch.init_words); alive && !rest.empty();) {
        const std::size_t vectors = golden->group(rest);
        const auto words = rest.first(vectors * words_per_vector_);
        rest = rest.subspan(words.size());
        draw_golden(*golden, words);
        vector_ += vectors;
        const std::size_t limit = golden_fragments_.size() + c_surplus;
        alive = take(simulator->run(words, vectors, rtl_fragments_, limit), *simulator);
      }
    }
    if (alive) take(simulator->finish(rtl_fragments_, golden_fragments_.size() + c_surplus), *simulator);
    if (tool_error_) return *tool_error_;
    note_missing();
    return report_;
  }

 private:
  static constexpr std::size_t c_surplus = 1000;

  struct Expected {
    ProbeEvent event;
    std::optional<std::size_t> story;  // to fill in
  };
  struct ExpectedFragment {
    Fragment fragment;
    std::optional<std::size_t> story;
  };

  // The golden side of one triangle: what is expected of each stage, and the pixel's stories.
  void draw_golden(GoldenModel& golden, std::span<const std::uint32_t> words) {
    std::vector<Fragment> fragments;
    std::vector<ProbeEvent> events;
    golden.draw_probed(words, fragments, events);
    std::optional<std::size_t> story;  // of the pixel whose stages come now
    // Backwards: whether a span's pixel leaves a fragment is told by those drawn before the next one.
    std::vector<bool> draws(events.size());
    std::size_t drawn = fragments.size();
    for (std::size_t i = events.size(); i-- > 0;) {
      if (events[i].stage != Stage::span) continue;
      draws[i] = events[i].fragment != drawn;
      drawn = events[i].fragment;
    }
    for (std::size_t i = 0; i < events.size(); ++i) {
      ProbeEvent& event = events[i];
      const auto stage = static_cast<std::size_t>(event.stage);
      Expected expected{std::move(event), std::nullopt};
      if (expected.event.stage == Stage::line) {
        line_event_ = expected.event;
      } else {
        if (expected.event.stage == Stage::span) {
          story.reset();
          if (draws[i]) {
            ExpectedFragment fragment{fragments[expected.event.fragment], std::nullopt};
            if (expected.event.x == s_.x && expected.event.y == s_.y) {
              story = begin_story(words, fragment.fragment);
              // The line that this pixel is on is the last one expected.
              expected_[0].back().story = story;
              show(line_event_, *story);
              fragment.story = story;
            }
            golden_fragments_.push_back(fragment);
          }
        }
        expected.story = story;
        if (story) show(expected.event, *story);
      }
      expected_[stage].push_back(std::move(expected));
    }
  }

  std::size_t begin_story(std::span<const std::uint32_t> words, const Fragment& fragment) {
    PixelStory story;
    story.vector = vector_;
    story.triangle = fragment.triangle;
    for (const PlacedField& f : layouts_.init) story.init.push_back(value_of(f, words, words));
    if (!layouts_.record.empty()) {
      const std::size_t line = fragment.y - get_bits(words, golden::Exact::init_header_at::y);
      const auto record = words.subspan((1 + line) * words_per_vector_, words_per_vector_);
      for (const PlacedField& f : layouts_.record) story.record.push_back(value_of(f, record, record));
    }
    for (const ProbedStage& stage : layouts_.stages) story.stages.push_back({stage.name, std::nullopt, {}});
    story.stages.push_back({"fragment", std::nullopt, {}});
    const auto golden = fields(fragment);
    for (std::size_t i = 0; i < golden.size(); ++i)
      story.stages.back().values.push_back(
          {std::string(c_fragment_fields[i]), golden[i], 0, c_fragment_bits[i], 0, false});
    report_.stories.push_back(std::move(story));
    return report_.stories.size() - 1;
  }

  // The golden values of a stage; the RTL's come when it does.
  void show(const ProbeEvent& event, std::size_t story) {
    const std::vector<std::uint32_t> none(event.words.size(), 0);
    for (const PlacedField& f : layouts_.probe)
      if (f.stage == event.stage)
        report_.stories[story].stages[static_cast<std::size_t>(event.stage)].values.push_back(
            value_of(f, event.words, none));
  }

  // What the simulator has drawn since the last call, against what is expected. False once nothing more can
  // be learnt.
  bool take(const Status& status, VerilatorSimulator& simulator) {
    for (const ProbeRecord& record : simulator.probes()) {
      last_cycle_ = record.cycle;
      // A later stage holds an earlier pixel.
      const auto happens = [&](const ProbedStage& stage) {
        return golden::get_bits(record.words, {"", stage.event, 1, false, 0}) != 0;
      };
      for (std::size_t stage = layouts_.stages.size(); stage-- > 0;)
        if (happens(layouts_.stages[stage])) check(record, stage);
      if (happens(layouts_.stages.back()))
        fragment_cycles_.push_back(record.cycle + layouts_.clocks_to_fragment);
    }
    simulator.probes().clear();
    for (const Fragment& f : rtl_fragments_) check_fragment(f);
    rtl_fragments_.clear();
    if (status) return true;
    if (status.error().code == ExitCode::differs)
      report_.fault = status.error().message;
    else
      tool_error_ = status.error();
    return false;
  }

  void check(const ProbeRecord& record, std::size_t stage) {
    const std::string& name = layouts_.stages[stage].name;
    std::deque<Expected>& queue = expected_[stage];
    if (queue.empty()) {
      differ({name, std::string(layouts_.stages[stage].entity), fmt::format("a {} too many", name),
              record.cycle, 0, 0, 0, "nothing", "one"});
      return;
    }
    const Expected expected = std::move(queue.front());
    queue.pop_front();
    if (expected.story) {
      StageState& state = report_.stories[*expected.story].stages[stage];
      state.cycle = record.cycle;
      std::size_t i = 0;
      for (const PlacedField& f : layouts_.probe)
        if (f.stage == expected.event.stage)
          state.values[i++] = value_of(f, expected.event.words, record.words);
    }
    for (const PlacedField& f : layouts_.probe) {
      if (f.stage != expected.event.stage) continue;
      const std::uint64_t golden = golden::get_bits(expected.event.words, f.field, f.block_low);
      const std::uint64_t rtl = golden::get_bits(record.words, f.field, f.block_low);
      if (golden == rtl) continue;
      differ({name, f.entity, f.name, record.cycle, expected.event.triangle, expected.event.y,
              expected.event.x, shown(golden, f), shown(rtl, f)});
      return;
    }
  }

  void check_fragment(const Fragment& rtl) {
    const std::uint64_t cycle = fragment_cycles_.empty() ? 0 : fragment_cycles_.front();
    if (!fragment_cycles_.empty()) fragment_cycles_.pop_front();
    if (golden_fragments_.empty()) return;  // the span stage has said so
    const ExpectedFragment expected = golden_fragments_.front();
    golden_fragments_.pop_front();
    const auto a = fields(expected.fragment), b = fields(rtl);
    if (expected.story) {
      StageState& state = report_.stories[*expected.story].stages.back();
      state.cycle = cycle;
      for (std::size_t i = 0; i < b.size(); ++i) state.values[i].rtl = b[i];
    }
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i]) {
        differ({"fragment",
                i < 4                                     ? "the register behind the shader"
                : report_.key.shader != Shader::spherical ? "saturate, or the register behind it"
                                                          : "saturating_sum, or the register behind it",
                std::string(c_fragment_fields[i]), cycle, expected.fragment.triangle, expected.fragment.y,
                expected.fragment.x, std::to_string(a[i]), std::to_string(b[i])});
        return;
      }
  }

  void note_missing() {
    for (std::size_t stage = 0; stage < expected_.size(); ++stage) {
      if (expected_[stage].empty()) continue;
      const ProbeEvent& e = expected_[stage].front().event;
      const std::string& name = layouts_.stages[stage].name;
      differ({name, std::string(layouts_.stages[stage].entity), fmt::format("a {} that never came", name),
              UINT64_MAX, e.triangle, e.y, e.x, "one", "nothing"});
    }
    if (report_.first && report_.first->cycle == UINT64_MAX) report_.first->cycle = last_cycle_ + 1;
  }

  // Keeps the earliest; of equal cycles the earlier stage, which is checked first.
  void differ(FirstDifference difference) {
    if (!report_.first || difference.cycle < report_.first->cycle) report_.first = std::move(difference);
  }

  const Scene& scene_;
  const WhySettings& s_;
  WhyReport report_;
  Layouts layouts_;
  std::size_t words_per_vector_ = 0;
  std::vector<std::deque<Expected>> expected_;  // by stage
  std::deque<ExpectedFragment> golden_fragments_;
  std::deque<std::uint64_t> fragment_cycles_;
  std::vector<Fragment> rtl_fragments_;
  ProbeEvent line_event_{};
  std::optional<Error> tool_error_;
  std::uint64_t vector_ = 0, last_cycle_ = 0;
};

}  // namespace

Result<WhyReport> explain_pixel(const Scene& scene, const WhySettings& settings) {
  const auto plan = plan_scene(scene, settings.plan);
  if (!plan) return plan.error();
  return Explainer(scene, settings).run(plan->key);
}

}  // namespace halfway
