// SPDX-License-Identifier: Apache-2.0
// Golden model of rtl/shaders/processors_shader.vhd without object processors: converts the host's vectors to
// fragments, in the hardware's order.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "frame/fragment.hpp"
#include "golden/fragment_output.hpp"
#include "golden/shading_pipeline.hpp"
#include "golden/token_rasterizer.hpp"
#include "golden/unwatched.hpp"

namespace halfway::golden {

/// Keeps lights from one vector to the next.
template <class Preset>
class ProcessorsShader {
 public:
  explicit ProcessorsShader(const ProcessorsConfig& config)
      : config_(config), layout_(config), rasterizer_(config), pipeline_(config) {
    assert(config.channels == 1 || config.channels == 3);
    assert(!config.shadows);  // they need object processors
  }

  int init_bits() const { return layout_.init_bits(); }
  std::size_t init_words() const { return static_cast<std::size_t>(init_bits() + 31) / 32; }
  /// Every group is one vector: no line records follow.
  std::size_t group(std::span<const std::uint32_t>) const { return 1; }
  /// True since a vector with another command, or for a light that does not exist.
  bool fault() const { return fault_ || pipeline_.fault(); }

  /// Processes one vector. Calls emit(fragment) for each pixel output by the pipeline, watch.line(*this) when
  /// the span stage loads a line, watch.span(*this, x) at each pixel of it, and watch.processor(*this, x,
  /// number) for each object output by a processor.
  template <class Emit, class Watch = Unwatched>
  void draw(std::span<const std::uint32_t> vector, Emit&& emit, Watch&& watch = {}) {
    assert(vector.size() >= init_words());
    if (is_load(vector)) {
      Token load = Token::decode(config_, vector);
      pipeline_.process(load);
      return;
    }
    if (command_of<Preset>(vector) != Command::new_object) {
      fault_ = true;
      return;
    }
    rasterizer_.draw(
        vector, [&] { watch.line(*this); },
        [&](SpanXWord x) {
          watch.span(*this, x);
          Token& token = rasterizer_.token();
          pipeline_.process(token, [&](std::size_t processor, const Token&) {
            watch.processor(*this, x, static_cast<int>(processor));
          });
          emit(fragment_output(token, config_.channels));
        });
  }

  /// True if only the processors use the vector. It then covers no pixel.
  static bool is_load(std::span<const std::uint32_t> vector) {
    return words::is_load(command_of<Preset>(vector));
  }
  const TriangleWalker<Exact>& walker() const { return rasterizer_.walker(); }
  TriangleWalker<Exact> walker_of(std::span<const std::uint32_t> vector) const {
    return rasterizer_.walker_of(vector);
  }

  // Registers, for callbacks.
  const ZInterpolator<Exact>& depth() const { return rasterizer_.depth(); }
  std::int64_t plane_value(int plane) const { return rasterizer_.plane_value(plane); }
  /// In watch.processor: the object as that processor outputs it.
  const ShadingToken<Preset>& token() const { return rasterizer_.token(); }

 private:
  using Token = ShadingToken<Preset>;

  ProcessorsConfig config_;
  ProcessorsLayout<Preset> layout_;
  TokenRasterizer<Preset> rasterizer_;
  ShadingPipeline<Preset> pipeline_;
  bool fault_ = false;
};

}  // namespace halfway::golden
