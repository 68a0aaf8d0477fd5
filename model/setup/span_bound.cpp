// SPDX-License-Identifier: Apache-2.0
#include "setup/span_bound.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace halfway {
namespace {

// Shorter sums of vectors, or interpolated normals, have no well-defined direction.
constexpr double c_least_length = 0.2;

// A curve on the unit sphere with an acceleration of at most a along the sphere is at most a/8 from the slerp
// of its ends if it is short. Twice that is assumed for curves that turn by up to c_largest_turn.
double off_slerp(double acceleration) {
  return acceleration / 4.0;
}

}  // namespace

std::optional<Turning> turning(glm::dvec3 begin, glm::dvec3 end, double ratio) {
  // An angle up to 0.5 is at most 1.011 times its chord.
  const double angle = 1.02 * glm::length(end - begin);
  if (!(angle <= c_largest_turn) || !(ratio > 0.0)) return std::nullopt;
  // The direction stays on the great circle of its ends, at the angle atan2(k t sin, 1 - t + k t cos), where
  // k is `ratio`. For k = 1 it is off by atan(x T) - x atan(T), |x| <= 1, T = tan(angle/2): at most 0.15 T^3.
  // Its slope in ln k is at most T/2.
  const double tangent = 0.52 * angle;
  const double uneven_ratio = std::abs(ratio - 1.0) / std::min(ratio, 1.0);  // at least |ln k|
  return Turning{angle, 0.5 * tangent * uneven_ratio + 0.15 * tangent * tangent * tangent};
}

Turning turning_sum(const Turning& a, const Turning& b, double least_sum) {
  // h = s/|s|, s = a + b. |h'| <= |s'|/|s|. Its acceleration along the sphere is at most |s''|/|s| + 2
  // (|s'|/|s|)^2.
  const double turn = (a.angle + b.angle) / least_sum;
  const double acceleration = (a.angle * a.angle + b.angle * b.angle) / least_sum + 2.0 * turn * turn;
  return {turn, (a.uneven + b.uneven) / least_sum + off_slerp(acceleration)};
}

double angle_bound(const Turning& u, const Turning& v) {
  // The arc turns u by a slerp relative to v, which turns too. Against the slerp of u it is accelerated by 2
  // v' (u' + v') + v'^2/2.
  return u.uneven + v.uneven + off_slerp(2.0 * v.angle * (u.angle + v.angle) + 0.5 * v.angle * v.angle);
}

std::optional<ArcBounds> arc_bounds(const SurfacePoint& begin, const SurfacePoint& end, const Light& light,
                                    glm::dvec3 eye_world) {
  const double perspective = end.inverse_w / begin.inverse_w;
  // The turn of a vector given at both ends, and its directions there.
  struct Ends {
    glm::dvec3 begin, end;
    std::optional<Turning> turn;
  };
  const auto turn_to = [&](const glm::dvec3& place_world) -> Ends {
    const glm::dvec3 from = place_world - begin.position_world, to = place_world - end.position_world;
    const double from_length = glm::length(from), to_length = glm::length(to);
    if (!(std::min(from_length, to_length) > 0.0)) return {from, to, std::nullopt};
    const glm::dvec3 from_unit = from / from_length, to_unit = to / to_length;
    return {from_unit, to_unit, turning(from_unit, to_unit, perspective * to_length / from_length)};
  };
  if (!(std::min(begin.normal_length, end.normal_length) > c_least_length)) return std::nullopt;
  const auto normal =
      turning(begin.normal_world, end.normal_world, perspective * end.normal_length / begin.normal_length);
  const Ends eye = turn_to(eye_world);
  const Ends to_light = light.point.w == 0.0
                            ? Ends{light.point.xyz_world, light.point.xyz_world, Turning{0.0, 0.0}}
                            : turn_to(light.point.xyz_world);
  if (!normal || !eye.turn || !to_light.turn) return std::nullopt;
  const double least_sum =
      std::min(glm::length(to_light.begin + eye.begin), glm::length(to_light.end + eye.end)) -
      to_light.turn->angle - eye.turn->angle;
  if (!(least_sum > c_least_length)) return std::nullopt;
  const Turning halfway = turning_sum(*to_light.turn, *eye.turn, least_sum);
  if (halfway.angle > c_largest_turn) return std::nullopt;
  return ArcBounds{angle_bound(*normal, *to_light.turn), angle_bound(*normal, halfway)};
}

}  // namespace halfway
