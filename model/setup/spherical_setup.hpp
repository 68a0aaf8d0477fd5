// SPDX-License-Identifier: Apache-2.0
// Setup of the spherical shader: from the scene's triangles to headers and line records. For each line and
// light the cosine between two directions that turn (spherical paper, equations 14 to 18) becomes an angle,
// its step from pixel to pixel, and a factor.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "golden/spherical_layout.hpp"
#include "plan/plan.hpp"
#include "setup/arc.hpp"
#include "setup/init_vector.hpp"
#include "setup/setup.hpp"
#include "shading/bell.hpp"
#include "shading/effects.hpp"

namespace halfway {

/// Larger exponents are held at it: the bell's angle would leave its format.
inline constexpr double c_largest_exponent = 1e6;

/// Of all materials, for SphericalSetupOptions.
Bells fitted_bells(const Scene& scene);

/// Factors are held at it, in colour steps. Preset exact: so bright that a table's least entry other than 0,
/// of up to c_white_data_bits, gives white: the picture is the one without a limit. With wider tables, and in
/// preset published (four times white) always, all under a bell whose factor is held comes out too dark.
template <class P>
inline constexpr double c_largest_factor =
    static_cast<double>((1 << (P::c_factor_bits - P::c_factor_fraction_bits)) - 1);
inline constexpr int c_white_data_bits = 8;
static_assert(c_largest_factor<golden::Exact> >= 255.0 * (1 << c_white_data_bits));

/// What the illumination model takes from a point of the surface, a light at a time. Zero vectors: no such
/// direction there (the light at the very point, L = -V).
struct LightVectors {
  glm::dvec3 to_light;
  glm::dvec3 u, v;  ///< the highlight is (u.v)^n: N and H, or in Phong's model R and V
  double spot;      ///< 1 but for spot lights
};
struct PointVectors {
  glm::dvec3 normal;
  std::array<LightVectors, c_most_lights> light;  ///< as many as are reflected
};

/// A span between two points whose vectors are known: its first pixel at t = first, each further one `step`
/// on.
struct SpanVectors {
  PointVectors begin, end;
  double first = 0.0, step = 0.0;
};

/// What the hardware has of a light along a span.
struct LightArcs {
  CosineArc diffuse;   ///< N.L
  CosineArc specular;  ///< u.v
  double spot;         ///< the ends' mean: a factor stands still along a span
  bool exact_at_ends;  ///< of a span that begins at t = 0 and ends at t = 1
};
struct SpanArcs {
  std::array<LightArcs, c_most_lights> light;  ///< as many as are reflected
  double first, step;                          ///< as SpanVectors
};

class SphericalSetup final : public Setup {
 public:
  SphericalSetup(const Scene& scene, FrameSize frame, const HardwareKey& key, SphericalSetupOptions options);

  unsigned init_bits() const override { return init_bits_; }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(scene_->triangles.size()); }
  Tile reach(std::uint32_t triangle) const override { return projector_.reach(triangle); }
  void append(std::uint32_t triangle, std::vector<std::uint32_t>& words, SetupCounts& counts) const override;

  PointVectors vectors_at(const Material& material, const SurfacePoint& point) const;

 private:
  class ExactTriangle;
  void append_published(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                        SetupCounts& counts) const;
  PointVectors slerped(const PointVectors& a, const PointVectors& b, double t) const;
  void put_ambient(InitVector& init, const Material& material, SetupCounts& counts) const;
  /// `middle` gives the vectors at the span's middle, asked for where the ends are nearly opposed.
  template <class Middle>
  SpanArcs arcs_of(const Material& material, const SpanVectors& span, Middle&& middle) const;
  template <class Preset>
  void put_record(InitVector& record, std::uint32_t material, const SpanArcs& span,
                  SetupCounts& counts) const;
  /// Largest difference of a channel, in colour steps, between the span's interpolation at t and the
  /// illumination model there.
  double interpolation_error(const Material& material, const SpanArcs& span, double t,
                             const SurfacePoint& there) const;
  template <class P>
  std::int64_t factor_word(double steps, SetupCounts& counts) const;

  const Scene* scene_;
  FrameSize frame_;
  Preset preset_;
  SphericalSetupOptions options_;
  golden::SphericalConfig config_;
  std::vector<LightRef> lights_;  ///< no more than the key has; any further light of the key stays dark
  bool has_spots_;
  std::vector<Bell> bells_;  ///< one a material
  bool has_records_;         ///< with all effects also where there is no light
  unsigned init_bits_;
  Projector projector_;
};

}  // namespace halfway
