// SPDX-License-Identifier: Apache-2.0
#include "sim/driver/pixel_way.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "words/processors_layout.hpp"
#include "words/quadratic_layout.hpp"
#include "words/spherical_layout.hpp"

namespace halfway {
namespace {

template <class P, int Degree>
GivenFields quadratic_given(const HardwareKey& key) {
  using Layout = words::QuadraticLayout<P, Degree>;
  GivenFields given;
  for (const words::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (unsigned c = 0; c < key.channels; ++c)
    for (const words::Field& f : P::c_init_channel)
      if (Layout::has(f))
        given.init.push_back({fmt::format("{} {}", channel_name(c, key.channels), f.name), f,
                              Layout::channel_low(static_cast<int>(c))});
  return given;
}

template <class P>
GivenFields spherical_given(const HardwareKey& key) {
  const words::SphericalConfig config = golden_config(key);
  const words::SphericalLayout<P> at(config);
  GivenFields given;
  for (const words::Field& f : P::c_init_header) given.init.push_back({std::string(f.name), f, 0});
  for (int c = 0; c < config.channels; ++c)
    given.init.push_back({channel_name(static_cast<unsigned>(c), key.channels) + " ambient",
                          P::ambient_channel_at::ambient, at.ambient_low(c)});
  // A slice's part of a record: the fields of its header, then one word per channel.
  const auto place = [&](std::span<const words::Field> header, int header_bits,
                         std::span<const words::Field> channel, int channel_bits, int channels,
                         const std::string& slice, int low) {
    for (const words::Field& f : header)
      given.record.push_back({fmt::format("{} {}", slice, f.name), f, low});
    for (int c = 0; c < channels; ++c)
      for (const words::Field& f : channel)
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
GivenFields processors_given(const HardwareKey& key) {
  using words::Field;
  const words::ProcessorsConfig config = processors_config(key);
  const words::ProcessorsLayout<P> at(config);
  GivenFields given;
  for (const Field& f : P::c_request_header) given.init.push_back({std::string(f.name), f, 0});
  for (const Field& f : words::Exact::c_init_header)
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
GivenFields given_of(const HardwareKey& key) {
  if (key.shader == Shader::processors) return processors_given<P>(key);
  if (key.shader == Shader::spherical) return spherical_given<P>(key);
  return key.degree == 1 ? quadratic_given<P, 1>(key) : quadratic_given<P, 2>(key);
}

GivenFields given_fields(const HardwareKey& key) {
  return key.preset == Preset::exact ? given_of<words::Exact>(key) : given_of<words::Published>(key);
}

std::vector<StageValue> values_of(const std::vector<PlacedField>& fields,
                                  std::span<const std::uint32_t> vector) {
  std::vector<StageValue> values;
  for (const PlacedField& f : fields) {
    const std::uint64_t word = words::get_bits(vector, f.field, f.block_low);
    values.push_back({f.name, word, word, {f.field.bits, f.field.fraction_bits, f.field.is_signed}});
  }
  return values;
}

// A word in hexadecimal and the number that it represents, in this form.
std::string word_text(fmt::format_string<std::string, std::string> form, std::uint64_t word,
                      const WordFormat& format) {
  const int unused = 64 - format.bits;
  const auto value = format.is_signed ? static_cast<std::int64_t>(word << unused) >> unused
                                      : static_cast<std::int64_t>(word);
  std::string number =
      format.fraction_bits == 0
          ? std::to_string(value)
          : fmt::format("{:.6f}", std::ldexp(static_cast<double>(value), -format.fraction_bits));
  return fmt::format(form, fmt::format("{:0{}x}", word, (format.bits + 3) / 4), std::move(number));
}

std::string shown(const std::optional<std::uint64_t>& word, const StageWord& w) {
  return word ? word_text("{} ({})", *word, w.format) : "no number";
}

}  // namespace

std::string text_of(std::uint64_t word, const StageValue& value) {
  return word_text("{} = {}", word, value.format);
}

std::string FirstDifference::text() const {
  return fmt::format("{} stage ({}), cycle {}: triangle {}, line {}, pixel {}: {}: golden {}, RTL {}", stage,
                     entity, cycle, triangle, y, x, value, golden, rtl);
}

PixelSearch::PixelSearch(const HardwareKey& key, FramePixel pixel, std::uint64_t fragment)
    : golden_(make_golden_model(key)), kept_(key), pixel_(pixel), fragment_(fragment) {}

void PixelSearch::add(std::span<const std::uint32_t> init_words) {
  const std::size_t vector_words = (golden_->init_bits() + 31) / 32;
  while (!init_words.empty()) {
    const std::size_t vectors = golden_->group(init_words);
    const auto words = init_words.first(vectors * vector_words);
    init_words = init_words.subspan(words.size());
    const auto fragments = golden_->draw(words);
    const std::uint64_t before = std::exchange(drawn_, drawn_ + fragments.size());
    const bool covers = std::any_of(fragments.begin(), fragments.end(),
                                    [&](const Fragment& f) { return f.x == pixel_.x && f.y == pixel_.y; });
    kept_.add(words, vectors, covers || (before <= fragment_ && fragment_ < drawn_));
  }
}

PixelWay::PixelWay(const HardwareKey& key, FramePixel pixel)
    : pixel_(pixel),
      stages_(make_stages(key)),
      vector_words_((make_golden_model(key)->init_bits() + 31) / 32),
      given_(given_fields(key)),
      expected_(stages_->stages().size()) {}

void PixelWay::draw_golden(const VectorsAround& triangles) {
  for (const VectorsAround::Triangle& triangle : triangles.kept()) draw_golden(triangle);
}

// Draw the expected events of each stage, and the golden part of the pixel's stories.
void PixelWay::draw_golden(const VectorsAround::Triangle& triangle) {
  const std::vector<Stage>& stages = stages_->stages();
  std::vector<GoldenEvent> events = stages_->draw(triangle.words);
  std::size_t line = 0, pixel = 0;  // first events of this line and of this pixel
  std::vector<std::optional<std::size_t>> story(events.size());
  for (std::size_t i = 0; i < events.size(); ++i) {
    const GoldenEvent& event = events[i];
    if (event.stage == 0) line = i;
    if (event.stage == 1) pixel = i;
    if (event.stage + 1 < stages.size() || event.x != pixel_.x || event.y != pixel_.y) continue;
    story[line] = stories_.size();
    for (std::size_t of_pixel = pixel; of_pixel <= i; ++of_pixel) story[of_pixel] = stories_.size();
    stories_.push_back(begin_story(triangle, event));
  }
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (story[i]) show_golden(events[i], stories_[*story[i]].stages[events[i].stage]);
    expected_[events[i].stage].push_back({std::move(events[i]), story[i]});
  }
}

PixelStory PixelWay::begin_story(const VectorsAround::Triangle& triangle, const GoldenEvent& fragment) const {
  const std::span<const std::uint32_t> words = triangle.words;
  PixelStory story{triangle.first, fragment.triangle, values_of(given_.init, words), {}, {}};
  if (!given_.record.empty()) {
    const std::size_t line = fragment.y - words::get_bits(words, words::Exact::init_header_at::y);
    story.record = values_of(given_.record, words.subspan((1 + line) * vector_words_, vector_words_));
  }
  for (const Stage& stage : stages_->stages()) story.stages.push_back({stage.name, std::nullopt, {}});
  return story;
}

void PixelWay::show_golden(const GoldenEvent& event, StageState& state) const {
  const std::vector<StageWord>& words = stages_->stages()[event.stage].words;
  for (std::size_t i = 0; i < words.size(); ++i)
    state.values.push_back({words[i].name, event.words[i], std::nullopt, words[i].format});
}

// Compare the events of a stage one by one.
void PixelWay::check(std::size_t stage, const std::vector<RtlEvent>& rtl) {
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

void PixelWay::compare(const std::vector<std::vector<RtlEvent>>& events) {
  for (std::size_t stage = expected_.size(); stage-- > 0;) check(stage, events[stage]);
}

void PixelWay::compare(const Expected& golden, const RtlEvent& rtl) {
  const Stage& stage = stages_->stages()[golden.event.stage];
  if (golden.story) {
    StageState& state = stories_[*golden.story].stages[golden.event.stage];
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
void PixelWay::differ(FirstDifference difference) {
  if (!first_ || difference.cycle < first_->cycle) first_ = std::move(difference);
}

}  // namespace halfway
