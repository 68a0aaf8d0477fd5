// SPDX-License-Identifier: Apache-2.0
#include "run/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <span>

#include "golden/formats.hpp"
#include "golden/word.hpp"
#include "plan/plan.hpp"
#include "run/golden_run.hpp"
#include "run/limits.hpp"
#include "run/scene_stream.hpp"
#include "run/stream_comparator.hpp"
#include "sim/verilator/verilator_simulator.hpp"

namespace halfway {
namespace {

// A field of a flat vector, wherever its block lies.
struct PlacedField {
  std::string name;
  golden::Field field;
  int block_low;
};

std::vector<PlacedField> place(std::span<const golden::Field> header, int header_bits,
                               std::span<const golden::Field> channel, int channel_bits, unsigned channels) {
  static constexpr const char* c_colours[] = {"red", "green", "blue"};
  std::vector<PlacedField> fields;
  for (const golden::Field& f : header) fields.push_back({std::string(f.name), f, 0});
  for (unsigned c = 0; c < channels; ++c)
    for (const golden::Field& f : channel)
      fields.push_back({fmt::format("{} {}", channels == 1 ? "grey" : c_colours[c], f.name), f,
                        header_bits + static_cast<int>(c) * channel_bits});
  return fields;
}

template <class P>
std::vector<PlacedField> init_fields(unsigned channels) {
  return place(P::c_init_header, P::c_init_header_bits, P::c_init_channel, P::c_init_channel_bits, channels);
}
template <class P>
std::vector<PlacedField> probe_fields(unsigned channels) {
  return place(P::c_probe_header, P::c_probe_header_bits, P::c_probe_channel, P::c_probe_channel_bits,
               channels);
}

bool belongs(const PlacedField& f, std::string_view stage) {
  return f.field.name.starts_with(stage) && f.field.name != "line_event" && f.field.name != "span_event";
}

// Which entity's register a probe field shows.
std::string_view entity_of(std::string_view field) {
  if (field == "line_start" || field == "line_stop" || field == "line_carry")
    return "edge_walker (in preset published: line_interpolator)";
  if (field.ends_with("_y") || field.ends_with("_x")) return "triangle_walker";
  if (field.ends_with("_z")) return "z_interpolator";
  return "quadratic_interpolator";
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
    const bool exact = key.preset == Preset::exact;
    init_fields_ =
        exact ? init_fields<golden::Exact>(key.channels) : init_fields<golden::Published>(key.channels);
    probe_fields_ =
        exact ? probe_fields<golden::Exact>(key.channels) : probe_fields<golden::Published>(key.channels);
    auto simulator =
        VerilatorSimulator::open(key, s_.folders, {.idle_limit = c_idle_limit, .record_probes = true});
    if (!simulator) return simulator.error();
    const QuadraticSetup setup(scene_, s_.size, report_.key, s_.setup);
    const std::unique_ptr<GoldenModel> golden = make_golden_model(report_.key);
    const std::size_t words_per_vector = (setup.init_bits() + 31) / 32;

    SceneStream stream(scene_, setup, report_.key, s_.threads);
    bool alive = true;
    for (Batch batch; alive && stream.next(batch);) {
      s_.on_progress(static_cast<double>(batch.triangles_done) /
                     static_cast<double>(scene_.triangles.size()));
      for (std::size_t at = 0; alive && at < batch.init_words.size(); at += words_per_vector, ++vector_) {
        const auto words = std::span(batch.init_words).subspan(at, words_per_vector);
        draw_golden(*golden, words);
        const std::size_t limit = golden_fragments_.size() + c_surplus;
        alive = take(simulator->run(words, 1, rtl_fragments_, limit), *simulator);
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
    std::optional<std::pair<std::size_t, std::size_t>> story;  // story and stage to fill in
  };
  struct ExpectedFragment {
    Fragment fragment;
    std::optional<std::pair<std::size_t, std::size_t>> story;
  };

  // The golden side of one vector: what is expected of each stage, and the pixel's stories.
  void draw_golden(GoldenModel& golden, std::span<const std::uint32_t> words) {
    std::vector<Fragment> fragments;
    std::vector<ProbeEvent> events;
    golden.draw_probed(words, fragments, events);
    std::size_t drawn = 0;
    std::deque<Expected>* const queues[] = {&lines_, &spans_};
    for (ProbeEvent& event : events) {
      Expected expected{std::move(event), std::nullopt};
      if (expected.event.stage == Stage::span) {
        ExpectedFragment fragment{fragments[drawn++], std::nullopt};
        if (expected.event.x == s_.x && expected.event.y == s_.y) {
          const std::size_t story = begin_story(words, fragment.fragment);
          // The line that this pixel is on is the last one expected.
          lines_.back().story = {story, 0};
          show(line_event_, story, 0);
          expected.story = {story, 1};
          show(expected.event, story, 1);
          fragment.story = {story, 2};
        }
        golden_fragments_.push_back(fragment);
      } else {
        line_event_ = expected.event;
      }
      queues[expected.event.stage == Stage::span]->push_back(std::move(expected));
    }
  }

  std::size_t begin_story(std::span<const std::uint32_t> words, const Fragment& fragment) {
    PixelStory story;
    story.vector = vector_;
    story.triangle = fragment.triangle;
    for (const PlacedField& f : init_fields_) story.init.push_back(value_of(f, words, words));
    story.stages.resize(3);
    story.stages[0].stage = "line";
    story.stages[1].stage = "span";
    story.stages[2].stage = "fragment";
    const auto golden = fields(fragment);
    for (std::size_t i = 0; i < golden.size(); ++i)
      story.stages[2].values.push_back(
          {std::string(c_fragment_fields[i]), golden[i], 0, c_fragment_bits[i], 0, false});
    report_.stories.push_back(std::move(story));
    return report_.stories.size() - 1;
  }

  // The golden values of a stage; the RTL's come when it does.
  void show(const ProbeEvent& event, std::size_t story, std::size_t stage) {
    const std::string_view prefix = stage == 0 ? "line_" : "span_";
    const std::vector<std::uint32_t> none(event.words.size(), 0);
    for (const PlacedField& f : probe_fields_)
      if (belongs(f, prefix))
        report_.stories[story].stages[stage].values.push_back(value_of(f, event.words, none));
  }

  // What the simulator has drawn since the last call, against what is expected. False once nothing more can
  // be learnt.
  bool take(const Status& status, VerilatorSimulator& simulator) {
    for (const ProbeRecord& record : simulator.probes()) {
      last_cycle_ = record.cycle;
      if ((record.words[0] & 1) != 0) check(record, "line", "line_", lines_, 0);
      if ((record.words[0] & 2) != 0) {
        check(record, "span", "span_", spans_, 1);
        fragment_cycles_.push_back(record.cycle + 1);
      }
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

  void check(const ProbeRecord& record, std::string_view stage, std::string_view prefix,
             std::deque<Expected>& queue, std::size_t index) {
    if (queue.empty()) {
      differ({std::string(stage), "triangle_walker", fmt::format("a {} too many", stage), record.cycle, 0, 0,
              0, "nothing", "one"});
      return;
    }
    const Expected expected = std::move(queue.front());
    queue.pop_front();
    if (expected.story) {
      StageState& state = report_.stories[expected.story->first].stages[index];
      state.cycle = record.cycle;
      std::size_t i = 0;
      for (const PlacedField& f : probe_fields_)
        if (belongs(f, prefix)) state.values[i++] = value_of(f, expected.event.words, record.words);
    }
    for (const PlacedField& f : probe_fields_) {
      if (!belongs(f, prefix)) continue;
      const std::uint64_t golden = golden::get_bits(expected.event.words, f.field, f.block_low);
      const std::uint64_t rtl = golden::get_bits(record.words, f.field, f.block_low);
      if (golden == rtl) continue;
      differ({std::string(stage), std::string(entity_of(f.field.name)), f.name, record.cycle,
              expected.event.triangle, expected.event.y, expected.event.x, shown(golden, f), shown(rtl, f)});
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
      StageState& state = report_.stories[expected.story->first].stages[2];
      state.cycle = cycle;
      for (std::size_t i = 0; i < b.size(); ++i) state.values[i].rtl = b[i];
    }
    for (std::size_t i = 0; i < a.size(); ++i)
      if (a[i] != b[i]) {
        differ({"fragment", i >= 4 ? "saturate, or the register behind it" : "the register behind the shader",
                std::string(c_fragment_fields[i]), cycle, expected.fragment.triangle, expected.fragment.y,
                expected.fragment.x, std::to_string(a[i]), std::to_string(b[i])});
        return;
      }
  }

  void note_missing() {
    const auto missing = [&](std::string_view stage, const std::deque<Expected>& queue) {
      if (queue.empty()) return;
      const ProbeEvent& e = queue.front().event;
      differ({std::string(stage), "triangle_walker", fmt::format("a {} that never came", stage), UINT64_MAX,
              e.triangle, e.y, e.x, "one", "nothing"});
    };
    missing("line", lines_);
    missing("span", spans_);
    if (report_.first && report_.first->cycle == UINT64_MAX) report_.first->cycle = last_cycle_ + 1;
  }

  // Keeps the earliest; of equal cycles the earlier stage, which is checked first.
  void differ(FirstDifference difference) {
    if (!report_.first || difference.cycle < report_.first->cycle) report_.first = std::move(difference);
  }

  const Scene& scene_;
  const WhySettings& s_;
  WhyReport report_;
  std::vector<PlacedField> init_fields_, probe_fields_;
  std::deque<Expected> lines_, spans_;
  std::deque<ExpectedFragment> golden_fragments_;
  std::deque<std::uint64_t> fragment_cycles_;
  std::vector<Fragment> rtl_fragments_;
  ProbeEvent line_event_{};
  std::optional<Error> tool_error_;
  std::uint64_t vector_ = 0, last_cycle_ = 0;
};

}  // namespace

Result<WhyReport> explain_pixel(const Scene& scene, const WhySettings& settings) {
  return Explainer(scene, settings).run(plan_quadratic(scene, settings.preset).key);
}

}  // namespace halfway
