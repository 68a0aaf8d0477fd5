// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/token_rasterizer.vhd, of its triangles: one token per covered pixel.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "golden/plane_interpolator.hpp"
#include "golden/shading_token.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/z_interpolator.hpp"

namespace halfway::golden {

/// The walk of a host's vector, a header of preset exact. It starts within a word, so copy it.
template <class Preset>
auto walk_of(std::span<const std::uint32_t> vector) {
  static_assert(Exact::c_init_header_bits % 32 == 0);
  std::array<std::uint32_t, Exact::c_init_header_bits / 32> walk;
  for (std::size_t i = 0; i < walk.size(); ++i)
    walk[i] = static_cast<std::uint32_t>(
        get_bits(vector, {"", 32 * static_cast<int>(i), 32, false, 0}, ProcessorsLayout<Preset>::walk_low()));
  return walk;
}

template <class Preset>
class TokenRasterizer {
 public:
  using Token = ShadingToken<Preset>;

  explicit TokenRasterizer(const ProcessorsConfig& config)
      : config_(config), layout_(config), planes_(static_cast<std::size_t>(layout_.planes())) {}

  /// Calls line() when the span stage loads a line, and pixel(x) at each of its pixels. token() is its token.
  template <class Line, class Pixel>
  void draw(std::span<const std::uint32_t> vector, Line&& line, Pixel&& pixel) {
    token_.decode_request(vector);
    for (line_load(vector);; line_step()) {
      if (!walker_.line_empty()) draw_line(line, pixel);
      if (walker_.line_last()) return;
    }
  }

  /// The token of the pixel. The caller may change it.
  Token& token() { return token_; }
  const Token& token() const { return token_; }
  const TriangleWalker<Exact>& walker() const { return walker_; }
  /// The triangle walker after it loaded the header of this vector.
  TriangleWalker<Exact> walker_of(std::span<const std::uint32_t> vector) const {
    TriangleWalker<Exact> walker;
    walker.line_load(walk_of<Preset>(vector));
    return walker;
  }
  const ZInterpolator<Exact>& depth() const { return depth_; }
  /// The upper bits of the plane's value. Setup has added half a step, so truncation rounds.
  std::int64_t plane_value(int plane) const {
    constexpr int c_drop = Preset::c_plane_sum_bits - Preset::c_vector_bits;
    return planes_[static_cast<std::size_t>(plane)].value().value() >> c_drop;
  }

 private:
  using PlaneAt = typename Preset::plane_header_at;
  using Plane = PlaneInterpolator<Preset::c_plane_sum_bits>;

  void line_load(std::span<const std::uint32_t> vector) {
    const auto walk = walk_of<Preset>(vector);
    walker_.line_load(walk);
    depth_.line_load(walk);
    for (int p = 0; p < layout_.planes(); ++p) {
      const auto word = [&](const Field& field) {
        return Plane::Value::from_bits(get_bits(vector, field, layout_.plane_low(p)));
      };
      planes_[static_cast<std::size_t>(p)].line_load(word(PlaneAt::value), word(PlaneAt::dx),
                                                     word(PlaneAt::de0), word(PlaneAt::de1));
    }
    token_.decode_material(config_, vector);
  }
  void line_step() {
    const bool carry = walker_.carry();
    walker_.line_step();
    depth_.line_step(carry);
    for (auto& plane : planes_) plane.line_step(carry);
  }
  void span_load() {
    depth_.span_load();
    for (auto& plane : planes_) plane.span_load();
  }
  void span_step() {
    depth_.span_step();
    for (auto& plane : planes_) plane.span_step();
  }

  template <class Line, class Pixel>
  void draw_line(Line& line, Pixel& pixel) {
    line();
    span_load();
    token_.triangle = walker_.triangle();
    token_.y = walker_.y();
    const SpanXWord stop = walker_.stop(), step = walker_.pixel_step();
    for (SpanXWord x = walker_.start(); x != stop; x += step) {
      token_.x = static_cast<std::uint32_t>(low_bits(x.bits(), Preset::c_pixel_x_bits));
      token_.z = depth_.z();
      for (int i = 0; i < c_axes; ++i) token_.normal[static_cast<std::size_t>(i)] = plane_value(i);
      if (layout_.has_place())
        for (int i = 0; i < c_axes; ++i) token_.place[static_cast<std::size_t>(i)] = plane_value(c_axes + i);
      if (layout_.has_distance()) token_.distance = plane_value(2 * c_axes);
      pixel(x);
      span_step();
    }
  }

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  TriangleWalker<Exact> walker_;
  ZInterpolator<Exact> depth_;
  std::vector<Plane> planes_;  // N, P or the view ray, 1/w
  Token token_;
};

}  // namespace halfway::golden
