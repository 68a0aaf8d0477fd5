// SPDX-License-Identifier: Apache-2.0
// Twin of rtl/shaders/processors_shader.vhd: the host's vectors to fragments, in the order that the hardware
// emits them.
#pragma once

#include <array>
#include <cassert>
#include <optional>
#include <vector>

#include "frame/fragment.hpp"
#include "golden/object_stage.hpp"
#include "golden/plane_interpolator.hpp"
#include "golden/saturate.hpp"
#include "golden/shading_pipeline.hpp"
#include "golden/triangle_walker.hpp"
#include "golden/unwatched.hpp"
#include "golden/z_interpolator.hpp"

namespace halfway::golden {

/// Lights, shadow counts and the object stage's line live from a vector to the next.
template <class Preset>
class ProcessorsShader {
 public:
  explicit ProcessorsShader(const ProcessorsConfig& config)
      : config_(config),
        layout_(config),
        planes_(static_cast<std::size_t>(layout_.planes())),
        pipeline_(config) {
    assert(config.channels == 1 || config.channels == 3);
    if (config.shadows) objects_.emplace();
  }

  int init_bits() const { return layout_.init_bits(); }
  std::size_t init_words() const { return words_of(init_bits()); }
  /// Each vector stands alone.
  std::size_t group(std::span<const std::uint32_t>) const { return 1; }
  /// A count of shadow volumes went wrong: what came since is worth nothing.
  bool fault() const { return pipeline_.fault(); }

  /// Processes one vector. Calls emit(fragment) for each pixel that leaves the pipeline, watch.line(*this)
  /// when the span stage loads a line, watch.span(*this, x) at each pixel of it, and
  /// watch.processor(*this, x, number) for each object that leaves a processor.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> vector, Emit&& emit, Watch&& watch = {}) {
    assert(vector.size() >= init_words());
    const auto request = [&](const Field& field) {
      return static_cast<std::uint32_t>(get_bits(vector, field));
    };
    walk_ = static_cast<Command>(request(RequestAt::command));
    if (walk_ == Command::new_frame) {
      previous_.reset();
      if (objects_) objects_->clear();
    }
    if (is_load(walk_)) {
      Token load = Token::decode(config_, vector);
      pipeline_.process(load);
      return;
    }
    token_.light_number = request(RequestAt::light);
    token_.opens = request(RequestAt::opens) != 0;
    token_.normalize = request(RequestAt::normalize) != 0;
    for (line_load(vector);; line_step()) {
      if (!walker_.line_empty()) draw_line(emit, watch);
      if (walker_.line_last()) return;
    }
  }

  const TriangleWalker<Exact>& walker() const { return walker_; }
  /// As a vector that draws, or passes over the line, loads it.
  TriangleWalker<Exact> walker_of(std::span<const std::uint32_t> vector) const {
    TriangleWalker<Exact> walker;
    walker.line_load(walk_of(vector));
    return walker;
  }

  // The registers, for a watch.
  const ZInterpolator<Exact>& depth() const { return depth_; }
  /// The plane's top bits: the host has added half a step of what they drop.
  std::int64_t plane_value(int plane) const {
    constexpr int c_drop = Preset::c_plane_sum_bits - Preset::c_vector_bits;
    return planes_[static_cast<std::size_t>(plane)].value().value() >> c_drop;
  }
  /// The object that has left a processor.
  const ShadingToken<Preset>& token() const { return token_; }

 private:
  using RequestAt = typename Preset::request_header_at;
  using PlaneAt = typename Preset::plane_header_at;
  using Token = ShadingToken<Preset>;
  using Plane = PlaneInterpolator<Preset::c_plane_sum_bits>;

  static constexpr std::size_t words_of(int bits) { return static_cast<std::size_t>(bits + 31) / 32; }
  /// Of the colour before the first processor: what rounds it, where it has a fraction.
  static constexpr std::uint32_t c_half =
      Preset::c_radiance_fraction_bits == 0 ? 0 : 1U << (Preset::c_radiance_fraction_bits - 1);

  /// For the processors alone: the vector covers no pixel.
  static bool is_load(Command command) {
    return command == Command::new_frame || command == Command::define || command == Command::redefine ||
           command == Command::remove;
  }

  // It begins amid a word.
  std::array<std::uint32_t, words_of(Exact::c_init_header_bits)> walk_of(
      std::span<const std::uint32_t> vector) const {
    std::array<std::uint32_t, words_of(Exact::c_init_header_bits)> walk;
    for (std::size_t i = 0; i < walk.size(); ++i)
      walk[i] = static_cast<std::uint32_t>(
          get_bits(vector, {"", 32 * static_cast<int>(i), 32, false, 0}, layout_.walk_low()));
    static_assert(Exact::c_init_header_bits % 32 == 0);
    return walk;
  }

  void line_load(std::span<const std::uint32_t> vector) {
    const auto walk = walk_of(vector);
    walker_.line_load(walk);
    depth_.line_load(walk);
    for (int p = 0; p < layout_.planes(); ++p) {
      const auto word = [&](const Field& field) {
        return Plane::Value::from_bits(get_bits(vector, field, layout_.plane_low(p)));
      };
      planes_[static_cast<std::size_t>(p)].line_load(word(PlaneAt::value), word(PlaneAt::dx),
                                                     word(PlaneAt::de0), word(PlaneAt::de1));
    }
    const auto material = [&](int low, int bits) {
      return static_cast<std::uint32_t>(
          get_bits(vector, {"", low, bits, false, 0}, layout_.init_material_low()));
    };
    constexpr int c_k = Preset::c_coefficient_bits;
    if (config_.specular) token_.exponent = material(layout_.exponent_low(), Preset::c_exponent_bits);
    for (int i = 0; i < config_.channels; ++i) {
      const auto channel = static_cast<std::size_t>(i);
      token_.ambient[channel] = material(layout_.ambient_low(i), c_k);
      if (config_.diffuse) token_.diffuse[channel] = material(layout_.diffuse_low(i), c_k);
      if (config_.specular) token_.specular[channel] = material(layout_.specular_low(i), c_k);
    }
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

  template <class Emit, class Watch>
  void draw_line(Emit& emit, Watch& watch) {
    watch.line(*this);
    span_load();
    token_.triangle = walker_.triangle();
    token_.y = walker_.y();
    const SpanXWord stop = walker_.stop(), step = walker_.pixel_step();
    for (SpanXWord x = walker_.start(); x != stop; x += step) {
      watch.span(*this, x);
      token_.x = static_cast<std::uint32_t>(low_bits(x.bits(), Preset::c_pixel_x_bits));
      token_.z = depth_.z();
      if (!objects_ || objects_->passes(walk_, token_.x, token_.z, token_.triangle)) {
        if (walk_ == Command::shadow) {
          token_.command = Command::shadow;
          pipeline_.process(token_);
        } else {
          shade(x, watch);
          emit(fragment());
        }
      }
      span_step();
    }
  }

  template <class Watch>
  void shade(SpanXWord x, Watch& watch) {
    token_.command = place_of_object();
    for (int i = 0; i < c_axes; ++i) token_.normal[static_cast<std::size_t>(i)] = plane_value(i);
    if (layout_.has_place())
      for (int i = 0; i < c_axes; ++i) token_.place[static_cast<std::size_t>(i)] = plane_value(c_axes + i);
    if (layout_.has_distance()) token_.distance = plane_value(2 * c_axes);
    token_.radiance.fill(c_half);
    pipeline_.process(token_, [&](std::size_t processor, const Token&) {
      watch.processor(*this, x, static_cast<int>(processor));
    });
  }

  Command place_of_object() {
    const Pixel now{token_.y, token_.x};
    const Command command = !previous_ || previous_->y != now.y ? Command::new_scanline
                            : previous_->x == now.x             ? Command::new_object
                                                                : Command::new_pixel;
    previous_ = now;
    return command;
  }

  Fragment fragment() const {
    return {.triangle = token_.triangle,
            .z = token_.z,
            .y = static_cast<std::uint16_t>(token_.y),
            .x = static_cast<std::uint16_t>(token_.x),
            .red = colour(0),
            .green = colour(1),
            .blue = colour(2)};
  }
  /// With one channel, grey: all colours are that channel's.
  std::uint8_t colour(std::size_t channel) const {
    constexpr int c_bits = Preset::c_radiance_bits + 2;
    return static_cast<std::uint8_t>(
        saturate<c_bits, Preset::c_radiance_fraction_bits, Preset::c_colour_bits>(
            Word<c_bits>::from_bits(token_.radiance[config_.channels == 3 ? channel : 0])));
  }

  struct Pixel {
    std::uint32_t y, x;
  };

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  Command walk_ = Command::draw;
  TriangleWalker<Exact> walker_;
  ZInterpolator<Exact> depth_;
  std::vector<Plane> planes_;  // N, P or the view ray, 1/w
  std::optional<ObjectStage> objects_;
  std::optional<Pixel> previous_;  // of the last object, in this frame
  Token token_;                    // the object on its way
  ShadingPipeline<Preset> pipeline_;
};

}  // namespace halfway::golden
