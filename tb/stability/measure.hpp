// SPDX-License-Identifier: Apache-2.0
// What the families measure alike: fragments against radiances, and the surface that a fragment shows.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "frame/fragment.hpp"
#include "setup/project.hpp"
#include "stability/specification.hpp"
#include "stability/trial.hpp"

namespace halfway::stability {

inline constexpr double c_infinity = std::numeric_limits<double>::infinity();
inline constexpr int c_subpixel_bits = 4;  ///< of preset exact
inline constexpr ProcessorForm c_forms[] = {ProcessorForm::folded, ProcessorForm::unrolled};

inline double or_infinity(long double figure) {
  return std::isfinite(figure) ? static_cast<double>(figure) : c_infinity;
}

inline std::array<std::uint8_t, 3> channels(const Fragment& f) {
  return {f.red, f.green, f.blue};
}

/// Of the channel that is farthest from the radiance clamped to white, in colour steps.
long double colour_error(const Fragment& f, const LongVec& radiance);

/// A scene's triangles on the screen. Clipping makes several pieces of one triangle.
class Pieces {
 public:
  Pieces(const Scene& scene, FrameSize frame);
  const std::vector<ScreenTriangle>& all() const { return pieces_; }
  /// The piece of triangle `source` of the scene that covers the pixel, or nullptr.
  const ScreenTriangle* covering(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  const ScreenTriangle* covering(const Fragment& f) const { return covering(f.triangle, f.x, f.y); }
  /// The piece of triangle `source` whose smallest barycentric at the pixel's centre is the largest.
  const ScreenTriangle& nearest(std::uint32_t source, std::int64_t x, std::int64_t y) const;

 private:
  std::vector<ScreenTriangle> pieces_;  ///< in order of their sources
};

/// Measures each channel of the shading processors' fragments against the illumination model at the pixel's
/// centre, with ShadingBound's bounds.
void measure_shading(Trial& trial, Preset preset, const Scene& scene, FrameSize frame,
                     std::span<const Fragment> fragments, std::string_view name);

}  // namespace halfway::stability
