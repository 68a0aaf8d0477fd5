// SPDX-License-Identifier: Apache-2.0
#include "shading/light_ray.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace halfway {
namespace {

struct Sheared {
  double x, y, z;
};

/// p.x q.y - p.y q.x. Its sign is exact, and its value is accurate even if it is very small.
double cross(const Sheared& p, const Sheared& q) {
  const double left = p.x * q.y, right = p.y * q.x;
  const double difference = left - right;
  constexpr double c_few_digits_lost = 1e-10;
  if (std::abs(difference) > c_few_digits_lost * (std::abs(left) + std::abs(right))) return difference;
  // Kahan's difference of products: at most two roundings of the result.
  return std::fma(p.x, q.y, -right) + std::fma(-p.y, q.x, right);
}

/// An edge from p to q as seen from the ray.
struct PassedEdge {
  PassedEdge(const Sheared& p, const Sheared& q) : weight(cross(p, q)), side(weight) {
    if (side == 0.0) side = p.y != q.y ? p.y - q.y : q.x - p.x;
  }
  double weight;
  /// Only the sign counts. If the ray meets the edge exactly, it counts as moved by (e, e^2), e infinitely
  /// small. It is then on the same side for both triangles of the edge, and never on the edge.
  double side;
};

}  // namespace

bool is_averted(const CornersWorld& corners_world, const LightPoint& light) {
  const auto& [a, b, c] = corners_world;
  return glm::dot(light.way_from(a), glm::cross(b - a, c - a)) < 0.0;
}

// Shear the ray onto the z axis. Without a rotation each vertex is moved once, and to the same place for
// every triangle that contains it (Woop, Benthin and Wald, 2013).
LightRay::LightRay(const glm::dvec3& from_world, const LightPoint& light)
    : from_world_(from_world),
      direction_world_(light.way_from(from_world)),
      greatest_way_(light.w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0) {
  const glm::dvec3 size = glm::abs(direction_world_);
  z_ = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  x_ = (z_ + 1) % 3;
  y_ = (x_ + 1) % 3;
  if (direction_world_[z_] < 0.0) std::swap(x_, y_);  // keeps the axes right-handed
  shear_x_ = direction_world_[x_] / direction_world_[z_];
  shear_y_ = direction_world_[y_] / direction_world_[z_];
  scale_z_ = 1.0 / direction_world_[z_];
}

LightRay::Hit LightRay::hit(const CornersWorld& corners_world, double least_way) const {
  const auto sheared = [this](const glm::dvec3& corner) {
    const glm::dvec3 v = corner - from_world_;
    return Sheared{v[x_] - shear_x_ * v[z_], v[y_] - shear_y_ * v[z_], scale_z_ * v[z_]};
  };
  const Sheared a = sheared(corners_world[0]), b = sheared(corners_world[1]), c = sheared(corners_world[2]);
  const PassedEdge bc(b, c), ca(c, a), ab(a, b);
  const bool enters = bc.side < 0.0 && ca.side < 0.0 && ab.side < 0.0;
  if (!enters && !(bc.side > 0.0 && ca.side > 0.0 && ab.side > 0.0)) return {};
  // The weights have one sign: however thin the triangle is, the distance stays between those of its corners.
  const double way =
      (bc.weight * a.z + ca.weight * b.z + ab.weight * c.z) / (bc.weight + ca.weight + ab.weight);
  if (!(way > least_way && way < greatest_way_)) return {};
  return {enters ? Crossing::enters : Crossing::leaves, way};
}

}  // namespace halfway
