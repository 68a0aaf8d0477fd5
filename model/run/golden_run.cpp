// SPDX-License-Identifier: Apache-2.0
#include "run/golden_run.hpp"

#include "golden/processors_shader.hpp"
#include "golden/quadratic_shader.hpp"
#include "golden/spherical_shader.hpp"

namespace halfway {
namespace {

struct Room {
  std::vector<Fragment>& fragments;
  Fragment* room(std::size_t count) {
    fragments.resize(fragments.size() + count);
    return fragments.data() + fragments.size() - count;
  }
};

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
  void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) override {
    each_triangle(init_words, [&](auto words) { shader_.draw(words, Room{fragments}); });
  }
  void draw_probed(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments,
                   std::vector<ProbeEvent>& events) override {
    each_triangle(init_words, [&](auto words) {
      shader_.draw(
          words, [&](const Fragment& f) { fragments.push_back(f); }, Watch{events, fragments});
    });
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
  template <class Draw>
  void each_triangle(std::span<const std::uint32_t> init_words, Draw&& draw) {
    const auto vector_words = static_cast<std::size_t>((shader_.init_bits() + 31) / 32);
    while (init_words.size() >= vector_words) {
      const std::size_t words = shader_.group(init_words) * vector_words;
      if (words > init_words.size()) return;  // a triangle cut short draws nothing
      draw(init_words.first(words));
      init_words = init_words.subspan(words);
    }
  }
  Shader shader_;
};

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

}  // namespace halfway
