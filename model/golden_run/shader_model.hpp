// SPDX-License-Identifier: Apache-2.0
// A GoldenModel of any golden shader. Formats are the shader's number formats, such as words::Exact.
#pragma once

#include <algorithm>
#include <memory>

#include "golden/objects_shader.hpp"
#include "golden/processors_shader.hpp"
#include "golden/quadratic_shader.hpp"
#include "golden/spherical_shader.hpp"
#include "golden_run/golden_run.hpp"

namespace halfway {

/// Removes the next triangle's vectors from the start of init_words and returns them. Returns an empty span
/// at the end, and if the vectors of the triangle are incomplete; nothing is then drawn.
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

/// The golden model of one shader: QuadraticShader, SphericalShader, ProcessorsShader or ObjectsShader.
template <class Shader>
class ShaderModel final : public GoldenModel {
 public:
  template <class... Config>
  explicit ShaderModel(const Config&... config) : shader_(config...) {}
  std::size_t group(std::span<const std::uint32_t> init_words) const override {
    return shader_.group(init_words);
  }
  bool is_load(std::span<const std::uint32_t> init_words) const override {
    if constexpr (requires { shader_.is_load(init_words); })
      return shader_.is_load(init_words);
    else
      return false;
  }
  bool touches(std::span<const std::uint32_t> init_words, const Tile& tile) const override {
    if constexpr (c_has_strips) {
      return true;  // a strip is drawn whole
    } else {
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
  }
  std::uint64_t pixels(std::span<const std::uint32_t> init_words) const override {
    if constexpr (c_has_strips) {
      return shader_.pixels(init_words);
    } else {
      if (is_load(init_words)) return 0;
      std::uint64_t count = 0;
      auto walker = shader_.walker_of(init_words);
      walker.walk([&] {
        if (!walker.line_empty()) count += walker.pixels();
      });
      return count;
    }
  }
  void draw(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) override {
    if constexpr (c_has_strips)
      draw_each(init_words, fragments);
    else
      draw_inlined(init_words, fragments);
  }
  bool fault() const override {
    if constexpr (requires { shader_.fault(); })
      return shader_.fault();
    else
      return false;
  }
  unsigned init_bits() const override { return static_cast<unsigned>(shader_.init_bits()); }

 private:
  static constexpr bool c_has_strips =
      requires(const Shader& shader, std::span<const std::uint32_t> vector) { shader.pixels(vector); };

  void draw_each(std::span<const std::uint32_t> init_words, std::vector<Fragment>& fragments) {
    const auto emit = [&](const Fragment& fragment) { fragments.push_back(fragment); };
    for (auto triangle = take_triangle(shader_, init_words); !triangle.empty();
         triangle = take_triangle(shader_, init_words))
      shader_.draw(triangle, emit);
  }
  // Inline the shader, so that the fields of a fragment are written directly to the vector.
  [[gnu::flatten]] void draw_inlined(std::span<const std::uint32_t> init_words,
                                     std::vector<Fragment>& fragments) {
    draw_each(init_words, fragments);
  }

  Shader shader_;
};

template <class Formats, int Degree>
std::unique_ptr<GoldenModel> make_quadratic_model(const HardwareKey& key) {
  if (key.channels == 1) return std::make_unique<ShaderModel<golden::QuadraticShader<Formats, 1, Degree>>>();
  return std::make_unique<ShaderModel<golden::QuadraticShader<Formats, 3, Degree>>>();
}

/// S must be the key's shader.
template <class Formats, Shader S>
std::unique_ptr<GoldenModel> make_shader_model(const HardwareKey& key) {
  if constexpr (S == Shader::spherical)
    return std::make_unique<ShaderModel<golden::SphericalShader<Formats>>>(golden_config(key));
  else if constexpr (S == Shader::processors) {
    if (const unsigned objects = key.processors.objects; objects > 0)
      return std::make_unique<ShaderModel<golden::ObjectsShader<Formats>>>(
          processors_config(key), static_cast<int>(key.processors.subpixels), static_cast<int>(objects));
    return std::make_unique<ShaderModel<golden::ProcessorsShader<Formats>>>(processors_config(key));
  } else if (key.degree == 1)
    return make_quadratic_model<Formats, 1>(key);
  else
    return make_quadratic_model<Formats, 2>(key);
}

}  // namespace halfway
