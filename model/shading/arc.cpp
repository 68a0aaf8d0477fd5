// SPDX-License-Identifier: Apache-2.0
#include "shading/arc.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace halfway {
namespace {

// Below this sine two unit vectors are taken as parallel or opposite: a few roundings of their components.
constexpr double c_no_plane = 1e-15;
constexpr CosineArc c_dark{0.0, 0.0, 0.0};

bool is_direction(glm::dvec3 v) {
  return std::abs(glm::dot(v, v) - 1.0) < 2e-3;
}

/// The component of x perpendicular to the unit vector u.
glm::dvec3 across(glm::dvec3 x, glm::dvec3 u) {
  return x - glm::dot(x, u) * u;
}

/// A unit vector perpendicular to u that depends on u alone: derived from the axis with the greatest angle to
/// u.
glm::dvec3 any_across(glm::dvec3 u) {
  const glm::dvec3 a{std::abs(u.x), std::abs(u.y), std::abs(u.z)};
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  return glm::normalize(across(axis, u));
}

/// The rotation from u1 to u2: u(t) = cos(t angle) u1 + sin(t angle) tangent.
struct Turn {
  double cosine, sine;  ///< of the angle, 0 to pi
  glm::dvec3 tangent;   ///< unit, perpendicular to u1

  bool is_still() const { return sine == 0.0 && cosine > 0.0; }
  double angle() const { return std::atan2(sine, cosine); }
};

Turn turn_between(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 middle) {
  const double cosine = glm::dot(u1, u2);
  // The component of u2 perpendicular to u1, from the difference or the sum of the two, whichever is shorter.
  // u2 - u1 (u1.u2) has no accurate digits close to angles 0 and pi.
  const glm::dvec3 part = across(cosine > 0.0 ? u2 - u1 : u2 + u1, u1);
  const double sine = glm::length(part);
  if (sine > c_no_plane) return {cosine, sine, part / sine};
  if (cosine > 0.0) return {1.0, 0.0, any_across(u1)};
  if (is_direction(middle)) {
    const glm::dvec3 through = across(middle, u1);
    const double length = glm::length(through);
    if (length > c_no_plane) return {-1.0, 0.0, through / length};
  }
  return {-1.0, 0.0, any_across(u1)};
}

/// The cosine between v and a direction that turns away from u1.
CosineArc arc_seen_from(glm::dvec3 v, glm::dvec3 u1, const Turn& turn) {
  const double cosine = glm::dot(u1, v);
  if (turn.is_still()) return {std::min(std::abs(cosine), 1.0), 0.0, cosine < 0.0 ? std::numbers::pi : 0.0};
  const double sine = glm::dot(turn.tangent, v);
  const double sweep = turn.angle();
  double phase = std::atan2(sine, cosine);
  if (0.5 * sweep - phase > std::numbers::pi) phase += 2.0 * std::numbers::pi;
  return {std::min(std::hypot(cosine, sine), 1.0), sweep, phase};
}

}  // namespace

double CosineArc::at(double t) const {
  return amplitude * std::cos(t * sweep - phase);
}

glm::dvec3 slerp(glm::dvec3 u1, glm::dvec3 u2, double t, glm::dvec3 middle) {
  if (!is_direction(u1) || !is_direction(u2)) return glm::dvec3(0.0);
  const Turn turn = turn_between(u1, u2, middle);
  const double angle = t * turn.angle();
  return std::cos(angle) * u1 + std::sin(angle) * turn.tangent;
}

CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v, const ArcMiddle& middle) {
  if (!is_direction(u1) || !is_direction(u2) || !is_direction(v)) return c_dark;
  return arc_seen_from(v, u1, turn_between(u1, u2, middle.u));
}

CosineArc cosine_arc(glm::dvec3 u1, glm::dvec3 u2, glm::dvec3 v1, glm::dvec3 v2, const ArcMiddle& middle) {
  if (!is_direction(u1) || !is_direction(u2) || !is_direction(v1) || !is_direction(v2)) return c_dark;
  if (v1 == v2 && !is_direction(middle.u)) return arc_seen_from(v1, u1, turn_between(u1, u2, middle.u));
  // The rotation v1 -> v2 moves the frame (v1, ahead, axis) to (v2, ahead rotated, axis). Rotate x back: take
  // its coordinates in the second frame and use them in the first. This avoids a division by 1 + cos of the
  // angle.
  const Turn v = turn_between(v1, v2, middle.v);
  const glm::dvec3 axis = glm::cross(v1, v.tangent);
  const auto turned_back = [&](glm::dvec3 x, double c, double s) {
    const double ahead = glm::dot(x, v.tangent), up = glm::dot(x, v1);
    return (c * up + s * ahead) * v1 + (c * ahead - s * up) * v.tangent + glm::dot(x, axis) * axis;
  };
  const glm::dvec3 u2_back = v.is_still() ? u2 : turned_back(u2, v.cosine, v.sine);
  glm::dvec3 middle_back = middle.u;
  if (is_direction(middle.u)) {
    const double half = 0.5 * v.angle();
    middle_back = turned_back(middle.u, std::cos(half), std::sin(half));
  }
  return arc_seen_from(v1, u1, turn_between(u1, u2_back, middle_back));
}

}  // namespace halfway
