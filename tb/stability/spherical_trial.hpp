// SPDX-License-Identifier: Apache-2.0
// Scenes through the spherical shader, both presets, each fragment beside the illumination model.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "golden_run/test/spherical_drawing.hpp"
#include "scene/scene.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {

/// The first triangle's surface behind a pixel's centre, as setup has it.
SurfacePoint surface_at(const Scene& scene, FrameSize frame, std::int64_t x, std::int64_t y);

/// What the illumination model gives behind the pixels of a scene; exponents held as the shader holds them.
class Truth {
 public:
  /// The scene must outlive it.
  Truth(const Scene& scene, FrameSize frame);
  /// Of triangle `source` of the scene; linear, not clamped.
  LongVec radiance_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  LongVec normal_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;

 private:
  const ScreenTriangle& piece_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  const Scene& scene_;
  std::map<std::uint32_t, std::vector<ScreenTriangle>> pieces_;
};

struct Shown {
  std::uint64_t fragments = 0;
  int brightest = 0, published_brightest = 0;  ///< of the red
  SetupCounts counts{};
};

struct ShowOptions {
  FrameSize frame = c_stage_frame;
  double threshold = 2.0;
  unsigned lights = 3;    ///< of the hardware: the same for most cases, so that one build serves
  bool published = true;  ///< draw it by preset published too
  std::optional<TableSize> published_tables{};
};

/// The scene by preset exact, ends on the surface: each fragment's largest error of a channel against what
/// setup's threshold, bells and tables allow (promised_steps), in colour steps. And the same pixels as preset
/// published has them, against the same bound. No word leaves its format; ends by slerp cover the same
/// pixels.
Shown show(Trial& trial, const Scene& scene, const std::string& name, const ShowOptions& options = {});

}  // namespace halfway::stability
