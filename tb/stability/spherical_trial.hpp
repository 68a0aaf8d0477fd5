// SPDX-License-Identifier: Apache-2.0
// Draws scenes by the spherical shader in both presets and compares each fragment with the illumination
// model.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "golden/spherical_layout.hpp"
#include "golden/triangle_walker.hpp"
#include "golden_run/golden_run.hpp"
#include "golden_run/test/spherical_drawing.hpp"
#include "scene/scene.hpp"
#include "stability/measure.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {

/// The surface of the first triangle at a pixel's centre, as in setup.
SurfacePoint surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y);

/// The illumination model at the pixels of a scene, with exponents clamped as in the shader.
class Truth {
 public:
  /// The scene must outlive it.
  Truth(const Scene& scene, FrameSize frame);
  /// For triangle `source` of the scene; linear, not clamped.
  LongVec radiance_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  LongVec normal_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;

 private:
  const Scene& scene_;
  Pieces pieces_;
};

struct Shown {
  std::uint64_t fragments = 0;
  int brightest = 0, published_brightest = 0;  ///< of the red channel
  SetupCounts counts{};
};

struct ShowOptions {
  FrameSize frame = c_stage_frame;
  double threshold = 2.0;
  int least_red = 0;      ///< least red of the brightest pixel
  unsigned lights = 3;    ///< of the hardware; equal for most cases, so that they share one build
  bool published = true;  ///< also draw the scene in preset published
  std::optional<TableSize> published_tables{};
};

/// Calls line(walker, record) for each line record of preset P's stream, with the walker on that line.
template <class P, class Line>
void for_each_line(const Drawing& drawing, Line&& line) {
  const auto model = make_golden_model(drawing.key);
  const std::size_t vector_words = (drawing.init_bits + 31) / 32;
  std::span<const std::uint32_t> rest = drawing.words;
  while (!rest.empty()) {
    const std::size_t vectors = model->group(rest);
    golden::TriangleWalker<P> walker;
    walker.line_load(rest);
    for (std::size_t at = 1; vectors > 1; ++at) {
      line(walker, rest.subspan(at * vector_words, vector_words));
      if (walker.line_last()) break;
      walker.line_step();
    }
    rest = rest.subspan(vectors * vector_words);
  }
}

/// An angle of a line record after so many steps.
template <class P>
std::int64_t angle_after(std::span<const std::uint32_t> record, const golden::Field& angle,
                         const golden::Field& slope, int low, std::int64_t steps) {
  using Angle = golden::Word<P::c_angle_bits>;
  return Angle::from_bits(golden::get_bits(record, angle, low)).value() +
         steps * Angle::from_bits(golden::get_bits(record, slope, low)).value();
}

/// Draws the scene in preset exact, with ends on the surface. Compares each fragment's largest channel error
/// with the bound that setup's threshold, bells and tables guarantee (promised_steps), in colour steps.
/// Compares the same pixels of preset published with the same bound. No word leaves its format; ends by slerp
/// cover the same pixels.
Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options = {});

}  // namespace halfway::stability
