// SPDX-License-Identifier: Apache-2.0
#include "golden_run/golden_run.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "golden/processors_shader.hpp"
#include "golden/quadratic_shader.hpp"
#include "golden/spherical_shader.hpp"

namespace halfway {
namespace {

// Takes the next triangle's vectors off the front; none where there is no more, or one that is cut short,
// which draws nothing.
template <class Shader>
std::span<const std::uint32_t> take_triangle(const Shader& shader,
                                             std::span<const std::uint32_t>& init_words) {
  const auto vector_words = static_cast<std::size_t>((shader.init_bits() + 31) / 32);
  const std::size_t words = init_words.size() < vector_words ? 0 : shader.group(init_words) * vector_words;
  const bool whole = words <= init_words.size();
  const auto triangle = init_words.first(whole ? words : 0);
  init_words = whole && words != 0 ? init_words.subspan(words) : std::span<const std::uint32_t>();
  return triangle;
}

struct Watch {
  std::vector<ProbeEvent>& events;
  const std::vector<Fragment>& fragments;
  void line(const auto& shader) { add(shader, Stage::line, shader.walker().start(), shader.line_probe()); }
  void span(const auto& shader, golden::SpanXWord x) { add(shader, Stage::span, x, shader.span_probe(x)); }
  void sample(const auto& shader, golden::SpanXWord x) {
    add(shader, Stage::sample, x, shader.sample_probe());
  }
  void product(const auto& shader, golden::SpanXWord x) {
    add(shader, Stage::product, x, shader.product_probe());
  }
  void processor(const auto& shader, golden::SpanXWord x, int number) {
    add(shader, processor_stage(number), x, shader.processor_probe(number));
  }

 private:
  void add(const auto& shader, Stage stage, golden::SpanXWord x, const auto& words) {
    events.push_back({stage,
                      shader.walker().triangle(),
                      shader.walker().y(),
                      static_cast<std::uint32_t>(golden::low_bits(x.bits(), golden::Exact::c_pixel_x_bits)),
                      {words.begin(), words.end()},
                      fragments.size()});
  }
};

template <class Shader>
class Model final : public GoldenModel {
 public:
  template <class... Config>
  explicit Model(const Config&... config) : shader_(config...) {}
  std::size_t group(std::span<const std::uint32_t> init_words) const override {
    return shader_.group(init_words);
  }
  bool touches(std::span<const std::uint32_t> init_words, const Tile& tile) const override {
    const std::int64_t left = tile.x, right = left + tile.size.width, top = tile.y,
                       bottom = top + tile.size.height;
    bool touched = false;
    auto walker = shader_.walker_of(init_words);
    walker.walk([&] {
      if (touched || walker.line_empty() || walker.y() < top || walker.y() >= bottom) return;
      const std::int64_t first = walker.start().value(),
                         last = walker.stop().value() - walker.pixel_step().value();
      touched = std::min(first, last) < right && std::max(first, last) >= left;
    });
    return touched;
  }
  std::uint64_t pixels(std::span<const std::uint32_t> init_words) const override {
    std::uint64_t count = 0;
    auto walker = shader_.walker_of(init_words);
    walker.walk([&] {
      if (!walker.line_empty()) count += walker.pixels();
    });
    return count;
  }
  void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) override {
    draw(init_words, fragments, golden::Unwatched());
  }
  void draw_probed(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments,
                   std::vector<ProbeEvent>& events) override {
    draw(init_words, fragments, Watch{events, fragments});
  }
  bool fault() const override {
    if constexpr (requires { shader_.fault(); })
      return shader_.fault();
    else
      return false;
  }
  unsigned init_bits() const override { return static_cast<unsigned>(shader_.init_bits()); }
  unsigned probe_bits() const override { return static_cast<unsigned>(shader_.probe_bits()); }

 private:
  // Inline the shader, so that the fields of a fragment go straight to the vector.
  template <class Watch>
  [[gnu::flatten]] void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments,
                             Watch watch) {
    const auto emit = [&](const Fragment& fragment) { fragments.push_back(fragment); };
    for (auto triangle = take_triangle(shader_, init_words); !triangle.empty();
         triangle = take_triangle(shader_, init_words))
      shader_.draw(triangle, emit, watch);
  }

  Shader shader_;
};

}  // namespace

#ifndef HALFWAY_MODELS_ALONE  // sim/formats/harness.cpp makes one of them, of other formats
namespace {

template <class Preset>
std::unique_ptr<GoldenModel> make(const HardwareKey& key) {
  if (key.shader == Shader::spherical)
    return std::make_unique<Model<golden::SphericalShader<Preset>>>(golden_config(key));
  if (key.shader == Shader::processors)
    return std::make_unique<Model<golden::ProcessorsShader<Preset>>>(processors_config(key));
  if (key.channels == 1) return std::make_unique<Model<golden::QuadraticShader<Preset, 1>>>();
  return std::make_unique<Model<golden::QuadraticShader<Preset, 3>>>();
}

}  // namespace

std::unique_ptr<GoldenModel> make_golden_model(const HardwareKey& key) {
  return key.preset == Preset::exact ? make<golden::Exact>(key) : make<golden::Published>(key);
}
#endif

}  // namespace halfway
