// SPDX-License-Identifier: Apache-2.0
// Bound of the difference between a span of the surface and its arcs (arc.hpp), from the two ends alone. Most
// spans turn so little that no pixel between the ends needs a check.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "projection/project.hpp"
#include "scene/lights.hpp"

namespace halfway {

/// The bounds hold for directions that turn by at most this angle along the span, in radians.
inline constexpr double c_largest_turn = 0.5;

/// A direction that turns along a span. Both are upper bounds, in radians.
struct Turning {
  double angle;   ///< between its ends
  double uneven;  ///< from the slerp of its ends, at the same place of the span
};

/// The direction of (1 - t) a + t b, a and b at the places of the screen t = 0 and t = 1,
/// perspective-correct: `begin` and `end` are the unit vectors of a and b. `ratio` is |b| / |a|, times 1/w at
/// the end by 1/w at the begin. std::nullopt for turns above c_largest_turn.
std::optional<Turning> turning(glm::dvec3 begin, glm::dvec3 end, double ratio);

/// The direction of the sum of two unit vectors that turn. `least_sum` is a lower bound of the sum's length.
Turning turning_sum(const Turning& a, const Turning& b, double least_sum);

/// Bound of the difference of the angle between u and v, in radians, from that of cosine_arc(u, v).
double angle_bound(const Turning& u, const Turning& v);

/// The difference between the surface and the arcs of one light, anywhere on the span, as angles in radians.
struct ArcBounds {
  double diffuse;   ///< angle between N and L
  double specular;  ///< angle between N and H (Blinn)
};
/// For the span of a surface between the points t = 0 and t = 1. std::nullopt if a direction turns too far,
/// or H is not well defined.
std::optional<ArcBounds> arc_bounds(const SurfacePoint& begin, const SurfacePoint& end, const Light& light,
                                    glm::dvec3 eye_world);

}  // namespace halfway
