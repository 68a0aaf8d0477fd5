// SPDX-License-Identifier: Apache-2.0
// Common measurements of the families: fragments compared with radiances, and the surface that a fragment
// shows.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "frame/fragment.hpp"
#include "golden_run/test/spherical_drawing.hpp"
#include "projection/project.hpp"
#include "setup/setup.hpp"
#include "specification/hard_cases/specification.hpp"
#include "specification/hard_cases/trial.hpp"

namespace halfway::stability {

inline constexpr double c_infinity = std::numeric_limits<double>::infinity();
inline constexpr int c_subpixel_bits = 4;  ///< of preset exact
/// Object processors of the golden model in scenes with shadows. The RTL with c_object_processors draws those
/// scenes that need no more.
inline constexpr unsigned c_golden_objects = 64;
inline constexpr ProcessorForm c_forms[] = {ProcessorForm::folded, ProcessorForm::unrolled};

inline double or_infinity(long double figure) {
  return std::isfinite(figure) ? static_cast<double>(figure) : c_infinity;
}

inline std::array<std::uint8_t, 3> channels(const Fragment& f) {
  return {f.red, f.green, f.blue};
}

/// The error in colour steps of the worst channel, compared with the radiance clamped to white.
long double colour_error(const Fragment& f, const LongVec& radiance);

/// The scene with its lengths times `by`, except near and far plane.
Scene scaled(Scene scene, double by);

/// The triangles of a scene on the screen. Clipping makes several pieces of one triangle.
class Pieces {
 public:
  Pieces(const Scene& scene, FrameSize frame);
  const std::vector<ScreenTriangle>& all() const { return pieces_; }
  /// The piece of triangle `source` of the scene that covers the pixel, or nullptr.
  const ScreenTriangle* covering(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  const ScreenTriangle* covering(const Fragment& f) const { return covering(f.triangle, f.x, f.y); }
  /// The piece of triangle `source` with the largest minimum of its barycentric coordinates at the pixel's
  /// centre.
  const ScreenTriangle& nearest(std::uint32_t source, std::int64_t x, std::int64_t y) const;

 private:
  std::span<const ScreenTriangle> pieces_of(std::uint32_t source) const;

  std::vector<ScreenTriangle> pieces_;  ///< in order of their sources
};

/// The illumination model at the pixels of a scene, with exponents clamped as in the spherical shader.
class Truth {
 public:
  /// The scene must outlive it.
  Truth(const Scene& scene, FrameSize frame) : scene_(scene), pieces_(scene, frame) {}
  /// For triangle `source` of the scene; linear, not clamped.
  LongVec radiance_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;
  LongVec normal_at(std::uint32_t source, std::int64_t x, std::int64_t y) const;

 private:
  const Scene& scene_;
  Pieces pieces_;
};

/// The error of a quadratic leaf, in units of the threshold, that the test is proved or calibrated to
/// (docs/accuracy.md).
inline double thresholds_of(HighlightTest test) {
  return test == HighlightTest::proved ? 1.0 : 2.0;
}

/// Compares the fragments of a scene without shadows with the illumination model at the pixels' centres.
/// Calls add(error in colour steps, fragment). Leaves out pixels at a jump of the model, where doubles
/// decide.
void for_each_error(const Scene& scene, const Pieces& pieces, std::span<const Fragment> fragments,
                    const std::function<void(double, const Fragment&)>& add);

/// Compares each channel of the shading processors' fragments with the illumination model at the pixel's
/// centre, with the bounds of ShadingBound.
void measure_shading(Trial& trial, Preset preset, const Scene& scene, FrameSize frame,
                     std::span<const Fragment> fragments, std::string_view name);

}  // namespace halfway::stability
