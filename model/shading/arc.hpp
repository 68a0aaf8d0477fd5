// SPDX-License-Identifier: Apache-2.0
// Directions that turn uniformly on the unit sphere, and the angle between two of them as one cosine
// (spherical paper, section 3). Accurate also where the paper's quotients are 0/0.
#pragma once

#include <glm/vec3.hpp>

namespace halfway {

/// Source of the vectors at the two ends of a span of the spherical shader.
enum class SpanEnds {
  on_surface,  ///< the surface at the centres of the end pixels, perspective-correct
  /// As published: spherical interpolation along the triangle's edges. Triangles are never split into
  /// columns, for any threshold. The errors are large if a light is close to the surface or a spot's edge
  /// crosses it.
  slerped_along_edges,
};

/// As for --span-ends and in study spaces.
inline const char* to_string(SpanEnds ends) {
  return ends == SpanEnds::on_surface ? "surface" : "slerp";
}

/// Cosine of the angle between two turning directions: amplitude * cos(t * sweep - phase), t in [0, 1].
struct CosineArc {
  double amplitude;  ///< in [0, 1]
  double sweep;      ///< in [0, pi]
  /// Modulo 2 pi, chosen such that the value at the middle, sweep/2 - phase, is in [-pi, pi]. Then t * sweep
  /// - phase is in [-1.5 pi, 1.5 pi], where the cosine is positive only within +-pi/2.
  double phase;

  double at(double t) const;
};

/// Approximate directions half way, for opposite ends, which do not define the plane of the rotation. Only
/// the component perpendicular to the ends is used. Zero means unknown: the plane then is an arbitrary one
/// that depends only on u1 (or v1).
struct ArcMiddle {
  glm::dvec3 u{0.0}, v{0.0};
};

// The vectors are unit up to rounding. A vector whose length differs from 1 by more than 1e-3 (zero, because
// no halfway vector exists, or not finite) has no direction: slerp then gives zero, and cosine_arc gives
// amplitude 0 and sweep 0. All results are finite.

/// Rotates from u1 (t = 0) to u2 (t = 1) along the shorter part of the great circle at constant speed.
/// `middle`: see ArcMiddle::u.
glm::dvec3 slerp(glm::dvec3 u1, glm::dvec3 u2, double t, glm::dvec3 middle = glm::dvec3(0.0));

/// slerp(u1, u2, t, middle.u) . v within 3e-15, for all ends; v is constant. If u1 and u2 are equal, the
/// sweep is 0, the amplitude |u1.v|, and the phase 0 or pi.
CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v, const ArcMiddle& middle = {});

/// Both directions turn, u from u1 to u2 and v from v1 to v2. Relative to v, u turns by slerp from u1 to u2
/// rotated back by the rotation v1 -> v2. The result is the same from either end. At the ends it is u1.v1 and
/// u2.v2. Between them it differs slightly from slerp(u1, u2, t) . slerp(v1, v2, t) (the paper's second
/// scheme), except if v1 = v2.
///
/// The error at the ends is at most 3e-15. Between the ends it is the error of the arc from u1 to the rotated
/// u2, which is rounded: 3e-15/sin(sweep). It increases only towards a sweep of pi.
CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2,
                     const ArcMiddle& middle = {});

}  // namespace halfway
