// SPDX-License-Identifier: Apache-2.0
// Setup of the spherical shader: converts the scene's triangles to headers and line records. For each line
// and light the cosine between two turning directions (spherical paper, equations 15 to 18) becomes an angle,
// its step per pixel, and a factor.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "plan/own_bells.hpp"
#include "plan/plan.hpp"
#include "setup/setup.hpp"
#include "shading/arc.hpp"
#include "shading/bell.hpp"
#include "shading/effects.hpp"
#include "words/init_vector.hpp"
#include "words/spherical_layout.hpp"

namespace halfway {

/// The bells of all materials, for SphericalSetupOptions. `powers` is the sum of the powers that may be used.
Bells fitted_bells(const Scene& scene, unsigned powers = c_all_powers);

/// Factors are clamped to this value, in colour steps. Preset exact: at this factor the smallest non-zero
/// entry of a table with up to c_white_data_bits gives white, so the picture is the same as without a limit.
/// With wider tables, and always in preset published (four times white), the bell of a clamped factor is too
/// dark.
template <class P>
inline constexpr double c_largest_factor =
    static_cast<double>((1 << (P::c_factor_bits - P::c_factor_fraction_bits)) - 1);
inline constexpr int c_white_data_bits = 8;
static_assert(c_largest_factor<words::Exact> >= 255.0 * (1 << c_white_data_bits));

/// Inputs of the illumination model at a point of the surface, per light. A zero vector means that the
/// direction does not exist (the light is exactly at the point, or L = -V).
struct LightVectors {
  glm::dvec3 to_light;
  glm::dvec3 u, v;  ///< the highlight is (u.v)^n; Blinn: N and H, Phong: R and V
  double spot;      ///< 1 except for spot lights
};
struct PointVectors {
  glm::dvec3 normal;
  std::array<LightVectors, c_most_lights> light;  ///< the number of reflected lights is used
};

/// A span between two points with known vectors. Its first pixel is at t = first; each further pixel is one
/// `step` ahead.
struct SpanVectors {
  PointVectors begin, end;
  double first = 0.0, step = 0.0;
  std::int64_t steps = 0;  ///< from the first pixel to the last
};

/// The hardware's data of a light along a span.
struct LightArcs {
  CosineArc diffuse;   ///< N.L
  CosineArc specular;  ///< u.v
  double spot;         ///< mean of the ends: a factor is constant along a span
  bool exact_at_ends;  ///< for a span from t = 0 to t = 1
};
struct SpanArcs {
  std::span<const LightArcs> light;  ///< one per reflected light
  double first, step;                ///< this and the following as in SpanVectors
  std::int64_t steps;
};

class SphericalSetup final : public Setup {
 public:
  SphericalSetup(const Scene& scene, FrameSize frame, const HardwareKey& key, SphericalSetupOptions options);

  unsigned init_bits() const override { return init_bits_; }
  std::uint32_t units() const override { return static_cast<std::uint32_t>(scene_->triangles.size()); }
  Tile reach(std::uint32_t triangle) const override { return projector_.reach(triangle); }
  std::unique_ptr<SetupWorker> worker() const override;

  PointVectors vectors_at(const Material& material, const SurfacePoint& point) const;

 private:
  class Worker;
  class ExactTriangle;
  void append_published(const ScreenTriangle& triangle, std::vector<std::uint32_t>& words,
                        SetupCounts& counts) const;
  PointVectors slerped(const PointVectors& a, const PointVectors& b, double t) const;
  void put_ambient(InitVector& init, const Material& material, SetupCounts& counts) const;
  /// Sets the arcs of each light. `middle` returns the vectors at the span's middle. It is called only if the
  /// ends are nearly opposite.
  template <class Middle>
  void set_arcs(const Material& material, const SpanVectors& span, Middle&& middle,
                std::span<LightArcs> arcs) const;
  template <class Preset>
  void put_record(InitVector& record, std::uint32_t material, const SpanArcs& span,
                  SetupCounts& counts) const;
  /// Largest difference of any channel, in colour steps, between the span's interpolation at t and the
  /// illumination model there.
  double interpolation_error(const Material& material, const SpanArcs& span, double t,
                             const SurfacePoint& there) const;
  template <class P>
  std::int64_t factor_word(double steps, SetupCounts& counts) const;

  const Scene* scene_;
  std::vector<Light> scene_lights_;
  FrameSize frame_;
  Preset preset_;
  SphericalSetupOptions options_;
  words::SphericalConfig config_;
  std::vector<Light> lights_;  ///< at most the key's number; further lights of the key stay dark
  std::vector<Bell> bells_;    ///< one per material
  bool own_tables_;            ///< the tables of the key are the scene's own
  bool has_records_;           ///< with all effects also true without a light
  unsigned init_bits_;
  Projector projector_;
};

}  // namespace halfway
