// SPDX-License-Identifier: Apache-2.0
// A GoldenModel of any golden shader. Formats are the shader's number formats, such as golden::Exact.
#pragma once

#include <algorithm>
#include <memory>

#include "golden/processors_shader.hpp"
#include "golden/quadratic_shader.hpp"
#include "golden/spherical_shader.hpp"
#include "golden_run/golden_run.hpp"

namespace halfway {

/// Takes the next triangle's vectors off the front of init_words. Empty at the end, and for a triangle whose
/// vectors are cut short, which draws nothing.
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

/// Appends a ProbeEvent for each register that a shader shows.
struct ProbeRecorder {
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

/// The golden model of one shader: QuadraticShader, SphericalShader or ProcessorsShader.
template <class Shader>
class ShaderModel final : public GoldenModel {
 public:
  template <class... Config>
  explicit ShaderModel(const Config&... config) : shader_(config...) {}
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
    draw(init_words, fragments, ProbeRecorder{events, fragments});
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

/// S is the key's shader.
template <class Formats, Shader S>
std::unique_ptr<GoldenModel> make_shader_model(const HardwareKey& key) {
  if constexpr (S == Shader::spherical)
    return std::make_unique<ShaderModel<golden::SphericalShader<Formats>>>(golden_config(key));
  else if constexpr (S == Shader::processors)
    return std::make_unique<ShaderModel<golden::ProcessorsShader<Formats>>>(processors_config(key));
  else if (key.channels == 1)
    return std::make_unique<ShaderModel<golden::QuadraticShader<Formats, 1>>>();
  else
    return std::make_unique<ShaderModel<golden::QuadraticShader<Formats, 3>>>();
}

}  // namespace halfway
