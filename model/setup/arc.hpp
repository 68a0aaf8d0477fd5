// SPDX-License-Identifier: Apache-2.0
// Directions that turn uniformly on the unit sphere, and the angle between two of them as one cosine
// (spherical paper, section 3), accurate where its quotients are 0/0.
#pragma once

#include <glm/vec3.hpp>

namespace halfway {

/// Cosine of the angle between two directions on the way: amplitude * cos(t * sweep - phase), t in [0, 1].
struct CosineArc {
  double amplitude;  ///< in [0, 1]
  double sweep;      ///< in [0, pi]
  /// That turn of it for which the middle, sweep/2 - phase, is in [-pi, pi]. So t * sweep - phase stays in
  /// [-1.5 pi, 1.5 pi], where the cosine is positive within +-pi/2 only.
  double phase;

  double at(double t) const;
};

/// Directions about half way, for ends that are opposed and tell no plane to turn in; only the part across
/// the ends counts. Zero: not known, then the plane is an arbitrary one that depends on u1 (or v1) alone.
struct ArcMiddle {
  glm::dvec3 u{0.0}, v{0.0};
};

// Vectors are unit up to rounding. One that is not within 1e-3 of it (zero, because there is no halfway
// vector, or not finite) is no direction: slerp gives zero, cosine_arc amplitude 0 and sweep 0. All results
// are finite.

/// On the great circle from u1 (t = 0) to u2 (t = 1), the short way, at constant speed. `middle` as
/// ArcMiddle::u.
glm::dvec3 slerp(glm::dvec3 u1, glm::dvec3 u2, double t, glm::dvec3 middle = glm::dvec3(0.0));

/// slerp(u1, u2, t, middle.u) . v within 3e-15, for all ends: v stands still. Where u1 and u2 are one
/// direction the sweep is 0, the amplitude |u1.v|, the phase 0 or pi.
CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v, const ArcMiddle& middle = {});

/// Both turn, u from u1 to u2 and v from v1 to v2: seen from a v that stands still at v1, u ends at u2 turned
/// back by the rotation v1 -> v2, and goes there by slerp. Taken from the other end it is the same. The ends
/// are u1.v1 and u2.v2; between them it is not quite slerp(u1, u2, t) . slerp(v1, v2, t) (the paper's second
/// scheme), except where v1 = v2.
///
/// u1.v1 and u2.v2 come back within 3e-15. On the way the error is that of the arc from u1 to the turned u2,
/// which is rounded: 3e-15/sin(sweep), so it grows towards a sweep of pi, and nowhere else.
CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2,
                     const ArcMiddle& middle = {});

}  // namespace halfway
