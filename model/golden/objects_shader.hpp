// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/processors_shader.vhd with object processors: strips to the fragments of
// visible objects or of filtered pixels, in the hardware's order.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "golden/fragment_output.hpp"
#include "golden/object_front.hpp"
#include "golden/pixel_filter.hpp"
#include "golden/shading_pipeline.hpp"

namespace halfway::golden {

/// Keeps lights and the chain of object processors from one vector to the next.
template <class Preset>
class ObjectsShader {
 public:
  ObjectsShader(const ProcessorsConfig& config, int subpixels, int objects)
      : config_(config), layout_(config), front_(config, subpixels, objects), pipeline_(config) {
    assert(config.channels == 1 || config.channels == 3);
    if (has_filter(subpixels)) filter_.emplace(config.channels, subpixels, Background{});
  }

  int init_bits() const { return layout_.init_bits(); }
  std::size_t init_words() const { return static_cast<std::size_t>(init_bits() + 31) / 32; }
  /// The vectors of a strip, with the one that ends it. The first one contains the number of the others, in a
  /// field that the hardware does not use.
  std::size_t group(std::span<const std::uint32_t> vector) const {
    if (command_of<Preset>(vector) != Command::new_scanline) return 1;
    return 1 + get_bits(vector, Exact::init_header_at::triangle, ProcessorsLayout<Preset>::walk_low());
  }
  /// The pixels of the strip that the vector opens. A frame has at most one fragment at each of them.
  std::uint64_t pixels(std::span<const std::uint32_t> vector) const {
    using At = Exact::init_header_at;
    if (command_of<Preset>(vector) != Command::new_scanline) return 0;
    const auto of_walk = [&](const Field& field) {
      return static_cast<std::int64_t>(get_bits(vector, field, ProcessorsLayout<Preset>::walk_low()));
    };
    const std::int64_t columns = of_walk(At::upper_x) - of_walk(At::start_x),
                       lines = of_walk(At::upper_lines);
    return static_cast<std::uint64_t>(columns > 0 ? columns * lines : 0);
  }
  /// True since a triangle that found no free processor or came out of order, or a token for a light that
  /// does not exist. All later fragments are then invalid.
  bool fault() const { return front_.fault() || pipeline_.fault(); }

  /// Processes vectors, and calls emit(fragment) for each fragment that they cause.
  template <class Emit>
  void draw(std::span<const std::uint32_t> vectors, Emit&& emit) {
    for (; vectors.size() >= init_words(); vectors = vectors.subspan(init_words()))
      front_.take(vectors, [&](Token token, std::uint32_t mask, bool ends) {
        if (filter_)
          draw_filtered(token, mask, ends, emit);
        else if (pipeline_.process(token))
          emit(fragment_output(token, config_.channels));
      });
  }

  /// True if only the processors use the vector. It then covers no pixel.
  static bool is_load(std::span<const std::uint32_t> vector) {
    return words::is_load(command_of<Preset>(vector));
  }

 private:
  using Token = ShadingToken<Preset>;

  // Filtered pixels have the background that new_frame gives.
  template <class Emit>
  void draw_filtered(Token& token, std::uint32_t mask, bool ends, Emit& emit) {
    if (!ends && (!is_head(token.command) || config_.shadows)) pipeline_.process(token);
    filter_->take(token, static_cast<std::uint32_t>(std::popcount(mask)), emit);
    if (token.command == Command::new_frame && !ends)
      filter_->set_background(background_of(token, config_.channels));
  }

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  ObjectFront<Preset> front_;
  ShadingPipeline<Preset> pipeline_;
  std::optional<PixelFilter<Preset>> filter_;
};

}  // namespace halfway::golden
