// SPDX-License-Identifier: Apache-2.0
// Draws scenes by the spherical shader in both presets and compares each fragment with the illumination
// model.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "golden_run/test/spherical_drawing.hpp"
#include "scene/scene.hpp"
#include "specification/hard_cases/measure.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

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
  int least_red = 0;  ///< least red of the brightest pixel
  std::optional<words::CosineSize> published_tables{};
};

/// Draws the scene in preset exact, with ends on the surface. Compares each fragment's largest channel error
/// with the bound that setup's threshold, bells and tables guarantee (promised_steps), in colour steps.
/// Compares the same pixels of preset published with the same bound. Ends by slerp cover the same
/// pixels.
Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options = {});

}  // namespace halfway::stability
